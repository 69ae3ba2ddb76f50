//! Pressure on a shell element, along its present normal.
//!
//! Legend: p pressure, N bilinear functions, n normal times area per r and s.
//!
//! ```text
//! f_I = p Σ N_I n,      n = x,r × x,s,      δn = N_J,r δx_J × x,s + N_J,s x,r × δx_J
//! ```

use lissom_motion::{Matrix3, Vector3, skew};

use super::quadrilateral::{GAUSS_POINTS, NODES, bilinear};
use lissom_mechanics::elements::{Capabilities, Element, Load, Tangents, Unknowns, add_block};
use lissom_mechanics::kinematics::{Kinematics, NodeId};
use lissom_mechanics::registry::Function;

/// Pressure on a shell element.
#[derive(Clone, Debug)]
pub struct Pressure {
    nodes: [NodeId; NODES],
    /// Force per area along the normal [Pa].
    pressure: Function,
}

impl Pressure {
    /// Pressure along the normal [Pa] on the quadrilateral between `nodes`, counterclockwise about the normal.
    pub fn new(nodes: [NodeId; NODES], pressure: Function) -> Self {
        Self { nodes, pressure }
    }

    /// Forces on the nodes for a pressure of 1 Pa, and their derivatives with respect to the positions, global axes [m², m].
    fn areas(&self, at: &Kinematics) -> ([Vector3; NODES], [[Matrix3; NODES]; NODES]) {
        let origin = at.nodes[self.nodes[0]].frame.position;
        let positions = self.nodes.map(|node| at.nodes[node].frame.position - origin);
        let mut forces = [Vector3::zeros(); NODES];
        let mut slopes = [[Matrix3::zeros(); NODES]; NODES];
        for (r, s) in GAUSS_POINTS {
            let [shape, by_r, by_s] = bilinear(r, s);
            let slope = |by: &[f64; 4]| (0..NODES).map(|i| by[i] * positions[i]).sum::<Vector3>();
            let (along, across) = (slope(&by_r), slope(&by_s));
            let normal = along.cross(&across);
            for i in 0..NODES {
                forces[i] += shape[i] * normal;
                for j in 0..NODES {
                    slopes[i][j] += shape[i] * (by_s[j] * skew(&along) - by_r[j] * skew(&across));
                }
            }
        }
        (forces, slopes)
    }
}

impl Element for Pressure {
    fn unknowns(&self) -> Unknowns<'_> {
        Unknowns::of_nodes(&self.nodes)
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        let pressure = self.pressure.value(at.time);
        for (i, force) in self.areas(at).0.iter().enumerate() {
            let force = at.nodes[self.nodes[i]].frame.rotation.apply_inverse(&(pressure * force));
            out[6 * i..].iter_mut().zip(&force).for_each(|(sum, value)| *sum -= value);
        }
    }

    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        let pressure = self.pressure.value(at.time);
        let (forces, slopes) = self.areas(at);
        let rotations = self.nodes.map(|node| at.nodes[node].frame.rotation.matrix());
        for i in 0..NODES {
            let back = rotations[i].transpose();
            for j in 0..NODES {
                let block = -pressure * (back * slopes[i][j] * rotations[j]);
                add_block(&mut out.stiffness, 6 * NODES, (6 * i, 6 * j), &block);
            }
            let turning = skew(&(pressure * (back * forces[i])));
            add_block(&mut out.stiffness, 6 * NODES, (6 * i, 6 * i + 3), &-turning);
        }
    }

    fn capabilities(&self) -> Capabilities<'_> {
        Capabilities { load: Some(self), ..Capabilities::default() }
    }
}

impl Load for Pressure {
    fn breakpoints(&self) -> Vec<f64> {
        self.pressure.breakpoints()
    }

    fn depends_on_motion(&self) -> bool {
        true
    }
}
