//! Limits within which the laws and data of elements are valid. Monitors and judges ask for them, and know what exceeding one means.

use super::element::Element;
use crate::kinematics::{Kinematics, NodeId};

/// Elements whose laws or data are valid up to limits.
pub trait Validity: Element {
    /// The kinds of limits that elements of its kind may have.
    fn limits(&self) -> &'static [LimitKind];

    /// The limit of a kind over a step between two configurations, the same one at the start; none while it does not apply.
    fn limit(&self, kind: LimitKind, step: [&Kinematics; 2]) -> Option<Limit<'_>>;
}

/// What is limited.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LimitKind {
    /// Penetration of two solids, by half of the one at which they are within each other [m].
    Depth,
    /// Penetration of a second side of a surface by a ball after a displacement out of the nearest side, by that of the nearest side [m].
    Hollow,
    /// Way beyond a stop, by its range [m or rad].
    Stop,
    /// Length by which a rope is longer than the way along its points, by its length [m].
    Slack,
    /// Length by which a rope is shorter than the way along its points, by its length [m].
    Stretch,
    /// How a rope under tension leaves a sheave or drum: not at all.
    Sheave,
    /// Minus the product of the vectors between both ends of a spring at the start and the end of a step, if its force would have a
    /// direction at zero length: positive where that reverses.
    Reversal,
    /// Deflection of a tyre, by the largest one of usual tyres [m].
    TyreDeflection,
    /// Speed of a tyre's wheel against the direction of rolling, in which its data are measured, by a walking pace [m/s].
    TyreDirection,
    /// Normal force of a tyre, by the largest one of its data [N].
    TyreLoad,
    /// Deviation of a road from a plane within the contact of a tyre, by the largest one that its model resolves [m].
    TyreRoad,
    /// Deformations of a linear law.
    Deformation,
    /// The rate of rotation of a linear law.
    Spin,
    /// The relative change of stiffness of a linear law by axial forces and rotation.
    Load,
    /// Coupling of bending and torsion by moments in a linear law.
    Moment,
    /// Forces of modes that a linear law omits, under sudden loads.
    LeftOut,
}

/// A number with its limit.
#[derive(Clone, Debug, PartialEq)]
pub struct Limit<'e> {
    /// The number.
    pub value: f64,
    /// Largest usual or valid one.
    pub limit: f64,
    /// Where it is, if the nodes of the element do not say so.
    pub place: Place<'e>,
}

/// Where a limit applies.
#[derive(Clone, Debug, PartialEq)]
pub enum Place<'e> {
    /// At the element.
    Element,
    /// At a node of it.
    Node(NodeId),
    /// At the contact of this name.
    Contact(&'e str),
    /// At a point of it, and what happens there.
    Point(usize, String),
}

impl Limit<'_> {
    /// A limit of the element as a whole.
    pub fn of_element(value: f64, limit: f64) -> Self {
        Self { value, limit, place: Place::Element }
    }
}
