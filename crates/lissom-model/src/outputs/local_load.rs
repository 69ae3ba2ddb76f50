//! Resultant of a load that depends on the motion of its own points.

use std::sync::Arc;

use super::frames::name_of;
use super::touched::Touched;
use super::{Build, Evaluation, Found, OutputQuantity, Subjects, WHOLE_MODEL};
use crate::outputs::entry::Output;
use crate::outputs::kinds::{Declaration, Subject};
use crate::text::report::Problem;
use lissom_mechanics::elements::local_load::LocalLoad;
use lissom_mechanics::elements::{Element, Unknowns};
use lissom_motion::Vector3;
use lissom_system::System;

/// Registry entry.
pub(crate) const LOCAL_LOAD: Declaration = Declaration {
    word: "local_load",
    summary: "Resultant force of a local load, its moment about the origin, and the power that it supplies, global axes.",
    subject: Subject::LocalLoad,
    features: &[],
    components: &[
        ("f1", "N"),
        ("f2", "N"),
        ("f3", "N"),
        ("m1", "N m"),
        ("m2", "N m"),
        ("m3", "N m"),
        ("power", "W"),
    ],
    build: Build::System(WHOLE_MODEL, quantity),
};

/// All points of a load.
struct Resultant(Vec<LocalLoad>);

fn quantity(output: &Output, _: &System, subjects: &Subjects<'_>) -> Found {
    let name = name_of(output)?;
    let points = subjects.names.local_loads.get(&name.value);
    let points = points
        .ok_or_else(|| Problem::error(name.span, format!("there is no local load `{}`", name.value)))?;
    Ok(Arc::new(Resultant(points.clone())))
}

impl OutputQuantity for Resultant {
    fn append_values(&self, at: &Evaluation<'_>, out: &mut Vec<f64>) {
        let (mut force, mut moment, mut power) = (Vector3::zeros(), Vector3::zeros(), 0.0);
        for load in &self.0 {
            let [own, about_point] = load.resultant(at.motion());
            let [velocity, turning] = load.velocities(at.motion());
            force += own;
            moment += about_point + load.position(at.motion()).cross(&own);
            power += own.dot(&velocity) + about_point.dot(&turning);
        }
        out.extend(force.iter());
        out.extend(moment.iter());
        out.push(power);
    }

    fn touched(&self, _: &System) -> Option<Touched> {
        let mut touched = Touched::default();
        for load in &self.0 {
            let Unknowns { nodes, coordinates, .. } = load.unknowns();
            touched.nodes.extend(nodes);
            touched.coordinates.extend(coordinates);
        }
        Some(touched)
    }
}
