//! Spherical joint: two nodes share a point and turn freely about it.

use lissom_motion::{Vector3, Vector6};
use nalgebra::SVector;

use super::primitives::{
    POINT_EQUATIONS, coincident, coincident_change, coincident_curvature, coincident_gradient,
    coincident_wrench,
};
use super::{
    Build, Curvature, Equations, Frames, Gradient, Joint, JointKind, MOST_COORDINATES, Own, Relative,
};

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "spherical",
    summary: "Two nodes share a point and turn freely about it.",
    sample: "",
    parameters: &[],
    build: Build::Relative(Frames::Point, |_, _| Ok(Box::new(Spherical))),
};

/// A shared point.
#[derive(Clone, Copy, Debug)]
pub struct Spherical;

impl Joint for Spherical {
    fn equations(&self) -> &'static [&'static str] {
        &POINT_EQUATIONS
    }

    fn violation(&self, relative: &Relative, _: &Own) -> Equations {
        let mut out = Equations::default();
        coincident(relative, 0, &mut out);
        out
    }

    fn violation_change(&self, relative: &Relative, _: &Own) -> Equations {
        let mut out = Equations::default();
        coincident_change(relative, 0, &mut out);
        out
    }

    fn gradient(&self, relative: &Relative, _: &Own, out: &mut Gradient) {
        coincident_gradient(relative, 0, out);
    }

    fn wrench(
        &self,
        relative: &Relative,
        _: &Own,
        mu: &Equations,
    ) -> (Vector6, SVector<f64, MOST_COORDINATES>) {
        (coincident_wrench(relative, &Vector3::new(mu[0], mu[1], mu[2])), SVector::zeros())
    }

    fn curvature(&self, relative: &Relative, _: &Own, mu: &Equations, out: &mut Curvature) {
        coincident_curvature(relative, &Vector3::new(mu[0], mu[1], mu[2]), out);
    }
}
