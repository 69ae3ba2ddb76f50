//! Adds a prescribed motion: a chain of prismatic and revolute joints with a drive each.

use lissom_motion::{Motion, Vector3};

use super::{Builder, Placement, joint_rotation};
use lissom_mechanics::joints::prescribed_motion::{self, COMPONENTS};
use lissom_mechanics::joints::{prescribed_displacement, prescribed_rotation, prismatic, revolute};
use lissom_mechanics::kinematics::{CarriedFrame, CoordinateId, Freedoms, Quantity};
use lissom_mechanics::registry::{ParameterError, Parameters, Value};

impl Builder {
    /// Prescribes the motion of the tip relative to the base; returns the driven coordinates. The last joint of the chain
    /// has the name; the other joints and the drives are named with the component, such as `name, x`.
    ///
    /// # Errors
    /// If no component is given or the axes are invalid.
    pub fn add_motion(
        &mut self,
        name: &str,
        placement: &Placement,
        parameters: &Parameters,
    ) -> Result<Vec<CoordinateId>, ParameterError> {
        let axes = joint_rotation(prescribed_motion::KIND.ports, placement)?;
        let given: Vec<usize> = (0..6).filter(|&k| parameters.has(COMPONENTS[k].0)).collect();
        let Some(&last) = given.last() else {
            let problem = "is missing, as are all others: specify at least one of x, y, z, rx, ry, rz";
            return Err(ParameterError::new("x", problem));
        };
        let mut base = placement.nodes[0];
        let mut coordinates = Vec::new();
        for k in given {
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
                Quantity::Angle => (&revolute::KIND, &prescribed_rotation::KIND, "rotation"),
                _ => (&prismatic::KIND, &prescribed_displacement::KIND, "displacement"),
            };
            let label = if k == last { name } else { &own };
            let driven = self.add_joint(label, joint, &step, &Parameters::new())?[0];
            let function = Value::Function(parameters.function(component)?);
            self.add_drive(&own, drive, driven, &Parameters::new().with(key, function))?;
            coordinates.push(driven);
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
