//! Whether laws and data of elements, and values of signals, stay within their limits.

use super::monitor::{Accepted, Beginning, Monitor, NOTEWORTHY};
use crate::elements::{Limit, LimitKind, Place, Validity};
use crate::errors::{Warning, warn};
use crate::kinematics::{Kinematics, NodeId, Subject};
use crate::system::System;

/// Limits that are checked on every accepted step, and the multiple of them that is reported.
const OF_STEPS: [(LimitKind, f64); 11] = [
    (LimitKind::Deformation, 1.0),
    (LimitKind::Spin, 1.0),
    (LimitKind::Load, 1.0),
    (LimitKind::Moment, 1.0),
    (LimitKind::LeftOut, 1.0),
    (LimitKind::Depth, 1.0),
    (LimitKind::TyreLoad, 1.0),
    (LimitKind::TyreDeflection, 1.0),
    (LimitKind::TyreRoad, 1.0),
    (LimitKind::Hollow, NOTEWORTHY),
    (LimitKind::Reversal, 1.0),
];

/// Largest plausible penetration at the start, as a fraction of the limit: no weight or preload presses parts into each other or into stops.
pub(super) const OVERLAP: f64 = 0.1;
/// Limits that are checked at the start of a motion.
const OF_STARTS: [(LimitKind, f64); 5] = [
    (LimitKind::Depth, OVERLAP),
    (LimitKind::Stop, OVERLAP),
    (LimitKind::Slack, 0.05),
    (LimitKind::Stretch, OVERLAP),
    (LimitKind::TyreDirection, 1.0),
];

/// Reports the first value beyond each limit. Has no state.
struct Limits {
    /// Kinds that elements of the system have, with their multiples.
    kinds: Vec<(LimitKind, f64)>,
}

pub(super) fn begin(beginning: &Beginning<'_>) -> Option<Box<dyn Monitor>> {
    let system = beginning.problem.system;
    let at = [&beginning.state.kinematics; 2];
    let applies = |&(kind, _): &(LimitKind, f64)| {
        let mut elements = system.elements_with_limit(kind);
        match kind {
            // Steps of loads may be long.
            LimitKind::Reversal => {
                beginning.problem.settings.scheme.dynamic && elements.any(|own| own.limit(kind, at).is_some())
            }
            _ => elements.next().is_some(),
        }
    };
    let kinds: Vec<_> = OF_STEPS.into_iter().filter(applies).collect();
    let has_limits = !kinds.is_empty() || !system.least_values().is_empty();
    has_limits.then(|| Box::new(Limits { kinds }) as Box<dyn Monitor>)
}

impl Monitor for Limits {
    fn accept(&mut self, step: &mut Accepted<'_>, warnings: &mut Vec<Warning>) {
        let system = step.problem.system;
        let ends = [&step.start.kinematics, &step.end.kinematics];
        for &(kind, multiple) in &self.kinds {
            if let Some((element, limit)) = system.exceeded((kind, multiple), ends) {
                report(warning(system, kind, (element, &limit), ends[1].time), warnings);
            }
        }
        let below = system.least_values().iter().find_map(|own| {
            let pressure = system.signals().measured(own.value, ends[1]);
            let (time, node) = (ends[1].time, &own.of);
            (pressure < own.least).then(|| Warning::Cavitation { time, node: node.clone(), pressure })
        });
        if let Some(warning) = below {
            warn(warnings, warning);
        }
    }
}

/// Warnings of elements beyond their limits at the start of a motion.
pub(crate) fn at_start<'s>(system: &'s System, at: &'s Kinematics) -> impl Iterator<Item = Warning> + 's {
    OF_STARTS.into_iter().filter_map(move |own| {
        let (element, limit) = system.exceeded(own, [at; 2])?;
        Some(match warning(system, own.0, (element, &limit), at.time) {
            Warning::ContactTooDeep { time, part, depth, .. } => {
                Warning::ContactOverlaps { time, part, depth }
            }
            other => other,
        })
    })
}

fn warning(
    system: &System,
    kind: LimitKind,
    (element, own): (&dyn Validity, &Limit<'_>),
    time: f64,
) -> Warning {
    let &Limit { value, limit, ref place } = own;
    let layout = system.layout();
    let name = |node: NodeId| layout.name_of_node(node).to_owned();
    let nodes = element.unknowns().nodes;
    let part = || system.parts_of(element).pop().unwrap_or_default();
    let interface = || if let Place::Node(node) = place { name(*node) } else { part() };
    let largest = value;
    match kind {
        LimitKind::Depth => Warning::ContactTooDeep { time, part: part(), depth: value, limit },
        LimitKind::Hollow => {
            let contact = if let Place::Contact(contact) = place { contact } else { "" };
            Warning::ContactInHollow { time, contact: Subject::new("contact", contact), depth: value }
        }
        LimitKind::Stop => {
            let coordinate = layout.coordinate_name(element.unknowns().coordinates[0]).to_owned();
            Warning::BeyondStop { time, coordinate, depth: value }
        }
        LimitKind::Slack | LimitKind::Sheave => {
            let parts = system.parts_of(element).join("` and `");
            Warning::RopeSlack { time, parts, slack: value, length: limit }
        }
        LimitKind::Stretch => {
            let parts = system.parts_of(element).join("` and `");
            Warning::RopeStretched { time, parts, stretch: value, length: limit }
        }
        LimitKind::Reversal => {
            let [base, tip] = [0, nodes.len() - 1].map(|k| name(nodes[k]));
            Warning::SpringThroughZero { time, base, tip }
        }
        LimitKind::TyreDeflection => Warning::TyreDeflected { time, part: part(), deflection: value, limit },
        LimitKind::TyreDirection => Warning::TyreRollsBackwards { time, part: part(), speed: value },
        LimitKind::TyreLoad => Warning::TyreBeyondData { time, part: part(), load: value, limit },
        LimitKind::TyreRoad => Warning::RoadBeyondContact { time, part: part(), deviation: value, limit },
        LimitKind::Deformation => Warning::BeyondLinear { time, interface: interface(), largest },
        LimitKind::Spin => Warning::TurnsFast { time, interface: interface(), largest },
        LimitKind::Load => Warning::LoadStiffness { time, interface: interface(), largest },
        LimitKind::Moment => Warning::MomentStiffness { time, interface: interface(), largest },
        LimitKind::LeftOut => Warning::ModesLeftOut { time, interface: interface(), largest },
    }
}

/// Adds a warning, or raises the largest value of the one of its kind.
fn report(warning: Warning, warnings: &mut Vec<Warning>) {
    let known = warnings.iter_mut().find(|known| known.code() == warning.code());
    let Some(known) = known else { return warnings.push(warning) };
    if let (Some(largest), Some(own)) = (largest(known), largest(&mut warning.clone())) {
        *largest = largest.max(*own);
    }
}

/// The largest value of a warning that follows it.
fn largest(warning: &mut Warning) -> Option<&mut f64> {
    match warning {
        Warning::BeyondLinear { largest, .. }
        | Warning::TurnsFast { largest, .. }
        | Warning::LoadStiffness { largest, .. }
        | Warning::MomentStiffness { largest, .. }
        | Warning::ModesLeftOut { largest, .. } => Some(largest),
        _ => None,
    }
}
