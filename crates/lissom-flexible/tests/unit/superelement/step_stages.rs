//! Tests of `superelement::step_stages`, a module of it.

use lissom_motion::{Motion, screw};
use nalgebra::DMatrix;

use super::*;
use crate::superelement::{Damping, ReducedMatrices};
use lissom_mechanics::elements::inertia::Gravity;
use lissom_mechanics::kinematics::{
    CoordinateId, CoordinateMotion, Kinematics, MotionChange, NodeId, NodeMotion,
};

/// Three interfaces that translate up to the first stage and rotate about the floating frame, the second of them, up to the
/// other: the longer path counts, with rotations as arcs at the size of the part, 5 m.
#[test]
fn the_way_of_a_step_is_that_of_all_interfaces() {
    let places = [Vector3::new(2.0, 0.0, 0.0), Vector3::zeros(), Vector3::new(0.0, 4.0, 3.0)];
    let matrices = ReducedMatrices {
        mass: DMatrix::identity(18, 18),
        stiffness: DMatrix::identity(18, 18),
        damping: Damping::None,
        preload: Vec::new(),
        geometric: None,
    };
    let gravity = Gravity::constant(Vector3::zeros());
    let element = Part::new((NodeId::first(3).collect(), Vec::new()), (1, &places), matrices, gravity);
    let moving = |spatial: [Vector3; 2]| Kinematics {
        time: 0.0,
        elapsed: 0.0,
        nodes: (places.iter())
            .map(|place| {
                let frame = Motion::translation(*place);
                let twist = frame.adjoint_inverse_times(&screw(&spatial[0], &spatial[1]));
                NodeMotion { twist, ..NodeMotion::at_rest(frame) }
            })
            .collect(),
        coordinates: Vec::new(),
        held: Vec::new(),
        multipliers: Vec::new(),
        units: Vec::new(),
    };
    let straight = moving([Vector3::new(-0.6, 0.0, 0.8), Vector3::zeros()]);
    let turning = moving([Vector3::zeros(), Vector3::new(-0.1, 0.0, 0.0)]);
    let by_stage = [3.0_f64.sqrt(), (0.25_f64 + 3.0 * 0.25).sqrt()];
    for lasting in [[0.1, 0.1], [0.1, 0.3], [-0.2, 0.1], [0.1, -0.4]] {
        let step = StepStages {
            start: &straight,
            stages: [&straight, &turning],
            end: &turning,
            changes: &[],
            durations: [[0.0; STAGES]; STAGES],
            lasting,
            reached: [0.0; STAGES],
            length: 1.0,
        };
        let mut stages = [ElementScratch::default(), ElementScratch::default()];
        for (scratch, at) in stages.iter_mut().zip(step.stages) {
            scratch.enter(&element, at);
        }
        let wanted = (by_stage[0] * lasting[0].abs()).max(by_stage[1] * lasting[1].abs());
        let found = element.way(&step, &stages);
        assert!((found - wanted).abs() < 1e-14, "{lasting:?}: {found}, {wanted}");
    }
}

/// The error of rates is the change of u over the step minus their integral, for rotations that are small and
/// large.
#[test]
fn the_remainder_closes_the_change_over_the_step() {
    let places = [Vector3::zeros(), Vector3::new(2.0, 0.5, -1.0)];
    let matrices = ReducedMatrices {
        mass: DMatrix::identity(13, 13),
        stiffness: DMatrix::identity(13, 13),
        damping: Damping::None,
        preload: Vec::new(),
        geometric: None,
    };
    let gravity = Gravity::constant(Vector3::zeros());
    let element = Part::new(
        (NodeId::first(2).collect(), CoordinateId::first(1).collect()),
        (0, &places),
        matrices,
        gravity,
    );
    let twist = screw(&Vector3::new(0.3, -0.2, 0.5), &Vector3::new(0.4, 0.7, -0.1));
    for size in [1e-5, 2e-4, 0.02, 0.4] {
        let changed = [
            Motion::exponential(&(size * screw(&Vector3::new(1.0, 2.0, 0.5), &Vector3::new(0.3, -0.6, 0.2)))),
            Motion::exponential(
                &(size * screw(&Vector3::new(-0.5, 1.0, 1.5), &Vector3::new(1.1, 0.4, -0.8))),
            ),
        ];
        let state = |part: f64, value: f64| {
            let first = Motion::exponential(&(0.7 * twist));
            let second = first
                * Motion::translation(places[1])
                * Motion::exponential(
                    &(0.2 * screw(&Vector3::new(0.1, 0.3, 0.2), &Vector3::new(0.5, -0.4, 0.9))),
                );
            let frames = [first, second];
            let nodes = frames.iter().zip(&changed).map(|(frame, change)| {
                let frame = if part > 0.0 { *frame * *change } else { *frame };
                NodeMotion { twist, ..NodeMotion::at_rest(frame) }
            });
            Kinematics {
                time: 0.0,
                elapsed: 0.0,
                nodes: nodes.collect(),
                coordinates: vec![CoordinateMotion { value, rate: 0.3, acceleration: 0.0 }],
                held: Vec::new(),
                multipliers: Vec::new(),
                units: Vec::new(),
            }
        };
        let (start, end) = (state(0.0, 0.1), state(1.0, 0.1 + size));
        let changes: Vec<MotionChange> = changed.iter().map(MotionChange::of).collect();
        let step = StepStages {
            start: &start,
            stages: [&start, &end],
            end: &end,
            changes: &changes,
            durations: [[0.0; STAGES]; STAGES],
            lasting: [0.1 * size, 0.3 * size],
            reached: [0.0; STAGES],
            length: 1.0,
        };
        let mut stages = [ElementScratch::default(), ElementScratch::default()];
        for (scratch, at) in stages.iter_mut().zip(step.stages) {
            scratch.enter(&element, at);
        }
        let (mut own, mut last) = (ElementScratch::default(), ElementScratch::default());
        own.enter(&element, &start);
        last.enter(&element, &end);
        element.missed(&step, &mut own, &stages);
        for row in 0..element.size() {
            let wanted = last.displacement[row]
                - own.displacement[row]
                - step.whole([stages[0].rate[row], stages[1].rate[row]]);
            let error = (own.stress[row] - wanted).abs();
            assert!(error < 1e-14 + 1e-9 * size, "{size}, row {row}: {} {wanted}", own.stress[row]);
        }
    }
}
