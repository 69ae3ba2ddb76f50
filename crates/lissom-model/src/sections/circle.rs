//! Solid circles.

use super::ShearTheory;
use super::cross_section::{CrossSection, Integrals, SectionKind};
use super::tube::ring;
use crate::format::keys::{Shape, required};
use crate::sections::Outline;

/// Radius [m].
pub(super) struct Circle {
    pub(super) radius: f64,
}

pub(super) const KIND: SectionKind = SectionKind {
    name: "circle",
    summary: "Solid circle.",
    keys: || vec![required("radius", Shape::Positive, "m", "radius")],
    read: |reader| Some(Box::new(Circle { radius: reader.number("radius")?.value })),
};

impl CrossSection for Circle {
    fn integrals(&self) -> Integrals {
        ring(self.radius, 0.0)
    }

    fn shear_coefficients(&self, theory: ShearTheory, poisson: f64) -> [f64; 2] {
        [theory.ring(0.0, poisson); 2]
    }

    fn outline(&self) -> Outline {
        Outline::Circle { radius: self.radius, inner: 0.0 }
    }
}
