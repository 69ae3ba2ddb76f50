//! Tests of `faults`, a module of it.

use super::*;
use crate::formats::obj;
use crate::surface::fault::Severity;

/// Faults of a mesh: kind, elements and nodes.
fn faults(text: &str) -> Vec<(MeshFaultKind, Vec<u64>, Vec<u64>)> {
    let faults = obj::read(text).expect("valid").surface_faults();
    faults.into_iter().map(|fault| (fault.kind, fault.elements, fault.nodes)).collect()
}

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\n";

#[test]
fn a_sound_mesh_has_no_faults() {
    assert_eq!(faults(&format!("{SQUARE}f 1 2 3 4\nf 2 5 6\nf 2 6 3\n")), []);
}

#[test]
fn faults_of_single_elements() {
    use MeshFaultKind::{NotConvex, RepeatedNode, ZeroArea};
    let one = |vertices: &str, face: &str| faults(&format!("{vertices}f {face}\n"));
    let four = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
    assert_eq!(
        one(four, "1 2 3 2"),
        [(RepeatedNode, vec![1], vec![2]), (MeshFaultKind::UnusedNode, vec![], vec![4])]
    );
    // A side is crossed.
    let crossing = "v 0 0 0\nv 1 0 0\nv .1 1 0\nv .9 .9 0\n";
    assert_eq!(one(crossing, "1 2 3 4")[0].0, NotConvex);
    assert_eq!(one("v 0 0 0\nv 1 0 0\nv .3 .3 0\nv 0 1 0\n", "1 2 3 4"), [(NotConvex, vec![1], vec![3])]);
    // A corner of 180 degrees.
    assert_eq!(one("v 0 0 0\nv 1 0 0\nv .5 .5 0\nv 0 1 0\n", "4 1 2 3"), [(NotConvex, vec![1], vec![3])]);
    assert_eq!(one("v 0 0 0\nv 1 1 1\nv 2 2 2\n", "1 2 3"), [(ZeroArea, vec![1], vec![])]);
    assert_eq!(one("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 1 0\n", "1 2 3 4")[0].0, NotConvex);
}

#[test]
fn slender_and_warped_elements_are_warned_of() {
    let kinds = |text: &str| faults(text).into_iter().map(|fault| fault.0).collect::<Vec<_>>();
    let rectangle = |length: f64| format!("v 0 0 0\nv {length} 0 0\nv {length} 1 0\nv 0 1 0\nf 1 2 3 4\n");
    assert_eq!(kinds(&rectangle(19.9)), []);
    assert_eq!(kinds(&rectangle(20.1)), [MeshFaultKind::AspectRatio { ratio: 20.1 }]);
    // A trapezium with a short side.
    let trapezium = "v 0 0 0\nv 30 0 0\nv 15.5 10 0\nv 14.5 10 0\nf 1 2 3 4\n";
    assert_eq!(kinds(trapezium), [MeshFaultKind::AspectRatio { ratio: 30.0 }]);
    let triangle = |height: f64| format!("v 0 0 0\nv 1 0 0\nv .5 {height} 0\nf 1 2 3\n");
    assert_eq!(kinds(&triangle(0.75_f64.sqrt() / 19.9)), []);
    assert!(matches!(kinds(&triangle(0.75_f64.sqrt() / 20.1))[..], [MeshFaultKind::AspectRatio { .. }]));
    // Two triangles of a square, folded by an angle about its diagonal.
    let folded = |degrees: f64| {
        let (half, radians) = (0.5_f64.sqrt(), degrees.to_radians());
        let [y, z] = [half * radians.cos(), half * radians.sin()];
        format!("v -{half} 0 0\nv 0 -{half} 0\nv {half} 0 0\nv 0 {y} {z}\nf 1 2 3 4\n")
    };
    assert_eq!(kinds(&folded(14.9)), []);
    let [MeshFaultKind::Warp { degrees }] = kinds(&folded(15.1))[..] else { panic!("must be warped") };
    assert!((degrees - 15.1).abs() < 0.2, "{degrees}");
}

#[test]
fn faults_between_elements() {
    use MeshFaultKind::{Branch, OppositeOrientation, SameElement, UnusedNode};
    let fault = (OppositeOrientation, vec![1, 2], vec![2, 3]);
    assert_eq!(faults(&format!("{SQUARE}f 1 2 3 4\nf 2 3 6 5\n")), [fault]);
    let branch = faults(&format!("{SQUARE}v 1 0 1\nf 1 2 3 4\nf 2 5 6 3\nf 2 3 7\n"));
    assert_eq!(branch, [(Branch, vec![1, 2, 3], vec![2, 3])]);
    assert_eq!(branch[0].0.severity(), Severity::Note);
    let same = faults("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 9 9 9\nf 1 2 3\nf 2 1 3\n");
    assert_eq!(same, [(SameElement, vec![1, 2], vec![]), (UnusedNode, vec![], vec![4])]);
    let message = obj::read(&format!("{SQUARE}f 1 2 3 4\nf 2 3 6 5\n")).expect("valid").surface_faults();
    let expected =
        "neighbours have opposite normals, elements 1 2, nodes 2 3, at (1, 0.5, 0); orient the surface";
    assert_eq!(message[0].to_string(), expected);
}

#[test]
fn torn_meshes_and_hanging_nodes_are_found() {
    use MeshFaultKind::{HangingNode, TornMesh};
    let torn = faults(&format!("{SQUARE}v 1 0 1e-10\nv 1 1 0\nf 1 2 3 4\nf 7 5 6 8\n"));
    assert_eq!(torn, [(TornMesh, vec![1, 2], vec![2, 7]), (TornMesh, vec![1, 2], vec![3, 8])]);
    // Two quadrilaterals beside one.
    let vertices = format!("{SQUARE}v 1 .5 0\nv 2 .5 0\n");
    let hanging = faults(&format!("{vertices}f 1 2 3 4\nf 2 5 8 7\nf 7 8 6 3\n"));
    assert_eq!(hanging, [(HangingNode, vec![1, 2], vec![7])]);
    // Shifted a little, it lies within no edge.
    let beside = vertices.replace("v 1 .5 0", "v 1.001 .5 0");
    assert_eq!(faults(&format!("{beside}f 1 2 3 4\nf 2 5 8 7\nf 7 8 6 3\n")), []);
}

#[test]
fn the_search_takes_no_time_by_the_square_of_the_nodes() {
    // A comb of 40000 triangles, each with nodes of its own, that touch at one node each.
    let triangle = |k: usize| format!("v {k} 0 0\nv {} 0 0\nv {k} 1 0\nf -3 -2 -1\n", k + 1);
    let text: Vec<String> = (0..40_000).map(triangle).collect();
    let faults = faults(&text.concat());
    assert_eq!(faults.len(), 39_999);
    assert!(faults.iter().all(|fault| fault.0 == MeshFaultKind::TornMesh));
}
