//! Residual and linearisation of the whole system in SI. Independent of time step, scheme and scaling.
//!
//! ```text
//! coordinates:  M(q) a + f(q, v, t) + Bᵀ μ,   μ = λ + w c        multipliers:  c(q, t)
//! ```
//!
//! where the caller chooses the weight w of the augmented Lagrangian term.

use std::sync::Arc;

use lissom_motion::WIDTH;

use super::{JointLanes, System};
use lissom_mechanics::elements::{Deformable, Load};
use lissom_mechanics::evaluation::batch::{AnyBatch, scatter, scatter_lane};
use lissom_mechanics::evaluation::linearization::{Linearization, Scratch};
use lissom_mechanics::evaluation::tangent_assembler::{Slot, TangentAssembler};
use lissom_mechanics::evaluation::threads::Threads;
use lissom_mechanics::joints::blocks::{Results, Wanted};
use lissom_mechanics::joints::derivatives::{Derivatives, LOCAL, OWN, TIP};
use lissom_mechanics::joints::evaluation_point::{Augmentation, Chart, Increments, Point};
use lissom_mechanics::kinematics::{Kinematics, LOCKED, MotionChange};

impl System {
    /// Zeros for the linearised equations of motion.
    pub fn empty_linearization(&self) -> Linearization {
        Linearization::zeros(self.structure.pattern.entries())
    }

    /// The equations of motion linearised about a state: without increments of a step, multipliers or an augmented term.
    pub fn linearization_at(&self, at: &Kinematics) -> Linearization {
        let mut linearization = self.empty_linearization();
        self.linearize_at(at, Augmentation::none(), &mut linearization);
        linearization
    }

    /// The equations of motion linearised about a state: without increments of a step or multipliers.
    pub fn linearize_at(&self, at: &Kinematics, augmentation: Augmentation, out: &mut Linearization) {
        let still = vec![MotionChange::none(); at.nodes.len()];
        let unchanged = vec![0.0; at.coordinates.len()];
        let zero = vec![0.0; self.layout.multiplier_count];
        let point = Point {
            at,
            stressed: at.into(),
            increments: Increments { start: at, nodes: &still, coordinates: &unchanged, joints: None },
            multipliers: &zero,
            violations: &zero,
            augmentation,
        };
        self.linearize(&point, Chart::Body, out);
    }

    /// Residual at `point`: left-hand sides of the equations of motion in the rows of the coordinates, violations in
    /// the rows of the multipliers.
    pub fn residual(&self, point: &Point<'_>, out: &mut [f64]) {
        out.fill(0.0);
        for batch in &self.batches {
            batch.forces(point.at, out);
        }
        for (batch, starts) in self.joint_lanes.batches.with_starts(point.increments.joints) {
            let blocks = 0..batch.indices().len().div_ceil(WIDTH);
            batch.evaluate(Wanted::All, point, starts, blocks, &mut |block, results| {
                for (lane, item) in batch.block_items(block).enumerate() {
                    let rows = self.rows_of_joint(batch.indices()[item] as usize);
                    scatter_joint(rows, results, lane, out);
                }
            });
        }
        self.add_others(point, out);
    }

    /// Computes the [`residual`](Self::residual) on several threads, equal to the last bit.
    pub fn residual_side_by_side(&self, point: &Point<'_>, threads: &mut Threads, out: &mut [f64]) {
        out.fill(0.0);
        for batch in &self.batches {
            batch.forces_side_by_side(point.at, threads, out);
        }
        for (batch, starts) in self.joint_lanes.batches.with_starts(point.increments.joints) {
            let firsts = batch.starts();
            let locals = threads.side_by_side(firsts, &|joints, locals| {
                let first = firsts[joints.start];
                let blocks = joints.start / WIDTH..joints.end.div_ceil(WIDTH);
                batch.evaluate(Wanted::All, point, starts, blocks, &mut |block, results| {
                    for (lane, item) in batch.block_items(block).enumerate() {
                        let own = &mut locals[firsts[item] - first..firsts[item + 1] - first];
                        for (local, numbers) in own.iter_mut().zip(results) {
                            *local = numbers[lane];
                        }
                    }
                });
            });
            for (item, &index) in batch.indices().iter().enumerate() {
                scatter(self.rows_of_joint(index as usize), &locals[firsts[item]..firsts[item + 1]], out);
            }
        }
        self.add_others(point, out);
    }

    /// Rows of a joint's local unknowns and equations.
    pub fn rows_of_joint(&self, joint: usize) -> &[u32] {
        let JointLanes { rows, starts, .. } = &self.joint_lanes;
        &rows[starts[joint]..starts[joint + 1]]
    }

    /// Only the violations at `point`, by multiplier.
    pub fn stage_violations(&self, point: &Point<'_>, out: &mut [f64]) {
        for (batch, starts) in self.joint_lanes.batches.with_starts(point.increments.joints) {
            let blocks = 0..batch.indices().len().div_ceil(WIDTH);
            batch.evaluate(Wanted::Violations, point, starts, blocks, &mut |block, results| {
                for (lane, item) in batch.block_items(block).enumerate() {
                    let joint = &self.constraints.joints[batch.indices()[item] as usize];
                    let own = &mut out[joint.first_multiplier..joint.first_multiplier + joint.equations()];
                    for (violation, numbers) in own.iter_mut().zip(&results[LOCAL..]) {
                        *violation = numbers[lane];
                    }
                }
            });
        }
        self.violations_of_others(point, out);
    }

