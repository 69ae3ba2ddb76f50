//! Whether a mechanism of rigid parts can move at all: a wrong axis in a loop locks it without violating anything.

use lissom_core::consistent::mobility::mobility;
use lissom_core::errors::Warning;
use lissom_core::joints::constraint::Constraint;
use lissom_core::kinematics::Subject;
use lissom_core::system::{State, System};
use lissom_model::document::{AnalysisKind, Component, Document};
use lissom_motion::Vector3;

/// Unknowns up to which the degrees of freedom are determined: their cost grows with the third power.
const MAX_UNKNOWNS: usize = 400;
/// Sine of the angle between two axes below which they are parallel.
const PARALLEL: f64 = 1e-3;
/// Kinds of joints whose axes are compared.
const TURNING: [&str; 3] = ["revolute", "parallel_axes", "cylindrical"];

/// A warning if nothing sets the parts in motion, or if joints lock all parts of a model without drives because one axis differs from
/// those of the others.
pub(super) fn immobile(document: &Document, system: &System, state: &State) -> Option<Warning> {
    let is_motion = matches!(document.analysis.kind, AnalysisKind::Dynamics { .. });
    let is_rigid = document.beams.is_empty()
        && document.shells.is_empty()
        && document.elastic_solids.is_empty()
        && document.superelements.is_empty();
    let is_small = system.layout().size() <= MAX_UNKNOWNS && !document.joints.is_empty();
    if !is_motion || !system.drives().is_empty() || !system.latches().is_empty() {
        return None;
    }
    if has_no_cause(document, system, state) {
        let message =
            "nothing sets the parts in motion: there is no gravity, load, drive, spring or velocity";
        let help = "add `gravity = [0, 0, -9.81]`, a load, a drive, or a `velocity` of a part";
        return Some(warning(message.to_owned(), help));
    }
    // The axes of all joints are compared with each other: only in small models.
    let cause = (is_rigid && is_small).then(|| out_of_line(document))??;
    (mobility(system, state).freedoms == 0).then(|| {
        let message = format!("the joints leave no part a motion, the model has 0 degrees of freedom: {cause}");
        let help = "`lissom check` lists the constraints; correct the axes and positions of the joints, or remove one";
        warning(message, help)
    })
}

fn warning(message: String, help: &str) -> Warning {
    Warning::Model { part: Subject::nameless("the model"), message, help: help.to_owned() }
}

/// Whether all parts are at rest, and nothing acts on them.
fn has_no_cause(document: &Document, system: &System, state: &State) -> bool {
    let at = &state.kinematics;
    let rests = at.nodes.iter().all(|node| node.twist.iter().all(|value| *value == 0.0))
        && at.coordinates.iter().all(|coordinate| coordinate.rate == 0.0);
    rests
        && document.gravity.norm() == 0.0
        && !system.constraints().any(Constraint::may_depend_on_time)
        && document.loads.is_empty()
        && document.local_loads.is_empty()
        && document.springs.is_empty()
        && document.contacts.is_empty()
        && document.superelements.is_empty()
        && document.inputs.is_empty()
        && document.signals.is_empty()
        && document.states.is_empty()
        && document.assembly.is_none()
        && document.beams.iter().all(|beam| beam.distributed.is_empty())
        && document.shells.iter().all(|shell| shell.loads.is_empty())
        && document.elastic_solids.iter().all(|solid| solid.pressures.is_empty())
}

/// The joint whose axis is not parallel to those of at least two others, which are parallel.
fn out_of_line(document: &Document) -> Option<String> {
    let turning = |joint: &&Component| TURNING.contains(&joint.kind.value.as_str());
    let axis = |joint: &Component| {
        Some((joint.name.value.clone(), joint.attachment.axes.first()?.value.normalize()))
    };
    let all: Vec<(String, Vector3)> = document.joints.iter().filter(turning).filter_map(axis).collect();
    let parallel = |a: &Vector3, b: &Vector3| a.cross(b).norm() < PARALLEL;
    let (names, others): (Vec<_>, Vec<_>) = all
        .iter()
        .map(|(_, own)| all.iter().partition(|(_, other)| parallel(own, other)))
        .max_by_key(|(same, _): &(Vec<&(String, Vector3)>, Vec<_>)| same.len())?;
    let [(odd, _)] = others.as_slice() else { return None };
    let listed: Vec<String> = names.iter().take(3).map(|(name, _)| format!("`{name}`")).collect();
    (names.len() >= 2)
        .then(|| format!("the axis of `{odd}` is not parallel to those of {}", listed.join(", ")))
}
