//! Every kind that takes a function of time reports the instants at which it is not smooth.

use std::sync::Arc;

use lissom_mechanics::elements::{LOADS, SPRINGS};
use lissom_mechanics::joints;
use lissom_mechanics::registry::{Parameter, ParameterType, Parameters, TimeFunction, Value};
use lissom_motion::Vector3;
use lissom_system::{Builder, Placement};

use crate::derivatives::configuration::{Random, sample_parameters};
use crate::derivatives::ports::{attached, joint_attachment};
use crate::derivatives::two_bodies;
use lissom_mechanics::kinematics::NodeId;

/// Smooth except at given instants.
#[derive(Debug)]
struct Broken(Vec<f64>);

impl TimeFunction for Broken {
    fn value(&self, _: f64) -> f64 {
        0.5
    }
    fn first_derivative(&self, _: f64) -> f64 {
        0.0
    }
    fn second_derivative(&self, _: f64) -> f64 {
        0.0
    }
    fn breakpoints(&self) -> Vec<f64> {
        self.0.clone()
    }
}

/// Parameters of a kind in which one function of time after the other is broken, with its name.
fn each_broken(parameters: &[Parameter], random: &mut Random) -> Vec<(&'static str, Parameters)> {
    let is_function =
        |parameter: &&Parameter| matches!(parameter.holds, ParameterType::Function | ParameterType::Size);
    let broken = |parameter: &Parameter| {
        let mut own = sample_parameters(parameters, false, random);
        own.insert(parameter.name, Value::Function(Arc::new(Broken(vec![0.37, 0.61]))));
        (parameter.name, own)
    };
    parameters.iter().filter(is_function).map(broken).collect()
}

fn assert_breakpoints(builder: Builder, kind: &str, parameter: &str) {
    let (system, _) = builder.build(0.0).expect("valid");
    assert_eq!(system.breakpoints(), [0.37, 0.61], "`{parameter}` of {kind}");
}

#[test]
fn loads_and_springs_report_the_kinks_of_their_functions() {
    let mut count = 0;
    for kind in SPRINGS.iter().chain(LOADS) {
        let mut random = Random::new(5);
        for (parameter, parameters) in each_broken(kind.parameters, &mut random) {
            let (mut builder, nodes) = two_bodies(&mut random);
            let attached = attached(&mut builder, kind, nodes, &mut random);
            builder.add_of_kind(kind, attached, &parameters).expect("valid");
            assert_breakpoints(builder, kind.name, parameter);
            count += 1;
        }
    }
    assert!(count >= 5, "{count} functions of time");
}

#[test]
fn drives_report_the_kinks_of_their_functions() {
    let mut count = 0;
    for kind in joints::KINDS {
        let mut random = Random::new(6);
        for (parameter, parameters) in each_broken(kind.parameters, &mut random) {
            let (mut builder, nodes) = two_bodies(&mut random);
            let placement = placement(nodes, &mut random);
            let attachment = joint_attachment(&mut builder, kind, &placement, &mut random);
            builder.add_joint_of_kind("drive", kind, attachment, &parameters).expect("valid");
            assert_breakpoints(builder, kind.name, parameter);
            count += 1;
        }
    }
    assert!(count >= 8, "{count} functions of time");
}

fn placement(nodes: [NodeId; 2], random: &mut Random) -> Placement {
    Placement {
        nodes,
        at: random.vector(),
        at_tip: None,
        axis: Some(Vector3::new(0.2, 0.3, 1.0)),
        second_axis: Some(random.vector()),
    }
}