    /// Linearisation at `point` with respect to the unknowns of `chart`.
    pub fn linearize(&self, point: &Point<'_>, chart: Chart<'_>, out: &mut Linearization) {
        let mut scratch = out.scratch.take().unwrap_or_default();
        self.assemble_tangent(point, chart, &mut scratch, &mut TangentAssembler::Separate(out));
        out.scratch = Some(scratch);
    }

    /// Linearisation of the constraints, and of those kinds of elements only that `kinds` selects.
    pub fn linearize_kinds(
        &self,
        kinds: &[bool],
        point: &Point<'_>,
        chart: Chart<'_>,
        out: &mut Linearization,
    ) {
        let mut scratch = out.scratch.take().unwrap_or_default();
        let mut receiver = TangentAssembler::Separate(out);
        receiver.clear();
        for (batch, _) in self.batches.iter().zip(kinds).filter(|(_, is_chosen)| **is_chosen) {
            batch.linearize((point.at, point.stressed), chart, &mut scratch.local, &mut receiver);
        }
        self.linearize_constraints(point, chart, &mut scratch.joint, &mut receiver);
        out.scratch = Some(scratch);
    }

    /// Passes the derivatives at `point` with respect to the unknowns of `chart` to `out`.
    pub fn assemble_tangent(
        &self,
        point: &Point<'_>,
        chart: Chart<'_>,
        scratch: &mut Scratch,
        out: &mut TangentAssembler<'_>,
    ) {
        out.clear();
        for batch in &self.batches {
            batch.linearize((point.at, point.stressed), chart, &mut scratch.local, out);
        }
        self.linearize_constraints(point, chart, &mut scratch.joint, out);
    }

    /// Whether an element predicts the stresses of the geometric stiffness from the configuration before a correction.
    pub fn predicts_stresses(&self) -> bool {
        self.elements_with(|own| own.deformation).any(Deformable::predicts_stresses)
    }

    /// Whether there are elements that may be stiff.
    pub fn has_stiff_elements(&self) -> bool {
        self.batches.iter().any(|batch| batch.may_be_stiff())
    }

    /// Adds the derivatives of those elements that may be stiff, or of the others, with respect to body variations.
    pub fn linearize_elements(
        &self,
        stiff: bool,
        at: &Kinematics,
        scratch: &mut Scratch,
        out: &mut TangentAssembler<'_>,
    ) {
        for batch in self.batches.iter().filter(|batch| batch.may_be_stiff() == stiff) {
            batch.linearize((at, at.into()), Chart::Body, &mut scratch.local, out);
        }
    }

    /// Forces of those elements that may be stiff.
    pub fn stiff_forces(&self, at: &Kinematics, out: &mut [f64]) {
        out.fill(0.0);
        for batch in self.batches.iter().filter(|batch| batch.may_be_stiff()) {
            batch.forces(at, out);
        }
    }

    /// Elements whose forces may depend on time.
    fn batches_over_time(&self) -> impl Iterator<Item = &Arc<dyn AnyBatch>> {
        let is_active = |batch: &&Arc<dyn AnyBatch>| batch.elements_with(|own| own.load).any(Load::is_active);
        self.batches.iter().filter(is_active)
    }

    /// Forces of those elements that may depend on time.
    pub fn forces_over_time(&self, at: &Kinematics, out: &mut [f64]) {
        out.fill(0.0);
        for batch in self.batches_over_time() {
            batch.forces(at, out);
        }
    }

    /// Whether there are elements whose forces may depend on time.
    pub fn has_forces_over_time(&self) -> bool {
        self.batches_over_time().next().is_some()
    }

    /// Adds the derivatives of constraints.
    pub fn linearize_constraints(
        &self,
        point: &Point<'_>,
        chart: Chart<'_>,
        scratch: &mut Derivatives,
        out: &mut TangentAssembler<'_>,
    ) {
        for (batch, starts) in self.joint_lanes.batches.with_starts(point.increments.joints) {
            batch.linearize(
                &self.constraints.joints,
                point,
                starts,
                chart,
                scratch,
                &mut |index, derivatives| {
                    let place = Slot {
                        rows: self.rows_of_joint(index),
                        segments: self.joint_lanes.positions.of(index),
                    };
                    out.add_joint(place, derivatives);
                },
            );
        }
        self.linearize_others(point, chart, out);
    }
}

/// Adds one lane of a block's forces and violations.
fn scatter_joint(rows: &[u32], results: &Results, lane: usize, out: &mut [f64]) {
    scatter_lane(&rows[..6], &results[..6], lane, out);
    scatter_lane(&rows[TIP..OWN], &results[TIP..OWN], lane, out);
    for (&row, force) in rows[OWN..LOCAL].iter().zip(&results[OWN..]).filter(|&(&row, _)| row != LOCKED) {
        out[row as usize] += force[lane];
    }
    // A joint's multipliers are consecutive.
    if let Some(&first) = rows.get(LOCAL) {
        let violations = &mut out[first as usize..][..rows.len() - LOCAL];
        for (value, violation) in violations.iter_mut().zip(&results[LOCAL..]) {
            *value = violation[lane];
        }
    }
}
