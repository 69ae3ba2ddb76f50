//! Point on a line: the tip's point slides along a line of the base and the tip rotates freely. The displacement
//! along the line is an algebraic coordinate: x = d e₃ in the base's axes.

use super::kind::{Build, JointKind};
use super::product::{Place, Product, Turn};
use super::{Coordinate, MAX_COORDINATES};
use crate::ports::Ports;
use crate::registry::{DISPLACEMENT_AT_START, VELOCITY_AT_START};

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "point_on_line",
    summary: "The tip's point slides along a line fixed in the base; the tip rotates freely; the displacement is a coordinate.",
    sample: "axis = [1.0, 0.0, 0.0]",
    parameters: &[DISPLACEMENT_AT_START, VELOCITY_AT_START],
    ports: Ports::AXIS,
    build: Build::Relative(|parameters, _| {
        Ok(Box::new(PointOnLine { displacement: parameters.number("displacement")? }))
    }),
};

/// A point on a line.
#[derive(Clone, Copy, Debug)]
pub struct PointOnLine {
    /// Relative displacement at the start [m].
    displacement: f64,
}

impl Product for PointOnLine {
    const COORDINATES: &'static [Coordinate] = &[Coordinate::displacement("displacement")];
    const PLACE: Place = Place::Line;
    const TURN: Turn = Turn::Free;
    const SLIDE: Option<usize> = Some(0);

    fn values(&self) -> [f64; MAX_COORDINATES] {
        [self.displacement, 0.0]
    }
}
