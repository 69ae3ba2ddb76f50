//! A touch of two parts at the end of a step: what the next step continues, and what outputs report.

use lissom_contact::reading::ContactReading;
use serde::{Deserialize, Serialize};

/// Which parts touch, and at which of their points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct TouchKey {
    /// Index of the contact.
    pub rule: u32,
    /// Indices of the parts.
    pub parts: [u32; 2],
    /// Index of the point.
    pub point: u32,
}

impl TouchKey {
    /// Numbers that order keys as they are compared.
    pub fn rank(&self) -> (u32, u32, u32, u32) {
        (self.rule, self.parts[0], self.parts[1], self.point)
    }
}

/// A touch at the end of a step. Vectors are in inertial axes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Touch {
    /// Where it is.
    pub key: TouchKey,
    /// Gap at the end of the step [m].
    pub gap: f64,
    /// Penetration at which the solids are within each other [m].
    pub deepest: f64,
    /// Point of contact [m].
    pub point: [f64; 3],
    /// Force on the second part [N].
    pub force: [f64; 3],
    /// Tangential part of the force [N].
    pub friction: [f64; 3],
    /// Part of the force along the normal [N].
    pub normal: f64,
    /// Tangential deflection [m].
    pub bristle: [f64; 3],
    /// Stiffness of the tangential deflection [N/m].
    pub stiffness: f64,
    /// Penetration without force: that with which the touch appeared [m].
    pub relief: f64,
    /// Sliding velocity [m/s].
    pub slip: f64,
    /// Whether it slips, or has no friction.
    pub is_sliding: bool,
    /// Velocity at which it began [m/s].
    pub impact_velocity: f64,
    /// Elastic energy [J].
    pub energy: f64,
    /// Power that what moves its surface supplies [W].
    pub supplied: f64,
    /// Whether the next step continues it: not if the parts depart.
    pub continues: bool,
}

impl Touch {
    /// What it reports.
    pub fn reading(&self) -> ContactReading {
        ContactReading {
            gap: self.gap,
            normal: self.normal,
            force: self.force.into(),
            friction: self.friction.into(),
            slip: self.slip,
            point: self.point.into(),
            is_touching: true,
            is_sliding: self.is_sliding,
        }
    }
}
