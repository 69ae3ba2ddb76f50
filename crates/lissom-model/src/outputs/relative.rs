//! Relative coordinates of joints and their rates.

use std::sync::Arc;

use lissom_mechanics::kinematics::{CoordinateId, Quantity};
use lissom_mechanics::signals::coordinate::{Coordinate, Of};
use lissom_mechanics::signals::measurement::Measurement;

use super::frames::name_of;
use super::{Build, Found, NamesAndUnits, OutputQuantity, Resolver, Subjects};
use crate::outputs::channel_components::coordinate_components;
use crate::outputs::entry::Output;
use crate::outputs::kinds::{Declaration, Feature, Subject};
use crate::text::report::{Located, Problem};

/// Registry entry.
pub(crate) const RELATIVE: Declaration = Declaration {
    word: "relative",
    summary: "Relative coordinates of a joint.",
    subject: Subject::Joint,
    features: &[Feature::Velocities],
    components: &[],
    build: Build::Motion(quantity),
};
/// Value and rate of each of some coordinates.
struct Relative {
    coordinates: Vec<CoordinateId>,
    measured: Vec<Arc<dyn Measurement>>,
}

fn quantity(output: &Output, subjects: &Subjects<'_>) -> Found {
    let coordinates = coordinates(name_of(output)?, subjects.names)?;
    let measured = coordinates.iter().flat_map(|&own| value_and_rate((own, 1.0))).collect();
    Ok(Arc::new(Relative { coordinates, measured }))
}

/// Coordinates of a joint or drive, at least one.
pub(super) fn coordinates(
    name: &Located<String>,
    names: &Resolver<'_>,
) -> Result<Vec<CoordinateId>, Problem> {
    let coordinates = names.coordinates.get(&name.value).cloned().unwrap_or_default();
    if coordinates.is_empty() {
        let message = format!("joint `{}` has no relative coordinate to record", name.value);
        return Err(Problem::error(name.span, message).help(
            "name a joint that has one, such as a revolute, screw, planar, prismatic or point_on_line joint, \
             or a drive of one",
        ));
    }
    Ok(coordinates)
}

/// Value and rate of a coordinate, times a factor.
pub(super) fn value_and_rate((coordinate, factor): (CoordinateId, f64)) -> [Arc<dyn Measurement>; 2] {
    [Of::Value, Of::Rate]
        .map(|of| -> Arc<dyn Measurement> { Arc::new(Coordinate::scaled(coordinate, of, factor)) })
}

impl OutputQuantity for Relative {
    fn components(&self, quantity: &dyn Fn(CoordinateId) -> Quantity) -> Option<NamesAndUnits> {
        let quantities: Vec<Quantity> = self.coordinates.iter().map(|&own| quantity(own)).collect();
        Some(coordinate_components(&quantities).into_iter().map(|own| (own.name, own.unit)).collect())
    }

    fn measurements(&self) -> &[Arc<dyn Measurement>] {
        &self.measured
    }

    fn is_of_positions(&self, component: usize) -> bool {
        component.is_multiple_of(2)
    }
}
