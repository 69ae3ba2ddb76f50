//! Tests of `signals::frame_quantity`, a module of it.

use lissom_motion::{Rotation, Vector3, Vector6};

use super::*;
use crate::kinematics::NodeMotion;

const ALL: [Of; 9] = [
    Of::Position,
    Of::Displacement,
    Of::Rotation,
    Of::Quaternion,
    Of::CardanAngles,
    Of::Velocity,
    Of::AngularVelocity,
    Of::Acceleration,
    Of::Pose,
];

fn waves(seed: f64) -> Vector6 {
    Vector6::from_fn(|k, _| (seed + 1.7 * k as f64).sin())
}

fn motions() -> Kinematics {
    let node = |k: usize| {
        let seed = 2.3 * k as f64;
        NodeMotion {
            frame: Motion::exponential(&waves(seed)),
            twist: waves(seed + 0.4),
            acceleration: waves(seed + 0.9),
        }
    };
    Kinematics {
        time: 0.0,
        elapsed: 0.0,
        nodes: (0..4).map(node).collect(),
        coordinates: Vec::new(),
        held: Vec::new(),
        multipliers: Vec::new(),
        units: Vec::new(),
    }
}

/// Derivative by differences of sixth order.
fn by_differences(function: impl Fn(f64) -> f64) -> f64 {
    let step = 2e-3;
    let pair = |k: f64| function(k * step) - function(-k * step);
    (0.75 * pair(1.0) - 0.15 * pair(2.0) + pair(3.0) / 60.0) / step
}

#[test]
fn gradients_are_those_of_differences() {
    let at = motions();
    let frame = |node: usize| CarriedFrame {
        node: NodeId::new(node),
        offset: Motion::exponential(&waves(node as f64)),
    };
    let start = Motion::exponential(&waves(5.0));
    for of in ALL {
        for (observer, axes) in
            [(None, None), (Some(2), None), (None, Some(3)), (Some(2), Some(3)), (Some(1), Some(2))]
        {
            let own = FrameQuantity::new(of, frame(1), observer.map(frame), axes.map(frame), start);
            for component in 0..own.component_count() {
                let gradient = own.gradient(component, &at);
                let total = |node: usize, k: usize, parts: &[f64]| -> f64 {
                    let slots = own.nodes().iter().enumerate().filter(|&(_, own)| own.index() == node);
                    slots.map(|(slot, _)| parts[6 * slot + k]).sum()
                };
                for (node, k) in (1..4).flat_map(|node| (0..6).map(move |k| (node, k))) {
                    let along = |change: f64| Vector6::ith(k, change);
                    let moved = |change: &dyn Fn(&mut NodeMotion)| {
                        let mut at = at.clone();
                        change(&mut at.nodes[node]);
                        own.values(&at)[component]
                    };
                    let found = [
                        by_differences(|e| {
                            moved(&|node| node.frame = node.frame * Motion::exponential(&along(e)))
                        }),
                        by_differences(|e| moved(&|node| node.twist += along(e))),
                        by_differences(|e| moved(&|node| node.acceleration += along(e))),
                    ];
                    let exact = [gradient.by_place, gradient.by_rate, gradient.by_acceleration]
                        .map(|parts| total(node, k, &parts));
                    for (exact, found) in exact.into_iter().zip(found) {
                        assert!(
                            (exact - found).abs() < 1e-9,
                            "{of:?} {component} of node {node}, direction {k}: {exact} but difference {found}"
                        );
                    }
                }
            }
        }
    }
}

#[test]
fn logarithms_are_those_of_rotations() {
    let axis = Vector3::new(0.3, -0.5, 0.8).normalize();
    for angle in [0.0, 1e-9, 1e-3, 0.019, 0.021, 0.5, 2.0, 3.1, 3.3, 6.0] {
        let rotation = Rotation::exponential(&(angle * axis));
        let found = Vector3::from(logarithm(rotation.quaternion()));
        assert!((found - rotation.logarithm()).norm() < 1e-14, "{angle}: {found}");
    }
}
