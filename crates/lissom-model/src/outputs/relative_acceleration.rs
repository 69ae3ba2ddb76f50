//! Second derivatives of relative coordinates of joints.

use std::sync::Arc;

use lissom_mechanics::joints::MAX_COORDINATES;
use lissom_mechanics::joints::slider::Slider;
use lissom_mechanics::kinematics::{CoordinateId, Kinematics, Quantity};
use lissom_system::OutputDerivatives;
use lissom_system::System;

use super::derivatives::add;
use super::frames::name_of;
use super::relative::coordinates;
use super::touched::Touched;
use super::{Build, Evaluation, Found, NamesAndUnits, OutputQuantity, SOLUTION, Subjects};
use crate::outputs::channel_components::numbered;
use crate::outputs::entry::Output;
use crate::outputs::kinds::{Declaration, Feature, Subject};

/// Registry entry.
pub(crate) const RELATIVE_ACCELERATION: Declaration = Declaration {
    word: "relative_acceleration",
    summary: "Accelerations of a joint's relative coordinates.",
    subject: Subject::Joint,
    features: &[Feature::Accelerations],
    components: &[],
    build: Build::System(SOLUTION, quantity),
};
/// Accelerations of coordinates.
struct Accelerations {
    coordinates: Vec<CoordinateId>,
    /// Joint between two nodes and position in it of each; none where no such joint has them.
    owners: Option<Vec<(usize, usize)>>,
}

fn quantity(output: &Output, system: &System, subjects: &Subjects<'_>) -> Found {
    let coordinates = coordinates(name_of(output)?, subjects.names)?;
    let owner = |coordinate: &CoordinateId| {
        let place = |own: &[CoordinateId]| own.iter().position(|known| known == coordinate);
        let mut joints = system.joints().iter().enumerate();
        joints.find_map(|(joint, own)| Some((joint, place(&own.coordinates)?)))
    };
    if coordinates.iter().all(|own| owner(own).is_none()) {
        return Ok(Arc::new(Accelerations { coordinates, owners: None }));
    }
    let coordinates: Vec<_> = coordinates.into_iter().filter(|own| owner(own).is_some()).collect();
    let owners = Some(coordinates.iter().filter_map(owner).collect());
    Ok(Arc::new(Accelerations { coordinates, owners }))
}

impl OutputQuantity for Accelerations {
    fn components(&self, quantity: &dyn Fn(CoordinateId) -> Quantity) -> Option<NamesAndUnits> {
        let units = self.coordinates.iter().map(|&own| match quantity(own) {
            Quantity::Angle => "rad/s²",
            Quantity::Length | Quantity::State => "m/s²",
        });
        Some(numbered(&vec!["a"; self.coordinates.len()]).into_iter().zip(units).collect())
    }

    fn append_values(&self, at: &Evaluation<'_>, out: &mut Vec<f64>) {
        if let Some(owners) = &self.owners {
            out.extend(owners.iter().map(|&(joint, own)| {
                let all: [f64; MAX_COORDINATES] =
                    at.system.joints()[joint].coordinate_accelerations(at.motion());
                all[own]
            }));
        } else {
            let own = |&own: &CoordinateId| free_acceleration(at.system, own, at.motion());
            out.extend(self.coordinates.iter().map(own));
        }
    }

    /// Exact where the coordinates are unknowns with accelerations of their own.
    fn derivatives(&self, at: &Evaluation<'_>, _: f64) -> Option<Vec<OutputDerivatives>> {
        let is_of_slider = |own| at.system.sliders().iter().any(|slider| slider.coordinate == own);
        if self.owners.is_some() || self.coordinates.iter().any(|&own| is_of_slider(own)) {
            return None;
        }
        let of = |&own: &CoordinateId| {
            let mut output = OutputDerivatives::default();
            add(&mut output.by_acceleration, at.system.layout().row_of_coordinate(own), 1.0);
            output
        };
        Some(self.coordinates.iter().map(of).collect())
    }

    fn touched(&self, system: &System) -> Option<Touched> {
        let mut touched = Touched::default();
        touched.coordinates.extend(&self.coordinates);
        let is_own = |slider: &&Slider| self.coordinates.contains(&slider.coordinate);
        touched.nodes.extend(system.sliders().iter().filter(is_own).flat_map(Slider::carriers));
        for joint in self.owners.iter().flatten().map(|&(joint, _)| &system.joints()[joint]) {
            touched.nodes.extend(joint.frames.map(|frame| frame.node));
            touched.coordinates.extend(&joint.coordinates);
        }
        Some(touched)
    }
}

/// Second derivative of a coordinate that no joint between nodes has; that of a slider follows from those of nodes.
fn free_acceleration(system: &System, own: CoordinateId, at: &Kinematics) -> f64 {
    let slider = system.sliders().iter().find(|slider| slider.coordinate == own);
    slider.map_or(at.coordinates[own].acceleration, |slider| slider.coordinate_acceleration(at))
}
