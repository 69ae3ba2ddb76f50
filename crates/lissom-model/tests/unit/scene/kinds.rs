//! Tests of `scene::kinds`, a module of it.

use super::*;
use crate::lower::registry::registry;

#[test]
fn every_registered_kind_has_a_symbol_that_is_there() {
    use lissom_motion::Vector3;
    let registry = registry();
    let kinds = registry.joints.iter().chain(&registry.springs).chain(&registry.loads);
    let axes = Axes::of(&Vector3::new(1.0, 2.0, -0.5), None);
    for kind in kinds {
        let name = kind.name;
        let found = drawn(name).unwrap_or_else(|| panic!("`{name}` has no symbol: give it one in this file"));
        if let Drawn::Solids(solids) | Drawn::WithRod(solids) = found {
            let solids = solids(&[axes, axes]).concat();
            assert!(!solids.is_empty(), "{name}");
            for solid in solids {
                assert!(solid.size[0] > 0.0 && solid.size.iter().all(|size| *size >= 0.0), "{name}");
                let reach = Vector3::from(solid.place).norm();
                assert!(reach < 4.0, "{name}: {reach}");
                assert!((Vector3::from(solid.axis).norm() - 1.0).abs() < 1e-12, "{name}");
            }
        }
    }
    assert!(drawn("no such kind").is_none());
}

#[test]
fn symbols_of_joints_differ() {
    let registry = registry();
    let axes = Axes::of(&lissom_motion::Vector3::x(), None);
    let mut seen: Vec<(String, &str)> = Vec::new();
    for kind in registry.joints {
        let Some(Drawn::Solids(solids) | Drawn::WithRod(solids)) = drawn(kind.name) else { continue };
        let text = format!("{:?}", solids(&[axes, axes]));
        if let Some((_, other)) = seen.iter().find(|(known, _)| *known == text) {
            // They lock the same motions, one with a coordinate and one without.
            assert_eq!([*other, kind.name], ["inline", "point_on_line"]);
        }
        seen.push((text, kind.name));
    }
}
