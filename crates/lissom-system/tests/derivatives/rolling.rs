//! Wheels with rounded rims, balls, and wheels that creep.

use std::sync::Arc;

use lissom_mechanics::elements::{Attached, SPRINGS};
use lissom_mechanics::joints;
use lissom_mechanics::kinematics::Freedoms;
use lissom_mechanics::registry::{Parameters, TimeFunction, Value};
use lissom_motion::{Motion, Vector3};
use lissom_system::{Builder, Placement};

use crate::derivatives::check;
use crate::derivatives::configuration::Random;

/// Wheels and balls that are pressed into the plane and slide, by both laws of friction, with damping and rolling friction.
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
            .with("dissipation", Value::Number(0.2))
            .with("damping", Value::Number(if given { 0.4 } else { 0.0 }))
            .with("rolling_friction", Value::Number(0.6))
            .with("rolling_rate", Value::Number(2.0))
            .with("rolling_damping", Value::Number(0.3));
        if given {
            parameters.insert("traction", Value::Function(Arc::new(Grip)));
            if radius > 0.0 {
                parameters.insert("roller_angle", Value::Number(1.1));
            }
        } else {
            parameters.insert("friction_coefficient", Value::Number(0.7));
            parameters.insert("slip_velocity", Value::Number(3.0));
        }
        let attached = Attached::to_nodes([base, tip].map(|node| (node, Vector3::zeros())));
        builder.add_of_kind(kind, attached, &parameters).expect("valid");
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

/// Wheels on rails of all profiles that creep, with directions of both kinds: forces depend on the multiplier as well.
#[test]
fn wheels_that_creep_on_rails() {
    let kind = joints::KINDS.iter().find(|kind| kind.name == "wheel_on_rail").expect("there");
    for seed in 0..16_u64 {
        let (is_given, is_small, is_below) = (seed % 2 == 1, seed % 4 >= 2, seed % 8 >= 4);
        let mut random = Random::new(seed + 31);
        let mut builder = Builder::new();
        let plane = random.motion();
        let base = builder.add_node("base", random.motion(), Freedoms::Full);
        let height = if is_below { -0.9 } else { 0.9 };
        let centre = plane.transform_point(&Vector3::new(0.1, height, 0.2));
        let tip =
            builder.add_node("tip", Motion::translation(centre) * random_turn(&mut random), Freedoms::Full);
        let direction = |v: Vector3| Value::Vector(plane.rotation.apply(&v));
        let placement = Placement {
            nodes: [base, tip],
            at: plane.position,
            at_tip: None,
            axis: Some(plane.rotation.apply(&Vector3::x())),
            second_axis: Some(plane.rotation.apply(&Vector3::y())),
        };
        let mut parameters = Parameters::new()
            .with("axle", direction(Vector3::new(if is_below { -1.0 } else { 1.0 }, 0.1, 0.2)))
            .with("friction_coefficient", Value::Number(1.0))
            .with("shear_modulus", Value::Number(4.0))
            .with("kalker", Value::Vector(Vector3::new(0.5, 0.4, 0.2)))
            .with("velocity", direction(Vector3::new(0.0, 0.0, 20.0)))
            .with("wheel_spin", Value::Number(21.0))
            .with("directions", Value::Text((if is_small { "small_angles" } else { "exact" }).to_owned()));
        if is_given {
            parameters.insert("wheel_profile", Value::Function(Arc::new(Parabola(-0.2, -0.3))));
            parameters.insert("rail_profile", Value::Function(Arc::new(Parabola(0.2, -1.1))));
            parameters.insert("tread", Value::Range([-1.0, 1.0]));
        } else {
            parameters.insert("cone_angle", Value::Number(0.2));
            parameters.insert("head_radius", Value::Number(0.8));
        }
        builder.add_joint("joint", kind, &placement, &parameters).expect("valid");
        let (system, state) = builder.build(0.0).expect("valid");
        check("wheel_on_rail", &system, &state, 0.1, &mut random);
    }
}

fn random_turn(random: &mut Random) -> Motion {
    let turn = 0.3 * random.vector();
    Motion::exponential(&lissom_motion::screw(&Vector3::zeros(), &turn))
}

/// a x + b x².
#[derive(Debug)]
struct Parabola(f64, f64);

impl TimeFunction for Parabola {
    fn value(&self, x: f64) -> f64 {
        self.0 * x + self.1 * x * x
    }
    fn first_derivative(&self, x: f64) -> f64 {
        self.0 + 2.0 * self.1 * x
    }
    fn second_derivative(&self, _: f64) -> f64 {
        2.0 * self.1
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
