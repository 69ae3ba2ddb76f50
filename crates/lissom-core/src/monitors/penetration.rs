//! Whether solids of contact sets penetrate each other by less than half of their size, beyond which they leave on the other side, and as
//! their forces explain.

use super::limits::OVERLAP;
use super::monitor::{Accepted, Beginning, Monitor};
use crate::errors::{Warning, warn};
use crate::kinematics::{Kinematics, NodeId};
use crate::system::{State, System, Touch};

/// Penetration that no force explains, as a multiple of the one that a force explains, at which it is reported.
const UNEXPLAINED: f64 = 10.0;
/// The least of those, as a fraction of the size of both solids: forces of parts that lift off vanish.
const EXPLAINED: f64 = 1e-3;

/// Change of a penetration in a step, relative to it, below which the parts rest.
const AT_REST: f64 = 1e-3;

/// Reports the first touch that is too deep. Has no state.
struct Penetration;

pub(super) fn begin(beginning: &Beginning<'_>) -> Option<Box<dyn Monitor>> {
    let has_sets = !beginning.problem.system.contacts().is_empty();
    has_sets.then(|| Box::new(Penetration) as Box<dyn Monitor>)
}

impl Monitor for Penetration {
    fn accept(&mut self, step: &mut Accepted<'_>, warnings: &mut Vec<Warning>) {
        if let Some(warning) = too_deep(step.problem.system, step.end) {
            warn(warnings, warning);
        }
        warnings_of_sunk(step, warnings);
    }
}

/// Reports the first touch of a set that rests deeper than its force explains: what appears within a step is not pressed apart.
fn warnings_of_sunk(step: &Accepted<'_>, warnings: &mut Vec<Warning>) {
    let rests = |touch: &Touch| {
        let before = step.start.touches.iter().find(|before| before.key == touch.key);
        before.is_some_and(|before| (touch.gap - before.gap).abs() < AT_REST * touch.relief)
    };
    let is_sunk = |touch: &&Touch| {
        let explained = (-touch.gap - touch.relief).max(EXPLAINED * touch.deepest);
        touch.relief > UNEXPLAINED * explained && rests(touch)
    };
    let Some(touch) = step.end.touches.iter().find(is_sunk) else { return };
    let system = step.problem.system;
    let node = system.contacts().parts[touch.key.parts[1] as usize].node;
    let part = system.layout().name_of_node(node).to_owned();
    warn(warnings, Warning::ContactSunk { time: step.end.kinematics.time, part, depth: -touch.gap });
}

/// The first touch that is deeper than half of the size of its solids.
fn too_deep(system: &System, state: &State) -> Option<Warning> {
    let parts = &system.contacts().parts;
    let touches = state
        .touches
        .iter()
        .map(|touch| (parts[touch.key.parts[1] as usize].node, [touch.gap, touch.deepest]));
    let (part, [depth, limit]) = deepest_of(1.0, system, touches)?;
    Some(Warning::ContactTooDeep { time: state.kinematics.time, part, depth, limit })
}

/// The first solids that overlap at the start of a motion, as no weight or preload presses them into each other.
pub(crate) fn overlap(system: &System, at: &Kinematics) -> Option<Warning> {
    let touching = system.contacts().touching(at);
    let (part, [depth, _]) = deepest_of(OVERLAP, system, touching.into_iter())?;
    Some(Warning::ContactOverlaps { time: at.time, part, depth })
}

/// The first of these touches, by tip, gap and depth of both solids, that is deeper than a share of half of that depth.
fn deepest_of(
    share: f64,
    system: &System,
    mut touches: impl Iterator<Item = (NodeId, [f64; 2])>,
) -> Option<(String, [f64; 2])> {
    let (node, [gap, deepest]) = touches.find(|(_, [gap, deepest])| *gap < -0.5 * share * deepest)?;
    Some((system.layout().name_of_node(node).to_owned(), [-gap, 0.5 * deepest]))
}
