//! Sources of outputs that need nothing but the motion: they are recorded, and signals depend on them.

#[cfg(test)]
mod every_kind;
mod frames;
mod location;

use std::sync::Arc;

use crate::channels::{Resolver, Source};
use crate::document::{Output, OutputKind, OutputSource};
use crate::report::{Located, Problem};
use crate::superelement_channels;
use lissom_core::kinematics::{CarriedFrame, CoordinateId, Kinematics};
use lissom_core::signals::coordinate::{Coordinate, Of};
use lissom_core::signals::measurement::{Component, Measurement};

pub(crate) use frames::carried_frame;
pub(crate) use location::{BeamSection, Location, ObservedSection};

/// What outputs refer to: names, and frames as far as they are known before the system is built.
pub(crate) struct Subjects<'a> {
    pub(crate) names: &'a Resolver<'a>,
    /// Frames of nodes as the model describes them.
    pub(crate) drawn: &'a Kinematics,
    /// Frames of nodes from which the motion starts: others than drawn where the model was assembled.
    pub(crate) start: &'a Kinematics,
    /// Frames of outputs of a joint between two nodes, base first.
    pub(crate) joint_frames: &'a dyn Fn(&str) -> Option<[CarriedFrame; 2]>,
}

/// Source of an output that depends on positions, velocities and accelerations of a few nodes and coordinates; none for other
/// kinds.
pub(crate) fn source(output: &Output, subjects: &Subjects<'_>) -> Result<Option<Source>, Problem> {
    Ok(Some(match (&output.source, output.kind) {
        (OutputSource::Node { node, point }, OutputKind::SectionForce | OutputKind::SectionMoment) => {
            Source::Section(frames::section(node, point.as_ref(), subjects)?)
        }
        (OutputSource::Node { node, point }, OutputKind::Angle) => {
            Source::Angle(frames::location(node, point.as_ref(), subjects)?)
        }
        (OutputSource::Node { node, point }, _) => {
            frames::source(output, &frames::location(node, point.as_ref(), subjects)?, subjects)?
        }
        (OutputSource::Beam(name), _) => Source::Line(frames::points_of_line(name, subjects.names)?),
        (OutputSource::Superelement(name), kind) => {
            superelement_channels::source(kind, name, subjects.names)?
        }
        (OutputSource::Joint(name), OutputKind::RelativeMotion) => {
            let frames = (subjects.joint_frames)(&name.value).ok_or_else(|| no_frames(name))?;
            Source::Measured(frames::relative_motion(frames))
        }
        (OutputSource::Joint(name), OutputKind::Relative) => {
            Source::Coordinates(coordinates(name, subjects.names)?)
        }
        _ => return Ok(None),
    }))
}

fn no_frames(name: &Located<String>) -> Problem {
    let message = format!("`{}` stands between no two nodes", name.value);
    Problem::error(name.span, message).help("name the joint that it acts on")
}

/// Coordinates of a joint or drive, at least one.
pub(crate) fn coordinates(
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
pub(crate) fn value_and_rate((coordinate, factor): (CoordinateId, f64)) -> [Coordinate; 2] {
    [Of::Value, Of::Rate].map(|of| Coordinate::scaled(coordinate, of, factor))
}

impl Source {
    /// Its components as measurements with exact derivatives; none where it has no such derivatives.
    pub(crate) fn measurements(&self) -> Option<Vec<Component>> {
        let all = |of: &Arc<dyn Measurement>| {
            let of = Arc::clone(of);
            (0..of.component_count()).map(move |component| Component { of: Arc::clone(&of), component })
        };
        let all_of_coordinates = |pairs: Vec<[Coordinate; 2]>| {
            let one = |own: Coordinate| Component { of: Arc::new(own), component: 0 };
            pairs.into_iter().flatten().map(one).collect()
        };
        match self {
            Self::Measured(of) => Some(all(of).collect()),
            Self::Line(points) => Some(points.iter().flat_map(all).collect()),
            Self::Coordinates(coordinates) => {
                Some(all_of_coordinates(coordinates.iter().map(|&own| value_and_rate((own, 1.0))).collect()))
            }
            Self::Modal(unknowns) => Some(all_of_coordinates(unknowns.modal().map(value_and_rate).collect())),
            _ => None,
        }
    }
}
