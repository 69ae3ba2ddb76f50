//! Dependence of an assembly's inertia on displacements along straight lines, with sections that do not rotate.
//!
//! Legend: M mass matrix of the assembly, Ψ_k shapes, w_i = (e_i × X, e_i) rotation about the first interface and W_i Ψ_k = (e_i
//! × Ψ_k, 0) its change for displaced nodes, translations and rotations of all nodes.
//!
//! ```text
//! J_ij = (w_i + W_i Ψ y)·M (w_j + W_j Ψ y)          c_i ẏ = (w_i + W_i Ψ y)·M Ψ ẏ
//! ```
//!
//! The kinetic energy is a square of velocities in the metric of M, and so positive for all displacements.

use lissom_motion::Vector3;
use nalgebra::{DMatrix, DVector};

use crate::flexible::superelement::{PAIRS, TurningMatrices};
use crate::kinematics::{Kinematics, LOCKED, NodeId};
use crate::system::System;

/// An assembly at rest, and the values of its mass matrix.
pub(super) struct CarriedPoints<'a> {
    pub(super) system: &'a System,
    pub(super) at: &'a Kinematics,
    pub(super) origin: Vector3,
    pub(super) mass: &'a [f64],
}

impl CarriedPoints<'_> {
    /// w_i, or W_i of a shape.
    fn carried(&self, axis: &Vector3, shape: Option<&[f64]>) -> Vec<f64> {
        let layout = self.system.layout();
        let mut velocity = vec![0.0; layout.size()];
        for (node, motion) in NodeId::enumerate(&self.at.nodes).skip(1) {
            let (rows, rotation) = (layout.rows_of_node(node), &motion.frame.rotation);
            let own = |k: usize| {
                let value = |shape: &&[f64]| if rows[k] == LOCKED { 0.0 } else { shape[rows[k] as usize] };
                shape.as_ref().map_or(0.0, value)
            };
            let arm = match shape {
                Some(_) => rotation.apply(&Vector3::new(own(0), own(1), own(2))),
                None => motion.frame.position - self.origin,
            };
            let linear = rotation.apply_inverse(&axis.cross(&arm));
            let angular = if shape.is_none() { rotation.apply_inverse(axis) } else { Vector3::zeros() };
            for (k, value) in linear.iter().chain(angular.iter()).enumerate() {
                if rows[k] != LOCKED {
                    velocity[rows[k] as usize] = *value;
                }
            }
        }
        velocity
    }

    fn momentum(&self, velocity: &[f64]) -> Vec<f64> {
        let mut image = vec![0.0; velocity.len()];
        self.system.pattern().multiply(self.mass, velocity, &mut image);
        image
    }

    /// α, A and B over shapes, of which those before `first` are not displaced relative to the floating frame.
    pub(super) fn turning(&self, shapes: &[Vec<f64>], first: usize) -> TurningMatrices {
        let size = shapes.len();
        let axes = [0, 1, 2].map(|k| Vector3::ith(k, 1.0));
        let carried = axes.map(|axis| -> Vec<Vec<f64>> {
            shapes.iter().map(|shape| self.carried(&axis, Some(shape))).collect()
        });
        let momenta = carried
            .each_ref()
            .map(|own| -> Vec<Vec<f64>> { own.iter().map(|velocity| self.momentum(velocity)).collect() });
        let rigid = axes.map(|axis| self.carried(&axis, None));
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let mut slope = DMatrix::zeros(PAIRS.len(), size);
        for (row, [i, j]) in PAIRS.into_iter().enumerate() {
            let of = |k: usize| dot(&rigid[i], &momenta[j][k]) + dot(&rigid[j], &momenta[i][k]);
            slope.row_mut(row).tr_copy_from(&DVector::from_fn(size, |k, _| of(k)));
        }
        let moves = |k: usize, l: usize| k >= first && l >= first;
        let inertia = PAIRS.map(|[i, j]| {
            let of = |k: usize, l: usize| {
                dot(&carried[i][k], &momenta[j][l]) + dot(&carried[j][k], &momenta[i][l])
            };
            DMatrix::from_fn(size, size, |k, l| if moves(k, l) { of(k, l) } else { 0.0 })
        });
        let momentum = [0, 1, 2].map(|i| {
            DMatrix::from_fn(
                size,
                size,
                |k, l| if moves(k, l) { dot(&momenta[i][k], &shapes[l]) } else { 0.0 },
            )
        });
        TurningMatrices { slope, inertia, momentum }
    }
}
