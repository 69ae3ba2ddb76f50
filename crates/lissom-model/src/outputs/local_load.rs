//! Resultant of a load that depends on the motion of its own points, and its force and moment per length at one of them.

use std::sync::Arc;

use super::frames::name_of;
use super::touched::Touched;
use super::{Build, Evaluation, Found, NamesAndUnits, OutputQuantity, Subjects, WHOLE_MODEL};
use crate::outputs::entry::Output;
use crate::outputs::kinds::{Declaration, Feature, Subject};
use crate::outputs::local_load_points::LocalLoadPoints;
use crate::text::report::Problem;
use lissom_mechanics::elements::local_load::LocalLoad;
use lissom_mechanics::elements::{Element, Unknowns};
use lissom_mechanics::kinematics::{CoordinateId, Quantity};
use lissom_mechanics::number::Written;
use lissom_motion::Vector3;
use lissom_system::System;

/// Registry entry.
pub(crate) const LOCAL_LOAD: Declaration = Declaration {
    word: "local_load",
    summary: "Resultant force of a local load, its moment about the origin, and the power that it supplies, global axes; or with `station` force and moment per length there, in the axes of the load, and its variables.",
    subject: Subject::LocalLoad,
    features: &[Feature::Station],
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

/// Force and moment per length at a point of a load along a beam, with the variables.
struct AtStation {
    load: LocalLoad,
    variables: Vec<(String, usize)>,
}

/// Largest difference between two names of one station.
const SAME_STATION: f64 = 1e-6;

fn quantity(output: &Output, _: &System, subjects: &Subjects<'_>) -> Found {
    let name = name_of(output)?;
    let load = subjects.names.local_loads.get(&name.value);
    let LocalLoadPoints { points, beam, variables } =
        load.ok_or_else(|| Problem::error(name.span, format!("there is no local load `{}`", name.value)))?;
    let Some(station) = &output.station else {
        return Ok(Arc::new(Resultant(points.iter().map(|(_, load)| load.clone()).collect())));
    };
    let Some(beam) = beam else {
        let message = format!("local load `{}` acts on a node, so it has no stations", name.value);
        return Err(Problem::error(station.span, message).help("remove `station`"));
    };
    let is_here = |(own, _): &&(f64, LocalLoad)| (own - station.value).abs() < SAME_STATION;
    let Some((_, load)) = points.iter().find(is_here) else {
        let mut near: Vec<f64> = points.iter().map(|(own, _)| *own).collect();
        near.sort_by(|a, b| (a - station.value).abs().total_cmp(&(b - station.value).abs()));
        let near: Vec<String> = near.iter().take(2).map(|own| Written(*own).to_string()).collect();
        let message = format!("local load `{}` does not act on `{beam}` at {}", name.value, station.value);
        return Err(Problem::error(station.span, message)
            .help(format!("it acts at the nodes of the beam, the nearest at {}", near.join(" and "))));
    };
    Ok(Arc::new(AtStation { load: load.clone(), variables: variables.clone() }))
}

/// Units of force and moment per length.
const PER_LENGTH: [&str; 6] = ["N/m", "N/m", "N/m", "N", "N", "N"];

impl OutputQuantity for AtStation {
    fn components(&self, _: &dyn Fn(CoordinateId) -> Quantity) -> Option<NamesAndUnits> {
        let wrench =
            LOCAL_LOAD.components.iter().zip(PER_LENGTH).map(|((word, _), unit)| ((*word).to_owned(), unit));
        let variables = self.variables.iter().map(|(name, _)| (name.clone(), ""));
        Some(wrench.chain(variables).collect())
    }

    fn append_values(&self, at: &Evaluation<'_>, out: &mut Vec<f64>) {
        self.load.read_functions(at.motion(), |wrench, functions| {
            out.extend(wrench.iter().flatten());
            out.extend(self.variables.iter().map(|&(_, index)| functions[index]));
        });
    }

    fn touched(&self, _: &System) -> Option<Touched> {
        let Unknowns { nodes, coordinates, .. } = self.load.unknowns();
        let (nodes, coordinates) = (nodes.iter().copied().collect(), coordinates.iter().copied().collect());
        Some(Touched { nodes, coordinates })
    }
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
