//! Stresses and energies of an elastic solid at positions of its nodes, by elements like those of the run.

use lissom_core::flexible::solid::law::{SolidLaw, SolidModel};
use lissom_core::flexible::solid::{CauchyStress, Hexahedron, Tetrahedron, von_mises};
use lissom_core::kinematics::Kinematics;
use lissom_model::scene::ElasticSolid;
use lissom_motion::Vector3;

/// The elements of a solid, each with the indices of its nodes in the solid.
pub struct SolidElements {
    tetrahedra: Vec<([usize; 10], Tetrahedron)>,
    hexahedra: Vec<([usize; 20], Hexahedron)>,
    count: usize,
}

impl SolidElements {
    /// Those of a solid.
    pub fn new(solid: &ElasticSolid) -> Self {
        let model = if solid.is_neo_hookean { SolidModel::NeoHookean } else { SolidModel::StVenantKirchhoff };
        let law = SolidLaw { model, shear: solid.shear, bulk: solid.bulk };
        let place = |node: usize| Vector3::from(solid.positions[node]);
        let node = |index: usize| solid.nodes[index];
        let tetrahedra = solid
            .tetrahedra
            .iter()
            .filter_map(|own| Some((*own, Tetrahedron::new(own.map(node), &own.map(place), law).ok()?)));
        let hexahedra = solid
            .hexahedra
            .iter()
            .filter_map(|own| Some((*own, Hexahedron::new(own.map(node), &own.map(place), law).ok()?)));
        Self { tetrahedra: tetrahedra.collect(), hexahedra: hexahedra.collect(), count: solid.nodes.len() }
    }

    /// Means at the nodes by the volumes of their elements: of the stresses and of the strain energy per volume.
    fn means(&self, at: &Kinematics) -> Vec<(CauchyStress, f64)> {
        let mut sums = vec![(CauchyStress::zeros(), 0.0, 0.0); self.count];
        let mut add = |nodes: &[usize], stresses: &[CauchyStress], energy: f64, volume: f64| {
            for (&node, stress) in nodes.iter().zip(stresses) {
                let sum = &mut sums[node];
                *sum = (sum.0 + volume * stress, sum.1 + energy, sum.2 + volume);
            }
        };
        for (nodes, own) in &self.tetrahedra {
            let positions = own.positions(at);
            add(nodes, &own.nodal_stresses(&positions), own.strain_energy(&positions), own.volume());
        }
        for (nodes, own) in &self.hexahedra {
            let positions = own.positions(at);
            add(nodes, &own.nodal_stresses(&positions), own.strain_energy(&positions), own.volume());
        }
        sums.into_iter().map(|(stress, energy, volume)| (stress / volume, energy / volume)).collect()
    }

    /// Von Mises stress at each node [Pa].
    pub fn von_mises(&self, at: &Kinematics) -> Vec<f64> {
        self.means(at).iter().map(|(stress, _)| von_mises(stress)).collect()
    }

    /// Strain energy per volume at each node [J/m³].
    pub fn energy(&self, at: &Kinematics) -> Vec<f64> {
        self.means(at).iter().map(|(_, energy)| *energy).collect()
    }
}
