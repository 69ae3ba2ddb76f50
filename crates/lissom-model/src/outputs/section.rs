//! Forces and moments in beams.

use std::slice::from_ref;
use std::sync::Arc;

use lissom_mechanics::kinematics::{Kinematics, NodeId};
use lissom_mechanics::signals::measurement::{Gradient, MAX_COMPONENTS, Measurement};

use super::frames::{node_of, section};
use super::location::BeamSection;
use super::{Build, Found, OutputQuantity, Subjects};
use crate::outputs::entry::Output;
use crate::outputs::kinds::{Declaration, Feature, Subject};

/// Registry entry.
pub(crate) const SECTION_FORCE: Declaration = Declaration {
    word: "section_force",
    summary: "Axial and shear forces in a beam, section axes.",
    subject: Subject::Section,
    features: &[Feature::Fatigue, Feature::InternalForces],
    components: &[("f1", "N"), ("f2", "N"), ("f3", "N")],
    build: Build::Motion(|output, subjects| quantity(0, output, subjects)),
};
/// Registry entry.
pub(crate) const SECTION_MOMENT: Declaration = Declaration {
    word: "section_moment",
    summary: "Torsion and bending moments in a beam, section axes.",
    subject: Subject::Section,
    features: &[Feature::Fatigue, Feature::InternalForces],
    components: &[("m1", "N m"), ("m2", "N m"), ("m3", "N m")],
    build: Build::Motion(|output, subjects| quantity(3, output, subjects)),
};
/// Force or moment of a section.
struct OfSection {
    section: BeamSection,
    nodes: Vec<NodeId>,
    /// Position of its first component among those of force and moment.
    first: usize,
}

fn quantity(first: usize, output: &Output, subjects: &Subjects<'_>) -> Found {
    let (node, point) = node_of(output)?;
    let section = section(node, point, subjects)?;
    let nodes = section.nodes.iter().map(|(node, _)| *node).collect();
    Ok(Arc::new(MeasuredSection(Arc::new(OfSection { section, nodes, first }))))
}

/// Force or moment of a section as an output.
struct MeasuredSection(Arc<dyn Measurement>);

impl OutputQuantity for MeasuredSection {
    fn measurements(&self) -> &[Arc<dyn Measurement>] {
        from_ref(&self.0)
    }
}

impl Measurement for OfSection {
    fn nodes(&self) -> &[NodeId] {
        &self.nodes
    }

    fn component_count(&self) -> usize {
        3
    }

    fn values(&self, at: &Kinematics) -> [f64; MAX_COMPONENTS] {
        let mut values = [0.0; MAX_COMPONENTS];
        let forces = self.section.probe.section_forces_at(at, self.section.xi);
        values[..3].copy_from_slice(&forces.as_slice()[self.first..self.first + 3]);
        values
    }

    fn gradient(&self, component: usize, at: &Kinematics) -> Gradient {
        let found = self.section.probe.section_force_derivatives_at(at, self.section.xi);
        let mut gradient = Gradient::zero();
        for (slot, (by_place, by_rate)) in found.by_place.iter().zip(&found.by_rate).enumerate() {
            gradient.by_place[slot] = by_place[self.first + component];
            gradient.by_rate[slot] = by_rate[self.first + component];
        }
        gradient
    }
}
