//! Named positions of all joints of a robot, at which it may start.
//!
//! ```text
//! free joint  x, y, z, q₀ … q₃      ball  q₀ … q₃      hinge, slide  coordinate        joints in their order
//! ```

use std::collections::BTreeMap;

use lissom_motion::{Motion, Rotation, Vector3};

use super::{Freedom, ImportError, Robot};

/// A named position of all joints.
#[derive(Clone, Debug, PartialEq)]
pub struct Keyframe {
    /// Name of the key frame; `key0` and so on for those without.
    pub name: String,
    /// Coordinates of all joints, in their order; none if it is that of the description.
    pub positions: Vec<f64>,
    /// Inputs of all actuators, in their order; none if they are zero.
    pub inputs: Vec<f64>,
    /// Location in the description.
    pub source: String,
}

/// Number of coordinates of a joint.
fn width(freedom: Freedom) -> usize {
    match freedom {
        Freedom::Fixed => 0,
        Freedom::Rotation | Freedom::Displacement => 1,
        Freedom::Ball => 4,
        Freedom::Floating => 7,
    }
}

impl Robot {
    /// Moves free bodies and ball joints to the key frame of this name, and returns the coordinates of the other joints there.
    ///
    /// # Errors
    /// If there is no such key frame, it has not as many coordinates as the joints, or a quaternion is zero.
    pub fn start_at(&mut self, name: &str) -> Result<BTreeMap<String, f64>, ImportError> {
        let Some(keyframe) = self.keyframes.iter().find(|own| own.name == name) else {
            let names: Vec<&str> = self.keyframes.iter().map(|own| own.name.as_str()).collect();
            let known = if names.is_empty() { "it has none".to_owned() } else { names.join(", ") };
            return Err(ImportError::new(format!("there is no key frame `{name}`: {known}")));
        };
        let Keyframe { positions, inputs, source, .. } = keyframe.clone();
        let fault = |message: String| ImportError::new(format!("{source}: key frame `{name}`: {message}"));
        for motor in &mut self.motors {
            motor.start = inputs.get(motor.number).copied().unwrap_or_default();
        }
        let wanted: usize = self.joints.iter().map(|joint| width(joint.freedom)).sum();
        if positions.is_empty() {
            return Ok(BTreeMap::new());
        }
        if positions.len() != wanted {
            return Err(fault(format!("it has {} coordinates, and the joints {wanted}", positions.len())));
        }
        let mut rest = positions.as_slice();
        let mut values = BTreeMap::new();
        for joint in &mut self.joints {
            let (own, others) = rest.split_at(width(joint.freedom));
            rest = others;
            let rotation = |quaternion: &[f64]| {
                let given = quaternion.try_into().ok().and_then(Rotation::from_quaternion);
                given.ok_or_else(|| fault(format!("the quaternion of `{}` is zero", joint.name)))
            };
            match own {
                [] => {}
                [value] => _ = values.insert(joint.name.clone(), *value),
                [x, y, z, quaternion @ ..] if quaternion.len() == 4 => {
                    joint.origin = Motion::new(rotation(quaternion)?, Vector3::new(*x, *y, *z));
                }
                quaternion => {
                    let turn = Motion::new(rotation(quaternion)?, Vector3::zeros());
                    let anchor = Motion::translation(joint.anchor);
                    joint.origin = joint.origin * anchor * turn * anchor.inverse();
                }
            }
        }
        Ok(values)
    }
}
