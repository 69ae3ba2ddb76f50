//! Stresses of elastic solids at their nodes: those at points of quadrature, extrapolated to the node, and their mean over its elements by
//! volume.

use std::sync::Arc;

use lissom_flexible::solid::{CauchyStress, Hexahedron, Tetrahedron, principal, von_mises};
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

/// An element at a node.
enum Corner {
    Tetrahedron(Arc<Tetrahedron>),
    Hexahedron(Arc<Hexahedron>),
}

/// Elements with the number of the node in each, and their volumes [m³].
struct OfSolid(Vec<(Corner, usize, f64)>);

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
    let place = solid.nodes().one_index(node)?;
    let at = |nodes: &[usize]| nodes.iter().position(|&own| own == place);
    let tetrahedra =
        solid.mesh.tetrahedra.iter().zip(&solid.volume.tetrahedra).filter_map(|(nodes, element)| {
            Some((Corner::Tetrahedron(Arc::clone(element)), at(nodes)?, element.volume()))
        });
    let hexahedra =
        solid.mesh.hexahedra.iter().zip(&solid.volume.hexahedra).filter_map(|(nodes, element)| {
            Some((Corner::Hexahedron(Arc::clone(element)), at(nodes)?, element.volume()))
        });
    Ok(Arc::new(OfSolid(tetrahedra.chain(hexahedra).collect())))
}

impl OfSolid {
    fn stress(&self, at: &Kinematics) -> CauchyStress {
        let whole: f64 = self.0.iter().map(|(.., volume)| volume).sum();
        let own = |(corner, node, volume): &(Corner, usize, f64)| {
            let stress = match corner {
                Corner::Tetrahedron(element) => element.nodal_stresses(&element.positions(at))[*node],
                Corner::Hexahedron(element) => element.nodal_stresses(&element.positions(at))[*node],
            };
            volume / whole * stress
        };
        self.0.iter().map(own).sum()
    }
}

impl OutputQuantity for OfSolid {
    fn touched(&self, _: &System) -> Option<Touched> {
        let mut touched = Touched::default();
        for (corner, ..) in &self.0 {
            match corner {
                Corner::Tetrahedron(element) => touched.nodes.extend(element.nodes()),
                Corner::Hexahedron(element) => touched.nodes.extend(element.nodes()),
            }
        }
        Some(touched)
    }

    fn append_values(&self, at: &Evaluation<'_>, out: &mut Vec<f64>) {
        let stress = self.stress(at.motion());
        out.extend([(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)].map(|entry| stress[entry]));
        out.extend([von_mises(&stress), principal(&stress)]);
    }
}
