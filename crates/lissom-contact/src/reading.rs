//! What a contact reports at one of its points, however it is solved.

use lissom_mechanics::elements::Spring;
use lissom_mechanics::kinematics::Kinematics;
use lissom_motion::Vector3;

/// Gap, forces on the tip in global axes, sliding velocity.
#[derive(Clone, Copy, Debug)]
pub struct ContactReading {
    /// g [m].
    pub gap: f64,
    /// Normal force [N].
    pub normal: f64,
    /// Normal force and friction [N].
    pub force: Vector3,
    /// Friction [N].
    pub friction: Vector3,
    /// Sliding velocity [m/s].
    pub slip: f64,
    /// Point of contact on the base, global axes [m].
    pub point: Vector3,
    /// Whether the parts touch.
    pub is_touching: bool,
    /// Whether they touch and slide, or there is no friction.
    pub is_sliding: bool,
}

impl ContactReading {
    /// Reading for parts that are apart, wherever they are nearest.
    pub fn apart(gap: f64) -> Self {
        let zero = Vector3::zeros();
        let (is_touching, is_sliding) = (false, false);
        Self {
            gap,
            normal: 0.0,
            force: zero,
            friction: zero,
            slip: 0.0,
            point: zero,
            is_touching,
            is_sliding,
        }
    }

    /// Reading with `sign` -1 for the part that is the tip elsewhere.
    pub fn with_sign(self, sign: f64) -> Self {
        Self { force: sign * self.force, friction: sign * self.friction, ..self }
    }
}

/// An element of a contact, which is a spring over its gap.
pub trait ContactElement: Spring {
    /// What it reports.
    fn reading(&self, at: &Kinematics) -> ContactReading;
}
