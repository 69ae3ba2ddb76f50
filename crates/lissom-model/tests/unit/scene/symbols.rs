use super::super::Scene;
use super::super::places::Placed;
use super::*;
use crate::lower::build;
use crate::lower::registry::registry;

/// Both wheels have the offset 0.1506 m, to both sides.
#[test]
fn wheels_on_rails_stand_at_their_offset() {
    let text = include_str!("../../../../../examples/wheelset.toml");
    let document = Document::parse(text, "wheelset.toml", &registry()).expect("it is right");
    let built = build(&document, &[]).expect("it is right");
    let scene = Scene::of(&document, &Placed::as_built(&built));
    for (joint, offset) in [("left", 0.1506), ("right", -0.1506)] {
        let mut wheels = scene.symbols.iter().filter(|own| own.name == joint && own.anchor.node != GROUND);
        let place = wheels.next().expect("there is a wheel").anchor.position;
        assert!((place[0] - offset).abs() < 1e-9 && place[1].abs() + place[2].abs() < 1e-9, "{place:?}");
    }
}
