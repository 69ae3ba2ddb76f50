//! Stresses of elastic solids at their nodes: those at points of quadrature, extrapolated to the node, and their mean over its elements by
//! volume.

use std::sync::Arc;

use lissom_flexible::solid::{CauchyStress, SolidElement, principal, von_mises};
use lissom_mechanics::kinematics::Kinematics;
use lissom_system::System;

use super::frames::node_of;
use super::touched::Touched;
use super::{Build, Found, OutputQuantity, Subjects};
use crate::outputs::Evaluation;
use crate::outputs::entry::Output;
use crate::outputs::kinds::{Declaration, Feature, Subject};
use crate::reading::node_reference::NodeReference;
use crate::text::report::Problem;

/// Registry entry.
pub(crate) const KIND: Declaration = Declaration {
    word: "solid_stress",
    summary: "Stresses at a node of a solid, global axes, its von Mises stress and its largest principal stress.",
    subject: Subject::SolidNode,
    features: &[Feature::Fatigue, Feature::InternalForces],
    components: &[
        ("s11", "Pa"),
        ("s22", "Pa"),
        ("s33", "Pa"),
        ("s12", "Pa"),
        ("s13", "Pa"),
        ("s23", "Pa"),
        ("mises", "Pa"),
        ("principal", "Pa"),
    ],
    build: Build::System("it is the mean over the elements at the node", of),
};

/// Elements with the number of the node in each, and their volumes [m³].
struct OfSolid(Vec<(Arc<dyn SolidElement>, usize, f64)>);

fn of(output: &Output, _: &System, subjects: &Subjects<'_>) -> Found {
    let (node, _) = node_of(output)?;
    let found = match &node.value {
        NodeReference::Mesh { part, .. } => subjects.names.meshes.solids.get(part),
        _ => None,
    };
    let Some(solid) = found else {
        let message = format!("output `{}` is of a solid, and this is no node of one", output.name.value);
        return Err(Problem::error(node.span, message).help("name a node such as \"block@0.5,1,0\""));
    };
    let place = solid.nodes.one_index(node)?;
    let own = solid.nodes.mesh.elements.iter().zip(&solid.elements).filter_map(|(nodes, element)| {
        let at = nodes.nodes.iter().position(|&own| own == place)?;
        Some((Arc::clone(element), at, element.volume()))
    });
    Ok(Arc::new(OfSolid(own.collect())))
}

impl OfSolid {
    fn stress(&self, at: &Kinematics) -> CauchyStress {
        let whole: f64 = self.0.iter().map(|(.., volume)| volume).sum();
        let mut sum = CauchyStress::zeros();
        for (element, place, volume) in &self.0 {
            element.visit_stresses(at, &mut |node, stress| {
                if node == *place {
                    sum += volume / whole * stress;
                }
            });
        }
        sum
    }
}

impl OutputQuantity for OfSolid {
    fn touched(&self, _: &System) -> Option<Touched> {
        let mut touched = Touched::default();
        touched.nodes.extend(self.0.iter().flat_map(|(element, ..)| element.node_ids()));
        Some(touched)
    }

    fn append_values(&self, at: &Evaluation<'_>, out: &mut Vec<f64>) {
        let stress = self.stress(at.motion());
        out.extend([(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)].map(|entry| stress[entry]));
        out.extend([von_mises(&stress), principal(&stress)]);
    }
}
