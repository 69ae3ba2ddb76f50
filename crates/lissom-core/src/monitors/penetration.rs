//! Whether solids in contact penetrate each other by less than half of their size: deeper, they leave on the other side.

use super::monitor::{Accepted, Beginning, Monitor};
use crate::errors::{Warning, warn};
use crate::kinematics::{GROUND, Kinematics, NodeId};
use crate::system::{State, System, Touch};

/// Largest plausible penetration at the start, as a fraction of half the size of the two solids or of the range of a stop.
const OVERLAP: f64 = 0.1;

/// Penetration that no force explains, as a multiple of the one that a force explains, at which it is reported.
const UNEXPLAINED: f64 = 10.0;
/// The least of those, as a fraction of the size of both solids: forces of parts that lift off vanish.
const EXPLAINED: f64 = 1e-3;

/// Change of a penetration in a step, relative to it, below which the parts rest.
const AT_REST: f64 = 1e-3;

/// Reports the first contact that is too deep. Has no state.
struct Penetration;

pub(super) fn begin(beginning: &Beginning<'_>) -> Option<Box<dyn Monitor>> {
    let system = beginning.problem.system;
    let mut springs = system.elements_with(|own| own.spring);
    let is_limited =
        !system.contacts().is_empty() || springs.any(|spring| spring.least_elongation().is_some());
    is_limited.then(|| Box::new(Penetration) as Box<dyn Monitor>)
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

/// The first contact that is deeper than half of the size of its solids.
fn too_deep(system: &System, state: &State) -> Option<Warning> {
    let at = &state.kinematics;
    let parts = &system.contacts().parts;
    let touches = state
        .touches
        .iter()
        .map(|touch| (parts[touch.key.parts[1] as usize].node, [touch.gap, touch.deepest]));
    let (part, [depth, limit]) = beyond(1.0, system, at).or_else(|| deepest_of(1.0, system, touches))?;
    Some(Warning::ContactTooDeep { time: at.time, part, depth, limit })
}

/// The first contact whose solids overlap at the start of a motion, as no weight or preload presses them into each other.
pub(crate) fn overlap(system: &System, at: &Kinematics) -> Option<Warning> {
    let touching = system.contacts().touching(at);
    let of_set = || deepest_of(OVERLAP, system, touching.into_iter());
    let (part, [depth, _]) = beyond(OVERLAP, system, at).or_else(of_set)?;
    Some(Warning::ContactOverlaps { time: at.time, part, depth })
}

/// A rope that is longer than its way by this fraction at the start is reported.
const SLACK: f64 = 0.05;

/// The first joint that starts beyond its stops, as no weight or preload presses it into them.
pub(crate) fn beyond_stop(system: &System, at: &Kinematics) -> Option<Warning> {
    let mut stops = system.elements_with(|own| own.spring).filter_map(|spring| spring.beyond_stop(at));
    let (coordinate, [depth, _]) = stops.find(|(_, [depth, range])| *depth > OVERLAP * range)?;
    let coordinate = system.layout().coordinate_names[coordinate.index()].clone();
    Some(Warning::BeyondStop { time: at.time, coordinate, depth })
}

/// The first rope that is much longer at the start than the way along its points.
pub(crate) fn slack_rope(system: &System, at: &Kinematics) -> Option<Warning> {
    system.elements_with(|own| own.spring).find_map(|rope| {
        let [slack, length] = rope.slack(at)?;
        let name = |node| system.layout().name_of_node(node).to_owned();
        let parts = rope.unknowns().nodes.iter().copied().filter(|&node| node != GROUND).map(name);
        let parts = parts.collect::<Vec<_>>().join("` and `");
        (slack > SLACK * length).then_some(Warning::RopeSlack { time: at.time, parts, slack, length })
    })
}

/// A part with a contact that is deeper than a share of half of the size of its solids, with its depth and that half.
fn beyond(share: f64, system: &System, at: &Kinematics) -> Option<(String, [f64; 2])> {
    system.elements_with(|own| own.spring).find_map(|spring| {
        let least = spring.least_elongation()?;
        if spring.capabilities().laws.is_some_and(|laws| laws.is_idle(at)) {
            return None;
        }
        let [gap, ..] = spring.spring_motion(at);
        let named = |node| system.layout().name_of_node(node).to_owned();
        let parts = spring.unknowns().nodes.iter().copied();
        let part = || parts.filter(|&node| node != GROUND).map(named).next_back().unwrap_or_default();
        (gap < share * least).then(|| (part(), [-gap, -least]))
    })
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
