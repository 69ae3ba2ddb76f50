//! Whether a mechanism of rigid parts can move at all: a wrong axis in a loop locks it without violating anything.

use lissom_core::consistent::mobility::mobility;
use lissom_core::errors::Warning;
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

/// A warning if joints lock all parts of a model without drives, with the joint whose axis differs from those of the others.
pub(super) fn immobile(document: &Document, system: &System, state: &State) -> Option<Warning> {
    let is_motion = matches!(document.analysis.kind, AnalysisKind::Dynamics { .. });
    let is_rigid = document.beams.is_empty() && document.superelements.is_empty();
    let is_small = system.layout().size() <= MAX_UNKNOWNS && !document.joints.is_empty();
    if !is_motion || !is_rigid || !is_small || !system.drives().is_empty() || !system.latches().is_empty() {
        return None;
    }
    if mobility(system, state).freedoms > 0 {
        return None;
    }
    let cause = out_of_line(document).map_or_else(String::new, |words| format!(": {words}"));
    Some(Warning::Model {
        part: Subject::nameless("the model"),
        message: format!("the joints leave no part a motion, the model has 0 degrees of freedom{cause}"),
        help: "`lissom check` lists the constraints; correct the axes and positions of the joints, or remove one".to_owned(),
    })
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
