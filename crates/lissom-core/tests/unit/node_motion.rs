//! Tests of `node_motion`, a module of it.

use lissom_motion::{Rotation, lie_bracket, screw, tangent_rate_times, tangent_times};

use crate::kinematics::split;

use super::*;

/// Pseudo-random numbers between -1 and 1.
fn numbers(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// A fixed node, then nodes with all degrees of freedom, except one with translations only.
fn layout(count: usize, point_mass: usize) -> Layout {
    let mut next = 0;
    let mut layout = Layout { node_rows: vec![[LOCKED; 6]], ..Layout::default() };
    for node in 1..=count {
        let free = if node == point_mass { 3 } else { 6 };
        let mut rows = [LOCKED; 6];
        for row in &mut rows[..free] {
            *row = next;
            next += 1;
        }
        layout.node_rows.push(rows);
    }
    layout.coordinate_count = next as usize;
    layout
}

/// The formulas one node at a time, with the motion's change.
fn reference(
    table: &StageTable,
    from: &NodeMotion,
    own: &Vector6,
    [rate, curvature]: [Vector6; 2],
) -> (NodeMotion, Motion) {
    let straight = from.twist * table.ahead;
    if table.kind == IncrementKind::FromStart {
        let change = Motion::exponential(&(straight + own));
        let to = NodeMotion { frame: from.frame * change, twist: from.twist + rate, acceleration: curvature };
        return (to, change);
    }
    if table.kind == IncrementKind::Inertial {
        let (path, turn) = split(&(straight + own));
        let rotation = Rotation::exponential(&turn);
        let change = Motion::new(rotation, rotation.apply(&path));
        let twist = from.twist + rate;
        let (velocity, spin) = split(&twist);
        let before = split(&from.twist).0;
        let gained = (before - rotation.apply_inverse(&before)) * table.gain - spin.cross(&velocity);
        let acceleration = curvature + screw(&gained, &Vector3::zeros());
        return (NodeMotion { frame: from.frame * change, twist, acceleration }, change);
    }
    let motion = Motion::exponential(own);
    let change = Motion::exponential(&straight) * motion;
    let carried = motion.adjoint_inverse_times(&from.twist);
    let gained = tangent_times(own, &rate);
    let acceleration = if table.kind == IncrementKind::VelocityChange {
        (carried - from.twist + gained) * table.gain
    } else {
        tangent_times(own, &curvature) + tangent_rate_times(own, &rate, &rate)
            - lie_bracket(&gained, &carried)
    };
    (NodeMotion { frame: from.frame * change, twist: carried + gained, acceleration }, change)
}

fn is_near<'a>(left: impl IntoIterator<Item = &'a f64>, right: impl IntoIterator<Item = &'a f64>) -> bool {
    left.into_iter().zip(right).all(|(left, right)| (left - right).abs() < 1e-13 * (1.0 + right.abs()))
}

fn agrees(processor: pulp::Arch, count: usize, point_mass: usize, kind: IncrementKind, size: f64) {
    let mut number = numbers(7);
    let mut vector = || Vector6::from_fn(|_, _| number());
    let layout = layout(count, point_mass);
    let mut nodes: Vec<_> = (0..=count)
        .map(|_| NodeMotion {
            frame: Motion::exponential(&(vector() * 2.0)),
            twist: vector(),
            acceleration: vector(),
        })
        .collect();
    for (node, rows) in nodes.iter_mut().zip(&layout.node_rows) {
        for k in (0..6).filter(|&k| rows[k] == LOCKED) {
            node.twist[k] = 0.0;
        }
    }
    let start = Kinematics {
        time: 0.0,
        elapsed: 0.0,
        nodes,
        coordinates: Vec::new(),
        held: Vec::new(),
        multipliers: Vec::new(),
        units: Vec::new(),
    };
    let mut list = || (0..layout.coordinate_count).map(|_| vector()[0] * size).collect::<Vec<f64>>();
    let (rates, curvatures, increments) = (list(), list(), [list(), list(), list()]);
    let table = StageTable {
        kind,
        ahead: 0.1,
        velocity: [0.7, -1.5, 0.3, 0.0, 0.0, 0.0, 0.0],
        acceleration: [-3.0, 0.2, 1.1, 0.0, 0.0, 0.0, 0.0],
        gain: 4.0,
    };
    let mut moving = Nodes::new(&layout, MAX_STAGES);
    moving.processor = processor;
    moving.enter(1, &table, &start, Known { velocity: &rates, acceleration: &curvatures });
    let mut at = start.clone();
    let mut changes = vec![MotionChange::none(); start.nodes.len()];
    moving.update_nodes(1, &table, &start, &increments, (&mut at, &mut changes));
    assert_eq!((at.nodes[0], changes[0]), (start.nodes[0], MotionChange::none()));
    for (node, rows) in layout.node_rows.iter().enumerate().skip(1) {
        let pick = |values: &[f64]| Vector6::from_fn(|k, _| values.get(rows[k] as usize).map_or(0.0, |v| *v));
        let stages = increments.each_ref().map(|values| pick(values));
        let combine = |known: &[f64], weights: [f64; MAX_STAGES]| {
            stages.iter().zip(weights).fold(pick(known), |sum, (stage, weight)| sum + stage * weight)
        };
        let linear = [combine(&rates, table.velocity), combine(&curvatures, table.acceleration)];
        let (to, change) = reference(&table, &start.nodes[node], &stages[1], linear);
        let (reached, change) = (&at.nodes[node], MotionChange::of(&change));
        let error = reached.frame.relative_to(&to.frame).logarithm();
        assert!(error.amax() < 1e-14, "{processor:?}, {kind:?}, node {node}: {error}");
        assert!(is_near(&reached.twist, &to.twist), "{processor:?}, {kind:?}, node {node}");
        assert!(is_near(&reached.acceleration, &to.acceleration), "{processor:?}, {kind:?}, node {node}");
        assert!(is_near(&changes[node].turn, &change.turn) && is_near(&changes[node].shift, &change.shift));
    }
}

#[test]
fn nodes_side_by_side_move_as_one_by_one() {
    let mut processors = vec![pulp::Arch::Scalar, pulp::Arch::new()];
    #[cfg(target_arch = "x86_64")]
    processors.extend(pulp::x86::V3::try_new().map(pulp::Arch::V3));
    for processor in processors {
        for (count, point_mass) in [(1, 0), (8, 0), (21, 18), (9, 9)] {
            for kind in [
                IncrementKind::FromStart,
                IncrementKind::RelativeToDrift,
                IncrementKind::VelocityChange,
                IncrementKind::Inertial,
            ] {
                for size in [0.0, 1e-3, 0.1, 1.0] {
                    agrees(processor, count, point_mass, kind, size);
                }
            }
        }
    }
}
