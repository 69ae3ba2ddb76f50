//! Tests of `analyseses::names`, a module of it.

use super::*;

fn node(name: &str, z: f64, displacement: [f64; 3], rotation: [f64; 3]) -> NodeShape {
    let complex = |own: [f64; 3]| own.map(Complex64::from);
    let (displacement, rotation) = (complex(displacement), complex(rotation));
    NodeShape { node: name.to_owned(), position: [0.0, 0.0, z], displacement, rotation }
}

#[test]
fn rotations_of_the_nodes_of_a_shell_alone_are_named() {
    let shape = |names: [&str; 3]| names.map(|name| node(name, 0.1, [1e-4, 0.0, 0.0], [0.0, 1.0, 0.0]));
    let named = |names: [&str; 3]| {
        let mut shape = shape(names);
        shape.iter_mut().zip([0.0, 0.5, 1.0]).for_each(|(node, z)| node.position[2] = z);
        super::names(&[shape.to_vec()], &[BTreeMap::from([("film".to_owned(), 1.0)])], |_| false)
    };
    assert_eq!(
        named(["film@0.0,0.0", "film@0.5,0.0", "film@1.0,0.0"]),
        ["1st vibration of directors of `film`"]
    );
    assert_eq!(named(["film@1", "film@2", "film@3"]), ["1st vibration of directors of `film`"]);
    assert_eq!(named(["film.start", "film@0.5000", "film.end"]), ["1st bending of `film` along x"]);
}

/// A plate that is twisted, and one that is bent.
#[test]
fn torsion_of_plates_is_named() {
    let plate = |lift: fn(f64, f64) -> f64| {
        let nodes = (0..27).map(|k| (f64::from(k / 3) / 8.0, f64::from(k % 3) / 8.0));
        let own = |(x, y)| NodeShape {
            position: [x, y, 0.0],
            ..node(&format!("roof@{x},{y}"), 0.0, [0.0, 0.0, lift(x, y - 0.125)], [0.1, 0.1, 0.0])
        };
        super::names(&[nodes.map(own).collect()], &[BTreeMap::from([("roof".to_owned(), 1.0)])], |_| false)
    };
    assert_eq!(plate(|x, y| (x - 0.5) * y), ["1st torsion of `roof`"]);
    assert_eq!(plate(|x, y| (x - 0.5) * (x - 0.5) + 0.1 * y), ["1st bending of `roof` along z"]);
}

#[test]
fn modes_are_named_by_part_direction_and_number() {
    let bent = |u: [f64; 3], r: [f64; 3]| {
        vec![
            node("tower.start", 0.0, [0.0; 3], [0.0; 3]),
            node("tower.end", 10.0, u, r),
            node("hub", 10.0, u, r),
        ]
    };
    let share = |tower: f64, hub: f64| BTreeMap::from([("tower".to_owned(), tower), ("hub".to_owned(), hub)]);
    let shapes = [
        bent([1.0, 0.1, 0.0], [0.0, 0.1, 0.0]),
        bent([0.0, 1.0, 0.0], [0.1, 0.0, 0.0]),
        bent([-1.0, 0.0, 0.1], [0.0, 0.1, 0.0]),
        bent([0.7, 0.7, 0.0], [0.1, 0.1, 0.0]),
        bent([0.0, 0.0, 0.01], [0.0, 0.0, 1.0]),
        bent([0.0, 0.0, 1.0], [0.0, 0.0, 0.0]),
        bent([0.0, 0.0, 0.01], [0.0, 2.0, 0.0]),
    ];
    let mut shares = vec![share(0.9, 0.1); 6];
    shares[1] = share(0.5, 0.4);
    shares.push(share(0.1, 0.9));
    assert_eq!(
        names(&shapes, &shares, |_| false),
        [
            "1st bending of `tower` along x",
            "1st bending of `tower`, `hub` along y",
            "2nd bending of `tower` along x",
            "1st bending of `tower` along x and y",
            "1st torsion of `tower`",
            "1st extension of `tower`",
            "1st rotation of `hub` about y",
        ]
    );
    let numbers: Vec<String> = [1, 2, 3, 4, 11, 12, 13, 21, 102, 113].into_iter().map(ordinal).collect();
    assert_eq!(numbers, ["1st", "2nd", "3rd", "4th", "11th", "12th", "13th", "21st", "102nd", "113th"]);
}
