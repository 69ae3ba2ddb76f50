//! Prismatic joint: the tip slides along an axis of the base without relative rotation. The displacement along the
//! axis is an algebraic coordinate: x = d e₃ in the joint frame, R = I.

use super::kind::{Build, JointKind};
use super::product::Product;
use super::{Coordinate, MAX_COORDINATES};
use crate::ports::Ports;
use crate::registry::{DISPLACEMENT_AT_START, VELOCITY_AT_START};

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "prismatic",
    summary: "The tip slides along an axis without rotation; the displacement is a coordinate.",
    sample: "axis = [1.0, 0.0, 0.0]",
    parameters: &[DISPLACEMENT_AT_START, VELOCITY_AT_START],
    ports: Ports::AXIS,
    build: Build::Relative(|parameters, _| {
        Ok(Box::new(Prismatic { displacement: parameters.number("displacement")? }))
    }),
};

/// A prismatic joint.
#[derive(Clone, Copy, Debug)]
pub struct Prismatic {
    /// Relative displacement at the start [m].
    displacement: f64,
}

impl Product for Prismatic {
    const COORDINATES: &'static [Coordinate] = &[Coordinate::displacement("displacement")];
    const SLIDE: Option<usize> = Some(0);

    fn values(&self) -> [f64; MAX_COORDINATES] {
        [self.displacement, 0.0]
    }
}
