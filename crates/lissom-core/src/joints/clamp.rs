//! Clamp: two nodes, or a node and the ground, share place and rotation.

use lissom_motion::{Vector3, Vector6};
use nalgebra::SVector;

use super::primitives::{
    JointRotation, coincident, coincident_change, coincident_curvature, coincident_gradient,
    coincident_wrench, wrench_with_moments,
};
use super::{
    Build, Curvature, Equations, Frames, Gradient, Joint, JointKind, MOST_COORDINATES, Own, Relative,
};

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "clamp",
    summary: "Holds all six relative freedoms.",
    sample: "",
    parameters: &[],
    build: Build::Relative(Frames::Point, |_, _| Ok(Box::new(Clamp))),
};

/// No relative motion.
#[derive(Clone, Copy, Debug)]
pub struct Clamp;

pub(super) const EQUATIONS: [&str; 6] =
    ["position 1", "position 2", "position 3", "rotation 1", "rotation 2", "rotation 3"];

impl Joint for Clamp {
    fn equations(&self) -> &'static [&'static str] {
        &EQUATIONS
    }

    fn violation(&self, relative: &Relative, _: &Own) -> Equations {
        let mut out = Equations::default();
        coincident(relative, 0, &mut out);
        JointRotation::none().matches(relative, 3, &mut out);
        out
    }

    fn violation_change(&self, relative: &Relative, _: &Own) -> Equations {
        let mut out = Equations::default();
        coincident_change(relative, 0, &mut out);
        JointRotation::none().matches_change(relative, 3, &mut out);
        out
    }

    fn gradient(&self, relative: &Relative, _: &Own, out: &mut Gradient) {
        coincident_gradient(relative, 0, out);
        JointRotation::none().matches_gradient(relative, 3, out);
    }

    fn wrench(
        &self,
        relative: &Relative,
        _: &Own,
        mu: &Equations,
    ) -> (Vector6, SVector<f64, MOST_COORDINATES>) {
        let moments = JointRotation::none().matches_moments(relative, &Vector3::new(mu[3], mu[4], mu[5]));
        wrench_with_moments(&coincident_wrench(relative, &Vector3::new(mu[0], mu[1], mu[2])), moments)
    }

    fn curvature(&self, relative: &Relative, _: &Own, mu: &Equations, out: &mut Curvature) {
        coincident_curvature(relative, &Vector3::new(mu[0], mu[1], mu[2]), out);
        JointRotation::none().matches_curvature(relative, &Vector3::new(mu[3], mu[4], mu[5]), out);
    }
}
