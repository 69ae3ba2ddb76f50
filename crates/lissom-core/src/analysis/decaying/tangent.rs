//! Tangent of the energy-decaying scheme: from the single system's stiffness, damping and mass to jumps and
//! glides.
//!
//! ```text
//! δh_j = T(d_k) δd_k,      δh_f = Ad(exp(-d_g)) T(d_k) δd_k + T(d_g) δd_g
//! δF̄_g ≈ ½ K (δh_j + δh_f),      δF̄_k* ≈ ½ (1 + α) K δh_j
//! ```
//!
//! with K, D and M at the end of the step: in body axes they change little with the motion. The unknowns of the
//! linear system are jump and whole step, d_k and d_k + d_g: then the blocks of the jumps are
//! 6/(1 + α) M + α/6 K, definite for every α, and elimination needs no pivoting.

use lissom_motion::{Matrix6, Motion, tangent};
use nalgebra::SMatrix;

use super::super::equations::FAR;
use super::DecayingEquations;
use crate::joints::MOST_EQUATIONS;
use crate::joints::attached::{LOCAL, LocalGradient};
use crate::system::{Chart, LOCKED, Linearization, System};

/// Stiffness times the transports of the nodes, on the single system's pattern.
pub(super) struct Transported {
    /// K ½ (δh_j + δh_f) by jump and by glide, and K δh_j by jump.
    by_jump: Vec<f64>,
    by_glide: Vec<f64>,
    after_jump: Vec<f64>,
    nodes: Vec<NodeTransport>,
}

/// δh_j and δh_f of a node by its jump and glide.
#[derive(Clone, Copy)]
struct NodeTransport {
    after: Matrix6,
    end_by_jump: Matrix6,
    end_by_glide: Matrix6,
}

impl Transported {
    pub(super) fn new(system: &System) -> Self {
        let zeros = vec![0.0; system.structure().pattern.entries()];
        let identity = NodeTransport {
            after: Matrix6::identity(),
            end_by_jump: Matrix6::identity(),
            end_by_glide: Matrix6::identity(),
        };
        Self {
            by_jump: zeros.clone(),
            by_glide: zeros.clone(),
            after_jump: zeros,
            nodes: vec![identity; system.layout().node_count()],
        }
    }

    /// Multiplies the columns of every node by its transports.
    fn transport(&mut self, system: &System, stiffness: &[f64]) {
        self.by_jump.copy_from_slice(stiffness);
        self.by_glide.copy_from_slice(stiffness);
        self.after_jump.copy_from_slice(stiffness);
        for &row in &system.layout().coordinate_rows {
            // An algebraic coordinate is its own: δφ_f = δφ_k + δφ_g.
            let pattern = &system.structure().pattern;
            let range = pattern.column_starts()[row as usize]..pattern.column_starts()[row as usize + 1];
            for position in range {
                self.by_glide[position] *= 0.5;
            }
        }
        for (node, rows) in system.layout().node_rows.iter().enumerate() {
            let NodeTransport { after, end_by_jump, end_by_glide } = self.nodes[node];
            turn_columns(system, rows, stiffness, &(0.5 * (after + end_by_jump)), &mut self.by_jump);
            turn_columns(system, rows, stiffness, &(0.5 * end_by_glide), &mut self.by_glide);
            turn_columns(system, rows, stiffness, &after, &mut self.after_jump);
        }
    }
}

/// The free columns of a node times `factor`. All of them have the same rows.
fn turn_columns(system: &System, rows: &[u32; 6], from: &[f64], factor: &Matrix6, to: &mut [f64]) {
    let pattern = &system.structure().pattern;
    let free: Vec<usize> = (0..6).filter(|&k| rows[k] != LOCKED).collect();
    let Some(&first) = free.first() else { return };
    let height = pattern.column(rows[first] as usize).len();
    for offset in 0..height {
        for &j in &free {
            let target = pattern.column_starts()[rows[j] as usize] + offset;
            to[target] = free
                .iter()
                .map(|&i| from[pattern.column_starts()[rows[i] as usize] + offset] * factor[(i, j)])
                .sum();
        }
    }
}

/// Local matrix of a joint over jumps, glides, multipliers and definitions.
const DOUBLED: usize = 2 * LOCAL + MOST_EQUATIONS + 2;

