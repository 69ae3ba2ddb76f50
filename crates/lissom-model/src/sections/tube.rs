//! Circular tubes.

use std::f64::consts::PI;

use super::ShearTheory;
use super::cross_section::{CrossSection, Integrals, SectionKind};
use crate::format::keys::{Shape, required};
use crate::sections::Outline;
use crate::text::report::Problem;

/// Outer and inner radius [m].
pub(super) struct Tube {
    pub(super) outer: f64,
    pub(super) inner: f64,
}

pub(super) const KIND: SectionKind = SectionKind {
    name: "tube",
    summary: "Circular tube.",
    keys: || {
        vec![
            required("outer_radius", Shape::Positive, "m", "outer radius"),
            required("thickness", Shape::Positive, "m", "thickness of the wall"),
        ]
    },
    read: |reader| {
        let (outer, thickness) = (reader.number("outer_radius"), reader.number("thickness"));
        let (outer, thickness) = (outer?, thickness?);
        if thickness.value >= outer.value {
            let message = format!(
                "the thickness {} of {} must be less than its outer radius {}",
                thickness.value, reader.what, outer.value
            );
            let problem = Problem::error(thickness.span, message).also(outer.span, "outer radius");
            let help = "for a solid shaft write shape = \"circle\" with its radius";
            reader.context.report(problem.label("too thick").help(help));
            return None;
        }
        Some(Box::new(Tube { outer: outer.value, inner: outer.value - thickness.value }))
    },
};

impl CrossSection for Tube {
    fn integrals(&self) -> Integrals {
        ring(self.outer, self.inner)
    }

    fn shear_coefficients(&self, theory: ShearTheory, poisson: f64) -> [f64; 2] {
        [theory.ring(self.inner / self.outer, poisson); 2]
    }

    fn outline(&self) -> Outline {
        Outline::Circle { radius: self.outer, inner: self.inner }
    }
}

/// Integrals of a ring with these radii [m].
pub(super) fn ring(outer: f64, inner: f64) -> Integrals {
    let second = PI * (outer.powi(4) - inner.powi(4)) / 4.0;
    Integrals { area: PI * (outer * outer - inner * inner), second: [second; 2], torsion: 2.0 * second }
}
