//! Initial values of coordinates at which a joint rests: they move no part, and only outputs read them.

use std::sync::Arc;

use lissom_core::errors::Warning;
use lissom_core::kinematics::Subject;
use lissom_core::settings::Settings;
use lissom_core::simulation::Simulation;
use lissom_core::system::{State, System};
use lissom_model::document::{AnalysisKind, Component, Document};
use lissom_model::lower::Names;

/// Keys of joints for initial values of their coordinates.
const KEYS: [&str; 2] = ["angle", "displacement"];
/// Rates [rad/s, m/s] and accelerations [rad/s², m/s²] of a joint at rest are smaller.
const AT_REST: f64 = 1e-9;

/// A joint with an initial value.
type Given<'d> = (&'d str, &'static str, f64);

/// A warning for each joint that rests at its initial value. The parts of other joints are probably given at their values.
pub(super) fn at_rest(
    document: &Document,
    names: &Names,
    (system, state, settings): (&Arc<System>, &State, &Settings),
) -> Vec<Warning> {
    let is_motion = matches!(document.analysis.kind, AnalysisKind::Dynamics { .. });
    let given: Vec<Given<'_>> =
        document.joints.iter().filter_map(|joint| given(document, names, joint)).collect();
    // With an assembly they are targets.
    if document.assembly.is_some() || !is_motion || given.is_empty() || !document.units.is_empty() {
        return Vec::new();
    }
    // A start that fails is reported by the run.
    let Ok(start) = Simulation::new(Arc::clone(system), state.clone(), settings.clone()) else {
        return Vec::new();
    };
    let at = &start.state().kinematics;
    let rests = |(joint, ..): &Given<'_>| {
        let mut coordinates =
            names.coordinates.get(*joint).into_iter().flatten().map(|&id| &at.coordinates[id]);
        coordinates.all(|motion| motion.rate.abs().max(motion.acceleration.abs()) < AT_REST)
    };
    let warning = |(joint, key, value): Given<'_>| {
        Warning::Model {
        part: Subject::new("joint", joint),
        message: format!(
            "joint `{joint}` rests at the start: `{key} = {value}` moves no part, it is the value of the coordinate in the given positions"
        ),
        help: "add the table `[assembly]`, which moves the parts until the coordinate has this value, or give them other positions"
            .to_owned(),
    }
    };
    given.into_iter().filter(rests).map(warning).collect()
}

/// The initial value of a joint, unless forces or relations use its coordinate.
fn given<'d>(document: &Document, names: &Names, joint: &'d Component) -> Option<Given<'d>> {
    let name = joint.name.value.as_str();
    let mut acting = document.joints.iter().chain(&document.springs).chain(&document.loads);
    if joint.latch.is_some()
        || !joint.attachment.coordinates.is_empty()
        || acting.any(|component| component.attachment.joints().contains(&name))
    {
        return None;
    }
    KEYS.into_iter().find_map(|key| {
        let value = joint.parameters.number(key).ok().filter(|value| *value != 0.0)?;
        (joint.parameters.has(key) && !names.is_read(&format!("{name}.{key}"))).then_some((name, key, value))
    })
}
