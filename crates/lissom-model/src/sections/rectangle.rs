//! Solid rectangles.

use super::ShearTheory;
use super::cross_section::{CrossSection, Integrals, SectionKind};
use super::torsion::rectangle_torsion_constant;
use crate::format::keys::{Shape, required};
use crate::sections::Outline;

/// Sides along axes 2 and 3 [m].
pub(super) struct Rectangle {
    pub(super) width: f64,
    pub(super) height: f64,
}

pub(super) const KIND: SectionKind = SectionKind {
    name: "rectangle",
    summary: "Solid rectangle.",
    keys: || {
        vec![
            required("width", Shape::Positive, "m", "side along axis 2"),
            required("height", Shape::Positive, "m", "side along axis 3"),
        ]
    },
    read: |reader| {
        let [width, height] = ["width", "height"].map(|key| reader.number(key).map(|number| number.value));
        Some(Box::new(Rectangle { width: width?, height: height? }))
    },
};

impl CrossSection for Rectangle {
    fn integrals(&self) -> Integrals {
        let Self { width, height } = *self;
        Integrals {
            area: width * height,
            second: [width * height.powi(3) / 12.0, height * width.powi(3) / 12.0],
            torsion: rectangle_torsion_constant(width, height),
        }
    }

    fn shear_coefficients(&self, theory: ShearTheory, poisson: f64) -> [f64; 2] {
        let Self { width, height } = *self;
        [theory.rectangle(width, height, poisson), theory.rectangle(height, width, poisson)]
    }

    fn outline(&self) -> Outline {
        Outline::Rectangle { width: self.width, height: self.height }
    }
}
