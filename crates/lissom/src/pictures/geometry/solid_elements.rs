//! Stresses and energies of an elastic solid at positions of its nodes, by elements like those of the run.

use std::sync::Arc;

use lissom_core::flexible::solid::law::{SolidLaw, SolidModel};
use lissom_core::flexible::solid::{CauchyStress, SolidElement, element, von_mises};
use lissom_core::kinematics::{Kinematics, NodeId};
use lissom_model::scene::ElasticSolid;
use lissom_motion::Vector3;

/// The elements of a solid, each with the indices of its nodes in the solid.
pub struct SolidElements {
    elements: Vec<(Vec<usize>, Arc<dyn SolidElement>)>,
    count: usize,
}

impl SolidElements {
    /// Elements of a solid.
    pub fn new(solid: &ElasticSolid) -> Self {
        let model = if solid.is_rubber { SolidModel::Rubber } else { SolidModel::StVenantKirchhoff };
        let law = SolidLaw { model, shear: solid.shear, bulk: solid.bulk, second: solid.second };
        let built = |(kind, nodes): (&String, &Vec<usize>)| {
            let ids: Vec<NodeId> = nodes.iter().map(|&node| solid.nodes[node]).collect();
            let places: Vec<Vector3> = nodes.iter().map(|&node| solid.positions[node].into()).collect();
            let free = |i: usize| solid.free_strains.get(nodes[i]).copied().unwrap_or(0.0);
            Some((nodes.clone(), element(kind, &ids, (&places, &free), law)?))
        };
        let cells = solid.cells.iter().flat_map(|(kind, cells)| cells.iter().map(move |own| (kind, own)));
        Self { elements: cells.filter_map(built).collect(), count: solid.nodes.len() }
    }

    /// Von Mises stress [Pa] and strain energy per volume [J/m³] at each node: of means over its elements by their volumes.
    pub fn numbers(&self, at: &Kinematics) -> Vec<[f64; 2]> {
        let mut sums = vec![(CauchyStress::zeros(), 0.0, 0.0); self.count];
        for (nodes, own) in &self.elements {
            let (volume, energy) = (own.volume(), own.strain(at));
            own.visit_stresses(at, &mut |node, stress| {
                let sum = &mut sums[nodes[node]];
                *sum = (sum.0 + volume * stress, sum.1 + energy, sum.2 + volume);
            });
        }
        sums.iter()
            .map(|(stress, energy, volume)| [von_mises(&(stress / *volume)), energy / volume])
            .collect()
    }
}
