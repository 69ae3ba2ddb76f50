//! Universal joint: two nodes share a point; the tip turns about an axis of the base, then about an
//! axis of its own. Both angles are algebraic coordinates.

use lissom_motion::{Vector3, Vector6};
use nalgebra::SVector;

use super::clamp::EQUATIONS;
use super::primitives::{
    JointRotation, coincident, coincident_change, coincident_curvature, coincident_gradient,
    coincident_wrench, wrench_with_moments,
};
use super::{
    Build, Coordinate, Curvature, Equations, Frames, Gradient, Joint, JointKind, MOST_COORDINATES, Own,
    Relative,
};

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "universal",
    summary: "Two nodes share a point and a cross of two axes; both rotations are coordinates.",
    sample: "axis = [1.0, 0.0, 0.0]\nsecond_axis = [0.0, 1.0, 0.0]",
    parameters: &[],
    build: Build::Relative(Frames::TwoAxes, |_, _| Ok(Box::new(Universal))),
};

/// A shared point and a cross.
#[derive(Clone, Copy, Debug)]
pub struct Universal;

impl Joint for Universal {
    fn equations(&self) -> &'static [&'static str] {
        &EQUATIONS
    }

    fn coordinates(&self) -> &'static [Coordinate] {
        const { &[Coordinate::rotation("first angle"), Coordinate::rotation("second angle")] }
    }

    fn violation(&self, relative: &Relative, own: &Own) -> Equations {
        let mut out = Equations::default();
        coincident(relative, 0, &mut out);
        JointRotation::about_first_and_second_axis(own).matches(relative, 3, &mut out);
        out
    }

    fn violation_change(&self, relative: &Relative, own: &Own) -> Equations {
        let mut out = Equations::default();
        coincident_change(relative, 0, &mut out);
        JointRotation::about_first_and_second_axis(own).matches_change(relative, 3, &mut out);
        out
    }

    fn gradient(&self, relative: &Relative, own: &Own, out: &mut Gradient) {
        coincident_gradient(relative, 0, out);
        JointRotation::about_first_and_second_axis(own).matches_gradient(relative, 3, out);
    }

    fn wrench(
        &self,
        relative: &Relative,
        own: &Own,
        mu: &Equations,
    ) -> (Vector6, SVector<f64, MOST_COORDINATES>) {
        let moments = JointRotation::about_first_and_second_axis(own)
            .matches_moments(relative, &Vector3::new(mu[3], mu[4], mu[5]));
        wrench_with_moments(&coincident_wrench(relative, &Vector3::new(mu[0], mu[1], mu[2])), moments)
    }

    fn curvature(&self, relative: &Relative, own: &Own, mu: &Equations, out: &mut Curvature) {
        coincident_curvature(relative, &Vector3::new(mu[0], mu[1], mu[2]), out);
        JointRotation::about_first_and_second_axis(own).matches_curvature(
            relative,
            &Vector3::new(mu[3], mu[4], mu[5]),
            out,
        );
    }
}
