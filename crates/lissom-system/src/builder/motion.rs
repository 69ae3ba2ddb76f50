//! Adds a prescribed motion: a chain of prismatic and revolute joints, with a drive each unless they are free.

use lissom_motion::{Motion, Vector3};

use super::{Builder, Placement, joint_rotation};
use lissom_mechanics::joints::prescribed_motion::{self, COMPONENTS};
use lissom_mechanics::joints::{
    prescribed_displacement, prescribed_rotation, prismatic, revolute, spherical,
};
use lissom_mechanics::kinematics::{CarriedFrame, CoordinateId, Freedoms, Quantity};
use lissom_mechanics::registry::{ParameterError, Parameters, Value};

impl Builder {
    /// Prescribes the motion of the tip relative to the base; returns the driven coordinates. The last joint of the chain
    /// has the name; the other joints and the drives are named with the component, such as `name, x`.
    ///
    /// # Errors
    /// If no component is given, one is given and free, or the axes are invalid.
    pub fn add_motion(
        &mut self,
        name: &str,
        placement: &Placement,
        parameters: &Parameters,
    ) -> Result<Vec<CoordinateId>, ParameterError> {
        let axes = joint_rotation(prescribed_motion::KIND.ports, placement)?;
        let free = if parameters.has("free") { parameters.words("free")? } else { &[] };
        let is_given = |k: usize| parameters.has(COMPONENTS[k].0);
        // A point mass has no rotation to be locked.
        let is_point = self.freedoms(placement.nodes[1]).is_point();
        let is_free = |k: usize| (is_point && k >= 3) || free.iter().any(|word| word == COMPONENTS[k].0);
        if !(0..6).any(is_given) {
            let problem = "is missing, as are all others: specify at least one of x, y, z, rx, ry, rz";
            return Err(ParameterError::new("x", problem));
        }
        if let Some(k) = (3..6).find(|&k| is_point && is_given(k)) {
            let problem = "prescribes the rotation of a point mass, which has none: make it a body";
            return Err(ParameterError::new(COMPONENTS[k].0, problem));
        }
        if let Some(both) = (0..6).find(|&k| is_given(k) && is_free(k)) {
            return Err(ParameterError::new(
                COMPONENTS[both].0,
                "is prescribed and in `free`: remove one of them",
            ));
        }
        let turns = (3..6).all(is_free);
        let mut chain: Vec<usize> = (0..6).filter(|&k| is_given(k) || is_free(k)).collect();
        if turns {
            // Any of the three stands for the spherical joint.
            chain.truncate(chain.len() - 2);
        }
        let last = chain[chain.len() - 1];
        let mut base = placement.nodes[0];
        let mut coordinates = Vec::new();
        for k in chain {
            let (component, quantity) = COMPONENTS[k];
            let own = format!("{name}, {component}");
            let tip = if k == last {
                placement.nodes[1]
            } else {
                self.add_node(&own, Motion::new(axes, placement.at), Freedoms::Full)
            };
            let step = Placement {
                nodes: [base, tip],
                axis: Some(axes.apply(&Vector3::ith(k % 3, 1.0))),
                second_axis: None,
                ..*placement
            };
            let (joint, drive, key) = match quantity {
                Quantity::Angle if turns => (&spherical::KIND, &prescribed_rotation::KIND, "rotation"),
                Quantity::Angle => (&revolute::KIND, &prescribed_rotation::KIND, "rotation"),
                _ => (&prismatic::KIND, &prescribed_displacement::KIND, "displacement"),
            };
            let label = if k == last { name } else { &own };
            let coordinate = self.add_joint(label, joint, &step, &Parameters::new())?.first().copied();
            if let Some(driven) = coordinate.filter(|_| is_given(k)) {
                let function = Value::Function(parameters.function(component)?);
                self.add_drive(&own, drive, driven, &Parameters::new().with(key, function))?;
                coordinates.push(driven);
            }
            base = tip;
        }
        let frame = Motion::new(axes, placement.at);
        let carried = placement
            .nodes
            .map(|node| CarriedFrame { node, offset: frame.relative_to(&self.initial_frame(node)) });
        if let Some(named) = self.constraints.joints.last_mut() {
            named.output_frames = carried;
        }
        Ok(coordinates)
    }
}
