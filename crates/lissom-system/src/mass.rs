//! Masses of elements, and the momentum of a system.

use lissom_mechanics::elements::OwnInertia;
use lissom_mechanics::kinematics::{Kinematics, NodeId, split};
use lissom_motion::Vector3;

use super::System;

/// The mass matrix of an element with mass of its own.
#[derive(Clone, Copy)]
pub struct Mass<'a> {
    /// Nodes of the element.
    pub nodes: &'a [NodeId],
    /// Row of each local unknown.
    pub rows: &'a [u32],
    /// Row by row.
    pub matrix: &'a [f64],
}

impl Mass<'_> {
    /// Each local unknown's component of M x, with its row.
    pub fn times<T: Copy + std::iter::Sum<T> + std::ops::Mul<f64, Output = T>>(
        &self,
        local: &[T],
        mut each: impl FnMut(usize, T),
    ) {
        for (i, row) in self.matrix.chunks_exact(self.rows.len()).enumerate() {
            each(i, local.iter().zip(row).map(|(value, entry)| *value * *entry).sum());
        }
    }
}

impl System {
    /// Passes the mass matrix of every element that has one, besides [`inertias`](Self::inertias), to `each`.
    pub fn masses(&self, at: &Kinematics, each: &mut dyn FnMut(&Mass<'_>)) {
        self.each_own_mass(at, |_, mass| each(mass));
    }

    /// Passes every element that has a mass matrix, and the matrix, to `each`.
    pub(crate) fn each_own_mass(&self, at: &Kinematics, mut each: impl FnMut(&dyn OwnInertia, &Mass<'_>)) {
        let mut matrix = Vec::new();
        for batch in &self.batches {
            for (item, element) in batch.elements_with(|own| own.inertia).enumerate() {
                element.mass(at, &mut matrix);
                if !matrix.is_empty() {
                    let (nodes, rows) = (element.unknowns().nodes, batch.rows().of(item));
                    each(element, &Mass { nodes, rows, matrix: &matrix });
                    matrix.clear();
                }
            }
        }
    }

    /// Momentum [N s] and angular momentum about the origin [N m s], in inertial axes.
    pub fn momentum(&self, at: &Kinematics) -> (Vector3, Vector3) {
        let mut linear = Vector3::zeros();
        let mut angular = Vector3::zeros();
        for inertia in &self.inertias {
            let node = &at.nodes[inertia.node()];
            let (p, l) = split(&(inertia.mass() * node.twist));
            let p = node.frame.rotation.apply(&p);
            linear += p;
            angular += node.frame.rotation.apply(&l) + node.frame.position.cross(&p);
        }
        self.masses(at, &mut |mass| {
            let rates = self.local_rates(mass, at);
            let mut momenta = vec![0.0; rates.len()];
            mass.times(&rates, |row, value| momenta[row] = value);
            for (&node, momentum) in mass.nodes.iter().zip(momenta.chunks_exact(6)) {
                let frame = &at.nodes[node].frame;
                let p = frame.rotation.apply(&Vector3::from_column_slice(&momentum[..3]));
                let l = frame.rotation.apply(&Vector3::from_column_slice(&momentum[3..]));
                linear += p;
                angular += l + frame.position.cross(&p);
            }
        });
        for batch in &self.batches {
            let momenta = batch.elements_with(|own| own.inertia).map(|element| element.angular_momentum(at));
            angular += momenta.sum::<Vector3>();
        }
        (linear, angular)
    }

    /// Twists of an element's nodes and rates of its coordinates.
    pub(crate) fn local_rates(&self, mass: &Mass<'_>, at: &Kinematics) -> Vec<f64> {
        let twists = mass.nodes.iter().flat_map(|&node| at.nodes[node].twist.iter().copied());
        let coordinates = mass.rows[6 * mass.nodes.len()..].iter();
        let rates = coordinates.map(|&row| {
            let found = self.layout.coordinate_rows.iter().position(|own| *own == row);
            found.map_or(0.0, |coordinate| at.coordinates[coordinate].rate)
        });
        twists.chain(rates).collect()
    }
}
