//! Kinds of solid elements: functions, rules, faces and extrapolation of every row of the table.

use lissom_mesh::kinds::{Natural, Rule, SOLID_KINDS, SolidKind};
use lissom_motion::Vector3;

fn functions(kind: &SolidKind, place: Natural) -> (Vec<f64>, Vec<Vector3>) {
    let count = kind.node_count();
    let (mut values, mut slopes) = (vec![f64::NAN; count], vec![Vector3::zeros(); count]);
    (kind.functions)(place, &mut values, &mut slopes);
    (values, slopes)
}

#[test]
fn functions_are_one_at_their_node_and_slopes_are_their_derivatives() {
    for kind in SOLID_KINDS {
        for i in 0..kind.node_count() {
            for (j, value) in functions(kind, kind.node(i)).0.iter().enumerate() {
                assert!((value - f64::from(u8::from(i == j))).abs() < 1e-14, "{}: {i}, {j}", kind.word);
            }
        }
        let (place, step) = ([0.21, 0.13, 0.34], 1e-6);
        let slopes = functions(kind, place).1;
        for k in 0..3 {
            let moved = |by: f64| {
                let mut moved = place;
                moved[k] += by;
                functions(kind, moved).0
            };
            let (after, before) = (moved(step), moved(-step));
            for (i, own) in slopes.iter().enumerate() {
                let slope = (after[i] - before[i]) / (2.0 * step);
                assert!((slope - own[k]).abs() < 1e-9, "{}: {i}, {k}", kind.word);
            }
        }
    }
}

/// Polynomials that both rules integrate exactly: linear ones, squares of each coordinate, and products of squares as far as rules allow.
#[test]
fn both_rules_have_the_same_integrals() {
    for kind in SOLID_KINDS {
        let integral = |(at, count): Rule, of: &dyn Fn(Natural) -> f64| {
            (0..count).map(at).map(|(place, weight)| weight * of(place)).sum::<f64>()
        };
        let polynomials: [&dyn Fn(Natural) -> f64; 5] =
            [&|_| 1.0, &|p| p[0] + 2.0 * p[1] - p[2], &|p| p[0] * p[0], &|p| p[1] * p[1], &|p| p[2] * p[2]];
        let squares: [&dyn Fn(Natural) -> f64; 2] =
            [&|p| (p[0] * p[2]).powi(2), &|p| (p[0] * p[1] * p[2]).powi(2)];
        let products = match kind.word {
            "hexahedron" => 2,
            "wedge" => 1,
            _ => 0,
        };
        for (k, of) in polynomials.into_iter().chain(squares.into_iter().take(products)).enumerate() {
            let [coarse, fine] = [kind.points, kind.fine].map(|rule| integral(rule, of));
            assert!((coarse - fine).abs() < 1e-14, "{} {k}: {coarse} {fine}", kind.word);
        }
    }
}

/// The sum of the functions is 1; elements that are inverted have no shares.
#[test]
fn shares_add_up_to_the_volume() {
    for kind in SOLID_KINDS {
        let positions: Vec<Vector3> = (0..kind.node_count()).map(|i| Vector3::from(kind.node(i))).collect();
        let shares = kind.shares(&positions).expect("not inverted");
        let volume = (0..kind.fine.1).map(|k| (kind.fine.0)(k).1).sum::<f64>();
        assert!((shares.iter().sum::<f64>() - volume).abs() < 1e-14, "{}", kind.word);
        let inverted: Vec<Vector3> = positions.iter().map(|p| Vector3::new(-p.x, p.y, p.z)).collect();
        assert!(kind.shares(&inverted).is_err(), "{}", kind.word);
    }
}

#[test]
fn faces_point_outward_close_the_element_and_have_the_middles_of_their_sides() {
    for kind in SOLID_KINDS {
        let centre =
            kind.corners.iter().map(|own| Vector3::from(*own)).sum::<Vector3>() / kind.corners.len() as f64;
        let mut sides = Vec::new();
        for face in kind.faces {
            let p: Vec<Vector3> = face.iter().map(|&node| Vector3::from(kind.node(node))).collect();
            let corners = face.len() / 2;
            for i in 0..corners {
                assert_eq!(p[corners + i], 0.5 * (p[i] + p[(i + 1) % corners]), "{}: {face:?}", kind.word);
                sides.push([face[i], face[(i + 1) % corners]]);
            }
            assert!((p[1] - p[0]).cross(&(p[2] - p[0])).dot(&(p[0] - centre)) > 0.0, "{face:?}");
        }
        for [from, to] in &sides {
            assert_eq!(sides.iter().filter(|other| **other == [*to, *from]).count(), 1, "{}", kind.word);
        }
        assert_eq!(sides.len(), 2 * kind.edges.len());
    }
}

/// Stresses that are constant or linear are found at every node.
#[test]
fn extrapolation_is_exact_for_linear_fields() {
    for kind in SOLID_KINDS {
        let (at, count) = kind.stress_points;
        let field = |p: Natural| 1.0 + 2.0 * p[0] - 3.0 * p[1] + 0.5 * p[2];
        for node in 0..kind.node_count() {
            let place = kind.node(node);
            let found: f64 = (0..count).map(|k| (kind.stress_share)(k, place) * field(at(k))).sum();
            assert!((found - field(place)).abs() < 1e-13, "{}: {node}", kind.word);
        }
    }
}
