//! Forces and moments in beams.

use std::sync::Arc;

use lissom_core::system::System;
use lissom_motion::{Vector3, Vector6, rotation_part, translation_part};

use super::differences::Touched;
use super::frames::{node_of, section};
use super::location::BeamSection;
use super::{Build, Evaluation, Found, OutputQuantity, Subjects, WITHOUT_GRADIENT};
use crate::document::{Declaration, Feature, Output, Subject};

/// Registry entry.
pub(crate) const SECTION_FORCE: Declaration = Declaration {
    word: "section_force",
    summary: "Axial and shear forces in a beam, local axes.",
    subject: Subject::Section,
    features: &[Feature::Fatigue],
    components: &[("f1", "N"), ("f2", "N"), ("f3", "N")],
    build: Build::System(WITHOUT_GRADIENT, |output, _, subjects| {
        quantity(translation_part, output, subjects)
    }),
};
/// Registry entry.
pub(crate) const SECTION_MOMENT: Declaration = Declaration {
    word: "section_moment",
    summary: "Torsion and bending moments in a beam, local axes.",
    subject: Subject::Section,
    features: &[Feature::Fatigue],
    components: &[("m1", "N m"), ("m2", "N m"), ("m3", "N m")],
    build: Build::System(WITHOUT_GRADIENT, |output, _, subjects| quantity(rotation_part, output, subjects)),
};
/// A part of the forces and moments of a section.
struct OfSection {
    section: BeamSection,
    part: fn(&Vector6) -> Vector3,
}

fn quantity(part: fn(&Vector6) -> Vector3, output: &Output, subjects: &Subjects<'_>) -> Found {
    let (node, point) = node_of(output)?;
    Ok(Arc::new(OfSection { section: section(node, point, subjects)?, part }))
}

impl OutputQuantity for OfSection {
    fn append_values(&self, at: &Evaluation<'_>, out: &mut Vec<f64>) {
        out.extend_from_slice((self.part)(&self.section.forces(at.motion())).as_slice());
    }

    fn touched(&self, _: &System) -> Option<Touched> {
        Some(Touched { nodes: self.section.nodes().collect(), ..Touched::default() })
    }
}
