//! Revolute joint: two nodes share a point and an axis; the relative rotation about the axis is an
//! algebraic coordinate, so that springs, drives and outputs can use it.

use lissom_motion::{Motion, Vector3, Vector6};
use nalgebra::SVector;

use super::clamp::EQUATIONS;
use super::primitives::{
    JointRotation, coincident, coincident_change, coincident_curvature, coincident_gradient,
    coincident_wrench, elementary, wrench_with_moments,
};
use super::{
    Build, Coordinate, Curvature, Equations, Frames, Gradient, Joint, JointKind, MOST_COORDINATES, Own,
    Relative,
};
use crate::registry::{Parameter, ParameterType};

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "revolute",
    summary: "Two nodes share a point and an axis; the relative rotation is a coordinate.",
    sample: "axis = [0.0, 0.0, 1.0]",
    parameters: &[Parameter::optional(
        "angle",
        ParameterType::Number,
        "rad",
        "Value of the relative rotation at the start; default 0.",
    )],
    build: Build::Relative(Frames::Axis, |parameters, _| {
        Ok(Box::new(Revolute { angle: parameters.number_or("angle", 0.0)? }))
    }),
};

/// A shared point and axis.
#[derive(Clone, Copy, Debug)]
pub struct Revolute {
    /// Relative rotation at the start [rad].
    angle: f64,
}

impl Joint for Revolute {
    fn equations(&self) -> &'static [&'static str] {
        &EQUATIONS
    }

    fn coordinates(&self) -> &'static [Coordinate] {
        const { &[Coordinate::rotation("angle")] }
    }

    fn initial(&self) -> ([f64; MOST_COORDINATES], Motion) {
        let rotation = lissom_motion::Rotation::from_matrix(&elementary(2, self.angle));
        ([self.angle, 0.0], Motion::new(rotation, Vector3::zeros()))
    }

    fn violation(&self, relative: &Relative, own: &Own) -> Equations {
        let mut out = Equations::default();
        coincident(relative, 0, &mut out);
        JointRotation::about_third_axis(own).matches(relative, 3, &mut out);
        out
    }

    fn violation_change(&self, relative: &Relative, own: &Own) -> Equations {
        let mut out = Equations::default();
        coincident_change(relative, 0, &mut out);
        JointRotation::about_third_axis(own).matches_change(relative, 3, &mut out);
        out
    }

    fn gradient(&self, relative: &Relative, own: &Own, out: &mut Gradient) {
        coincident_gradient(relative, 0, out);
        JointRotation::about_third_axis(own).matches_gradient(relative, 3, out);
    }

    fn wrench(
        &self,
        relative: &Relative,
        own: &Own,
        mu: &Equations,
    ) -> (Vector6, SVector<f64, MOST_COORDINATES>) {
        let moments = JointRotation::about_third_axis(own)
            .matches_moments(relative, &Vector3::new(mu[3], mu[4], mu[5]));
        wrench_with_moments(&coincident_wrench(relative, &Vector3::new(mu[0], mu[1], mu[2])), moments)
    }

    fn curvature(&self, relative: &Relative, own: &Own, mu: &Equations, out: &mut Curvature) {
        coincident_curvature(relative, &Vector3::new(mu[0], mu[1], mu[2]), out);
        JointRotation::about_third_axis(own).matches_curvature(
            relative,
            &Vector3::new(mu[3], mu[4], mu[5]),
            out,
        );
    }
}