impl DecayingEquations<'_> {
    pub(super) fn assemble_tangent(&mut self) {
        self.linearize();
        self.work.values.fill(0.0);
        self.add_elements();
        self.add_joints();
        let work = &mut *self.work;
        let (scale, penalty) = (self.scaled.scale(), self.scaled.augmented_factor());
        for &[row, column, augmented] in &work.layout.drives {
            work.values[row] += scale;
            work.values[column] += scale;
            work.values[augmented] += penalty;
        }
    }

    /// K, D and M at the end, with the mean twist of the step, and the transports.
    fn linearize(&mut self) {
        let inverse = 1.0 / self.scaled.step_size();
        for (node, rows) in self.system.layout().node_rows.iter().enumerate() {
            let mean = self.work.step[node];
            for (k, _) in rows.iter().enumerate().filter(|&(_, &row)| row != LOCKED) {
                self.work.end.nodes[node].twist[k] = inverse * mean[k];
            }
            let after = tangent(&self.work.jump.nodes[node]);
            let glide = self.work.glide.nodes[node];
            self.work.transported.nodes[node] = NodeTransport {
                after,
                end_by_jump: Motion::exponential(&glide).inverse().adjoint() * after,
                end_by_glide: tangent(&glide),
            };
        }
        let mut linearization = std::mem::replace(&mut self.work.linearization, Linearization::empty());
        let mut point = self.point(&self.work.end, &self.work.change_end);
        if self.work.correction > FAR {
            point.stressed = &self.start.kinematics;
        }
        self.system.linearize(&point, Chart::Body, &mut linearization);
        self.work.linearization = linearization;
        let work = &mut *self.work;
        work.transported.transport(self.system, &work.linearization.stiffness);
    }

    fn add_elements(&mut self) {
        let work = &mut *self.work;
        let weights = self.scheme.weights();
        let force = self.scaled.dynamic_factor();
        let inertia = self.scaled.inertia_factor();
        let rate = force / self.scaled.step_size();
        let Linearization { damping, mass, .. } = &work.linearization;
        let moved = &work.transported;
        for &(p, [jump_jump, jump_glide, glide_jump, glide_glide]) in &work.layout.blocks {
            let jump_by_jump = inertia * weights.after[0] * mass[p]
                + force / 3.0 * (0.5 * (1.0 + self.scheme.alpha) * moved.after_jump[p] - moved.by_jump[p]);
            let jump_by_glide = inertia * weights.after[1] * mass[p] - force / 3.0 * moved.by_glide[p];
            let glide_by_jump =
                inertia * weights.end[0] * mass[p] + rate * damping[p] + force * moved.by_jump[p];
            let glide_by_glide =
                inertia * weights.end[1] * mass[p] + rate * damping[p] + force * moved.by_glide[p];
            work.values[jump_jump] += jump_by_jump - jump_by_glide;
            work.values[jump_glide] += jump_by_glide;
            work.values[glide_jump] += glide_by_jump - glide_by_glide;
            work.values[glide_glide] += glide_by_glide;
        }
    }

    fn add_joints(&mut self) {
        for index in 0..self.system.joints().len() {
            let joint = &self.system.joints()[index];
            let (equations, own) = (joint.equations(), joint.coordinates.len());
            let unknowns = 12 + own;
            let local = self.joint_matrix(index);
            let positions = &self.work.layout.joints[index].positions;
            let size = 2 * unknowns + equations + own;
            // Places of the compact local rows in the full local matrix.
            let full = |i: usize| {
                if i < unknowns {
                    i
                } else if i < 2 * unknowns {
                    LOCAL + i - unknowns
                } else if i < 2 * unknowns + equations {
                    2 * LOCAL + i - 2 * unknowns
                } else {
                    2 * LOCAL + MOST_EQUATIONS + i - 2 * unknowns - equations
                }
            };
            for i in 0..size {
                for j in 0..size {
                    let position = positions[i * size + j];
                    if position != LOCKED {
                        self.work.values[position as usize] += local[(full(i), full(j))];
                    }
                }
            }
        }
    }

    /// Constraint rows, forces and augmented terms of a joint.
    fn joint_matrix(&self, index: usize) -> SMatrix<f64, DOUBLED, DOUBLED> {
        let joint = &self.system.joints()[index];
        let work = &*self.work;
        let [mean, jump] = &work.mean_rows[index];
        let end = joint.gradient_at(&joint.outright(&work.end));
        let after = joint.gradient_at(&joint.outright(&work.after));
        let nodes = joint.frames.map(|frame| work.transported.nodes[frame.node]);
        let moved = |rows: &LocalGradient, of: fn(&NodeTransport) -> &Matrix6| {
            let mut result = *rows;
            for (side, node) in nodes.iter().enumerate() {
                let columns = rows.fixed_columns::<6>(6 * side) * of(node);
                result.fixed_columns_mut::<6>(6 * side).copy_from(&columns);
            }
            result
        };
        let by_jump = moved(&end, |node| &node.end_by_jump);
        let by_glide = moved(&end, |node| &node.end_by_glide);
        let definitions = work.definers[index].transpose() * moved(&after, |node| &node.after);
        let defining = work.definers[index].transpose() * jump;
        let (scale, penalty) = (self.scaled.scale(), self.scaled.augmented_factor());

        let mut local = SMatrix::<f64, DOUBLED, DOUBLED>::zeros();
        let (glide, multipliers, own) = (LOCAL, 2 * LOCAL, 2 * LOCAL + MOST_EQUATIONS);
        let mut put = |row: usize, column: usize, value: f64| local[(row, column)] += value;
        for i in 0..LOCAL {
            for k in 0..MOST_EQUATIONS {
                put(glide + i, multipliers + k, scale * mean[(k, i)]);
                put(i, multipliers + k, -scale / 3.0 * (mean[(k, i)] - jump[(k, i)]));
                put(multipliers + k, i, scale * (by_jump[(k, i)] - by_glide[(k, i)]));
                put(multipliers + k, glide + i, scale * by_glide[(k, i)]);
            }
            for c in 0..2 {
                put(i, own + c, scale * defining[(c, i)]);
                put(own + c, i, scale * definitions[(c, i)]);
            }
        }
        let augmented_jump = penalty * mean.tr_mul(&by_jump);
        let augmented_glide = penalty * mean.tr_mul(&by_glide);
        let curving = (mean - jump) / 3.0;
        let curving_jump = penalty * curving.tr_mul(&(by_jump - by_glide));
        let curving_glide = penalty * curving.tr_mul(&by_glide);
        let augmented_definition = penalty * defining.tr_mul(&definitions);
        for i in 0..LOCAL {
            for j in 0..LOCAL {
                put(glide + i, j, augmented_jump[(i, j)] - augmented_glide[(i, j)]);
                put(glide + i, glide + j, augmented_glide[(i, j)]);
                put(i, j, augmented_definition[(i, j)] - curving_jump[(i, j)]);
                put(i, glide + j, -curving_glide[(i, j)]);
            }
        }
        local
    }
}
