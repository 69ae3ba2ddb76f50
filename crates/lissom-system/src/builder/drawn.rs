//! Frames of a joint as modelled: on base and tip at one location, or apart, for parts that are assembled.

use lissom_motion::{Motion, Rotation, Vector3};

use super::{Builder, Placement};
use lissom_mechanics::joints::{AnyJoint, Coordinate};
use lissom_mechanics::kinematics::{CoordinateId, NodeId, Quantity};
use lissom_mechanics::ports::Ports;
use lissom_mechanics::registry::{ParameterError, Parameters};

/// Joint frame on the tip as modelled, in inertial axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaceOnTip {
    /// The joint's point on the tip [m].
    pub at: Vector3,
    /// Direction of the axis on the tip; by default that on the base.
    pub axis: Option<Vector3>,
    /// Direction of the second axis on the tip; by default rotated with the axis.
    pub second_axis: Option<Vector3>,
}

impl PlaceOnTip {
    /// The frame on the tip that corresponds to the base's joint frame `base`.
    pub(super) fn frame(&self, base: &Motion, placement: &Placement) -> Result<Motion, ParameterError> {
        let Some(axis) = self.axis else { return Ok(Motion::new(base.rotation, self.at)) };
        let unusable = |why: &str| ParameterError::new("axis_at_tip", why);
        let (Some(on_base), Some(on_tip)) =
            (placement.axis.and_then(|axis| axis.try_normalize(0.0)), axis.try_normalize(0.0))
        else {
            return Err(unusable("needs `axis`, and a direction that is not zero"));
        };
        if on_base.dot(&on_tip) <= 0.0 {
            return Err(unusable(
                "is at 90 degrees or more to `axis`: reverse one of them, or place the parts closer",
            ));
        }
        // The smallest rotation from one axis to the other.
        let across = on_base.cross(&on_tip);
        let turn = match across.try_normalize(0.0) {
            Some(about) => Rotation::about_axis(&about, across.norm().atan2(on_base.dot(&on_tip))),
            None => Rotation::identity(),
        };
        let mut rotation = turn * base.rotation;
        if let (Some(second), Some(second_on_base)) = (self.second_axis, placement.second_axis) {
            let [before, after] = [turn.apply(&second_on_base), second]
                .map(|direction| (direction - on_tip * on_tip.dot(&direction)).try_normalize(0.0));
            let Some((before, after)) = before.zip(after) else {
                return Err(ParameterError::new("second_axis_at_tip", "is parallel to the axis"));
            };
            let (cosine, sine) = (before.dot(&after), on_tip.dot(&before.cross(&after)));
            if cosine <= 0.0 {
                let why = "is at 90 degrees or more to `second_axis`: reverse one of them, or place the parts closer";
                return Err(ParameterError::new("second_axis_at_tip", why));
            }
            rotation = Rotation::about_axis(&on_tip, sine.atan2(cosine)) * rotation;
        }
        Ok(Motion::new(rotation, self.at))
    }
}

impl Builder {
    /// Declares that parts are given approximately, with all coordinates of joints zero. Initial values that joints then
    /// have are the targets of the assembly, see [`start_values`](Self::start_values).
    pub fn assemble_later(&mut self) {
        self.start_values.get_or_insert_with(Vec::new);
    }

    /// Declares that the velocity of a node at the start is given, even if it is zero.
    pub fn give_velocity(&mut self, node: NodeId) {
        self.given_velocities.nodes.push(node);
    }

    /// Coordinates with the values that the assembly has to reach [rad, m].
    pub fn start_values(&self) -> &[(CoordinateId, f64)] {
        self.start_values.as_deref().unwrap_or_default()
    }
}

/// The coordinates of a joint with a given initial value, by a parameter of their name.
pub(super) fn start_values(
    joint: &dyn AnyJoint,
    parameters: &Parameters,
) -> Result<Vec<(usize, f64)>, ParameterError> {
    let names = joint.coordinates().iter().map(|coordinate| coordinate.name).enumerate();
    names
        .filter(|(_, name)| parameters.has(name))
        .map(|(k, name)| Ok((k, parameters.number(name)?)))
        .collect()
}

/// The given rates of a joint's coordinates at the start.
pub(super) fn start_rates(
    joint: &dyn AnyJoint,
    parameters: &Parameters,
) -> Result<Vec<Option<f64>>, ParameterError> {
    let rate = |coordinate: &Coordinate| {
        let name = match coordinate.quantity {
            Quantity::Angle => "rate",
            Quantity::Length | Quantity::State => "velocity",
        };
        parameters.has(name).then(|| parameters.number(name)).transpose()
    };
    joint.coordinates().iter().map(rate).collect()
}

/// Rotation of the joint frames at the start.
pub(super) fn joint_rotation(ports: Ports, placement: &Placement) -> Result<Rotation, ParameterError> {
    let missing = |name: &str| ParameterError::new(name, "is missing: it must be a direction");
    let unusable = |name: &str, why: &str| ParameterError::new(name, why);
    let is_omitted = placement.axis.is_none() && placement.second_axis.is_none();
    match ports.directions() {
        0 => Ok(Rotation::identity()),
        1 => {
            let third = placement.axis.ok_or_else(|| missing("axis"))?;
            let third = third
                .try_normalize(0.0)
                .ok_or_else(|| unusable("axis", "has no direction: all its numbers are zero"))?;
            // Any first axis perpendicular to the third; the one nearest to a global axis, for readable results.
            let smallest = third.iamin();
            let mut across = Vector3::zeros();
            across[smallest] = 1.0;
            let first = (across - third * third.dot(&across)).normalize();
            Rotation::from_columns(&first, &third.cross(&first), &third)
                .ok_or_else(|| unusable("axis", "has no usable direction"))
        }
        _ if is_omitted && !ports.require_directions() => Ok(Rotation::identity()),
        _ => {
            let first = placement.axis.ok_or_else(|| missing("axis"))?;
            let second = placement.second_axis.ok_or_else(|| missing("second_axis"))?;
            Rotation::from_axis_and_reference(&first, &second)
                .ok_or_else(|| unusable("second_axis", "is parallel to `axis`, or one of them is zero"))
        }
    }
}
