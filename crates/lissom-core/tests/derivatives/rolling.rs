//! Wheels with rounded rims, balls, and wheels that creep.

use std::sync::Arc;

use lissom_core::elements::{Attached, SPRINGS};
use lissom_core::joints;
use lissom_core::registry::{Parameters, TimeFunction, Value};
use lissom_core::system::{Builder, Freedoms, Placement};
use lissom_motion::{Motion, Vector3};

use crate::check;
use crate::configuration::Random;

/// Wheels that are pressed into the plane and slide, by both laws of friction.
#[test]
fn wheels_that_yield_and_slip() {
    let kind = SPRINGS.iter().find(|kind| kind.name == "rolling_contact").expect("there");
    for (seed, (radius, rim, given)) in
        [(1.2, 0.0, false), (0.9, 0.3, false), (0.0, 1.4, false), (1.1, 0.2, true)].into_iter().enumerate()
    {
        let mut random = Random::new(seed as u64 + 15);
        let mut builder = Builder::new();
        let base = builder.add_node("base", random.motion(), Freedoms::Full);
        let centre = builder.initial_frame(base).transform_point(&Vector3::new(0.2, 0.1, 0.7));
        let tip = builder.add_node("tip", Motion::translation(centre), Freedoms::Full);
        let axes = builder.initial_frame(base).rotation;
        let mut parameters = Parameters::new()
            .with("normal", Value::Vector(axes.apply(&Vector3::z())))
            .with("wheel_axis", Value::Vector(axes.apply(&Vector3::new(0.3, 1.0, 0.2))))
            .with("radius", Value::Number(radius))
            .with("rim", Value::Number(rim))
            .with("stiffness", Value::Number(3.0))
            .with("dissipation", Value::Number(0.2));
        if given {
            parameters.insert("traction", Value::Function(Arc::new(Grip)));
        } else {
            parameters.insert("friction_coefficient", Value::Number(0.7));
            parameters.insert("slip_velocity", Value::Number(3.0));
        }
        let attached = Attached::TwoNodes([base, tip], [Vector3::zeros(); 2]);
        (kind.build)(&mut builder, attached, &parameters).expect("valid");
        let (system, state) = builder.build(0.0).expect("valid");
        check("rolling_contact", &system, &state, 0.1, &mut random);
    }
}

/// x exp(-x).
#[derive(Debug)]
struct Grip;

impl TimeFunction for Grip {
    fn value(&self, x: f64) -> f64 {
        x * (-x).exp()
    }
    fn first_derivative(&self, x: f64) -> f64 {
        (1.0 - x) * (-x).exp()
    }
    fn second_derivative(&self, x: f64) -> f64 {
        (x - 2.0) * (-x).exp()
    }
}

#[test]
fn round_and_creeping_wheels() {
    let kind = joints::KINDS.iter().find(|kind| kind.name == "rolling").expect("there");
    for (seed, (rim, creep, is_ball)) in
        [(0.3, 0.0, false), (0.0, 0.4, false), (0.2, 0.7, false), (0.9, 0.0, true), (0.9, 0.5, true)]
            .into_iter()
            .enumerate()
    {
        let mut random = Random::new(seed as u64 + 5);
        let mut builder = Builder::new();
        let plane = random.motion();
        let base = builder.add_node("base", random.motion(), Freedoms::Full);
        let centre = plane.transform_point(&Vector3::new(0.3, -0.2, -0.9));
        let tip = builder.add_node(
            "tip",
            Motion::translation(centre)
                * Motion::exponential(
                    &(0.3 * random.screw())
                        .map_with_location(|row, _, value| if row < 3 { 0.0 } else { value }),
                ),
            Freedoms::Full,
        );
        let placement = Placement {
            nodes: [base, tip],
            at: plane.position,
            at_tip: None,
            axis: Some(plane.rotation.apply(&Vector3::z())),
            second_axis: None,
        };
        let axis = plane.rotation.apply(&Vector3::new(0.3, 1.0, 0.4));
        let mut parameters = Parameters::new()
            .with("wheel_axis", Value::Vector(axis))
            .with("rim", Value::Number(rim))
            .with("creep", Value::Number(creep));
        if is_ball {
            parameters.insert("radius", Value::Number(0.0));
        }
        builder.add_joint("joint", kind, &placement, &parameters).expect("valid");
        let (system, state) = builder.build(0.0).expect("valid");
        check("rolling", &system, &state, 0.3, &mut random);
    }
}
