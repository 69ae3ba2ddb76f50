use super::super::places::Placed;
use super::super::{Form, Scene, Symbol};
use crate::document::Document;
use crate::lower::build;
use crate::lower::registry::registry;

fn symbols(text: &str, name: &str) -> Vec<Symbol> {
    let document = Document::parse(text, "model.toml", &registry()).expect("it is right");
    let built = build(&document, &[]).expect("it is right");
    let scene = Scene::of(&document, &Placed::as_built(&built));
    scene.symbols.into_iter().filter(|symbol| symbol.name == name).collect()
}

#[test]
fn wheels_rails_and_discs_have_the_dimensions_of_their_data() {
    let wheelset = include_str!("../../../../../examples/wheelset.toml");
    let found = symbols(wheelset, "left");
    assert_eq!(found.len(), 2, "a rail and a wheel");
    assert!(found.iter().all(|symbol| symbol.unit == Some(1.0)));
    let radii: Vec<f64> = (found[1].solids.iter())
        .filter(|solid| solid.form == Form::Cylinder)
        .map(|solid| solid.size[0])
        .collect();
    let document = Document::parse(wheelset, "wheelset.toml", &registry()).expect("it is right");
    let joint = document.joints.iter().find(|joint| joint.name.value == "left").expect("it is there");
    let radius = joint.parameters.number("radius").expect("it is given");
    assert!(radii.iter().filter(|size| (*size - radius).abs() < 0.02 * radius).count() >= 8, "{radii:?}");
    let disc = symbols(include_str!("../../../../../examples/rolling-disc.toml"), "floor");
    let ring = disc[0].solids.iter().find(|solid| solid.form == Form::Ring).expect("it has a rim");
    assert!((ring.size[0] + ring.size[1] - 0.2).abs() < 1e-12, "{ring:?}");
}

/// The rope lies on the sheave along its arc, and on the drum it begins at the tangent point, which the ground carries.
#[test]
fn ropes_are_drawn_around_their_sheaves() {
    let text = "lissom = 1\n[bodies.drum]\nmass = 1\ninertia = [1, 1, 1]\nposition = [-1, 0, 0]\n[point_masses.load]\nmass = 1\n\
         position = [0.5, 0, -3]\n[joints.axle]\nkind = \"revolute\"\nbase = \"ground\"\ntip = \"drum\"\naxis = [0, 1, 0]\n\
         [springs.rope]\nkind = \"rope\"\nstiffness = 1\nalong = [\n\
         { on = \"drum\", radius = 0.5, axis = [0, 1, 0], sense = \"positive\", joint = \"axle\" },\n\
         { on = \"ground\", at = [0, 0, 0], radius = 0.5, axis = [0, 1, 0] }, { on = \"load\" }]\n\
         [analysis]\nkind = \"dynamics\"\nend = 1\nstep = 0.1\n";
    let document = Document::parse(text, "model.toml", &registry()).expect("it is right");
    let built = build(&document, &[]).expect("it is right");
    let scene = Scene::of(&document, &Placed::as_built(&built));
    let points: Vec<_> = scene.rods.iter().map(|rod| rod.anchors[0]).collect();
    assert_eq!(points.len(), 11, "ten points on the arc of 90 degrees, and the drum");
    let on = |anchor: &super::Anchor, x: f64| (anchor.position[0] - x).hypot(anchor.position[2]);
    assert!((on(&points[0], -1.0) - 0.5).abs() < 1e-12 && (points[0].position[2] - 0.5).abs() < 1e-12);
    assert!(points[0].node == lissom_mechanics::kinematics::GROUND);
    assert!(points[1..].iter().all(|point| (on(point, 0.0) - 0.5).abs() < 1e-12));
    assert!((points[10].position[0] - 0.5).abs() < 1e-12, "{:?}", points[10]);
    let wheels = scene.symbols.iter().filter(|own| own.name == "rope" && own.unit == Some(1.0)).count();
    assert_eq!(wheels, 2, "a drum and a sheave");
}

#[test]
fn gears_have_the_ratio_between_their_axes() {
    let body = |name: &str, x: f64| {
        format!("[bodies.{name}]\nmass = 1\ninertia = [1, 1, 1]\nposition = [{x}, 0, 0]\n")
    };
    let joint = |name: &str| {
        format!(
            "[joints.{name}_axle]\nkind = \"revolute\"\nbase = \"ground\"\ntip = \"{name}\"\naxis = [0, 0, 1]\n"
        )
    };
    let gear = "[joints.mesh]\nkind = \"gear\"\njoint = \"a_axle\"\nother = \"b_axle\"\nratio = -2\n";
    let end = "[analysis]\nkind = \"dynamics\"\nend = 1\nstep = 0.1\n";
    let text = [
        String::from("lissom = 1\n"),
        body("a", 0.0),
        body("b", 0.3),
        joint("a"),
        joint("b"),
        gear.into(),
        end.into(),
    ]
    .concat();
    let found = symbols(&text, "mesh");
    let radius = |symbol: &Symbol| {
        symbol
            .solids
            .iter()
            .filter(|solid| solid.form == Form::Block)
            .map(|tooth| tooth.place[0].hypot(tooth.place[1]))
            .fold(0.0, f64::max)
    };
    assert!((radius(&found[0]) - 0.2).abs() < 1e-9 && (radius(&found[1]) - 0.1).abs() < 1e-9);
}
