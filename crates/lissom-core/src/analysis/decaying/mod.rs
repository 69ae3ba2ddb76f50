//! The energy-decaying scheme's equations of one step, as Newton's method sees them.
//!
//! Unknowns: jump d_k (i to j) and glide d_g (j to f) of every node, H_j = H_i exp d_k, H_f = H_j exp d_g;
//! multipliers λ of the constraints at f; and one multiplier κ per algebraic coordinate.
//!
//! ```text
//! glide rows:  M (v_f - v_i) - Γ + F̄_g + B̄_gᵀ λ = 0,              Γ = ad_{v_g}ᵀ M v_g
//! jump rows:   M (v_j - v_i) - ⅓ (F̄_g - F̄_k* + (B̄_g - B̄_k)ᵀ λ) + B̄_kᵀ a κ = 0
//! C_f = 0,     aᵀ C_j = 0
//! ```
//!
//! All mean forces and gradients give exactly the change of what they belong to, so that the constraints'
//! work is λ·(C_f - C_j + C_j - C_i) = 0.
//! Enforcing C_j = 0 as well would be of first order only: after the jump a point on a curve lies off the curve
//! by h² a/6. An algebraic coordinate has no inertia to place it after the jump; a, the gradient of the
//! equations with respect to it, picks the one that defines it.

mod layout;
mod tangent;
#[cfg(test)]
mod tests;

use lissom_motion::{Motion, Vector6, coadjoint_times};
use lissom_solver::{FactorError, FactorReport, LinearSolver, SolverKind, condition_estimate};

pub(crate) use layout::DoubledLayout;

use super::approach::Approachable;
use super::initial::Initial;
use crate::elements::interval::Interval;
use crate::joints::MOST_COORDINATES;
use crate::joints::attached::{Increments, LocalGradient};
use crate::newton::{Correction, Equations};
use crate::scaling::{Representative, Scaled, UnitStart};
use crate::schemes::energy_decaying::TimeDiscontinuous;
use crate::system::{Kinematics, LOCKED, Linearization, MotionChange, Point, State, System};

/// Corrections larger than this are cut short [rad].
const LARGEST_ROTATION: f64 = 1.0;

/// Everything a step needs besides system and state.
pub(crate) struct DecayingWorkspace {
    pub(crate) layout: DoubledLayout,
    pub(crate) unit: UnitStart,
    jump: Part,
    glide: Part,
    /// Increments over the whole step: the sums.
    step: Vec<Vector6>,
    after: Kinematics,
    end: Kinematics,
    change_after: Changes,
    change_end: Changes,
    rate_after: Vec<f64>,
    pub(crate) rate_end: Vec<f64>,
    /// Multipliers λ [N, N m], and κ in scaled units.
    pub(crate) multipliers: Vec<f64>,
    definitions: Vec<f64>,
    violations_after: Vec<f64>,
    violations_end: Vec<f64>,
    /// B̄_g over the glide and B̄_k over the jump, by joint.
    mean_rows: Vec<[LocalGradient; 2]>,
    /// ∂c/∂φ at the start, by joint.
    definers: Vec<nalgebra::SMatrix<f64, 6, MOST_COORDINATES>>,
    residual: Vec<f64>,
    /// The correction before, as far as it stands, and whether it was just halved.
    before: Vec<f64>,
    backed_off: bool,
    /// Size of the last correction of places.
    correction: f64,
    /// Jump and glide of a smaller step, see `approach`.
    saved: [Vec<f64>; 2],
    linearization: Linearization,
    transported: tangent::Transported,
    solver: Box<dyn LinearSolver<f64>>,
    values: Vec<f64>,
    sizes: Vec<f64>,
    pub(crate) report: Option<FactorReport>,
    /// For the projection of the velocities at the end of the step.
    pub(crate) initial: Initial,
}

/// Increments over a part of the step, and its forces.
struct Part {
    /// By coordinate row.
    increments: Vec<f64>,
    nodes: Vec<Vector6>,
    coordinates: Vec<f64>,
    forces: Vec<f64>,
}

impl Part {
    fn new(count: usize, size: usize, at: &Kinematics) -> Self {
        Self {
            increments: vec![0.0; count],
            nodes: vec![Vector6::zeros(); at.nodes.len()],
            coordinates: vec![0.0; at.coordinates.len()],
            forces: vec![0.0; size],
        }
    }
}

struct Changes {
    nodes: Vec<MotionChange>,
    coordinates: Vec<f64>,
}

impl Changes {
    fn new(at: &Kinematics) -> Self {
        Self {
            nodes: vec![MotionChange::none(); at.nodes.len()],
            coordinates: vec![0.0; at.coordinates.len()],
        }
    }
}

impl DecayingWorkspace {
    pub(crate) fn new(
        system: &System,
        state: &State,
        representative: &Representative,
        solver: &SolverKind,
    ) -> Self {
        let layout = DoubledLayout::new(system);
        let at = &state.kinematics;
        let count = layout.coordinates;
        let part = || Part::new(count, system.layout().size(), at);
        let mut sizes = vec![1.0; count];
        for rows in &system.layout().node_rows {
            for &row in rows[..3].iter().filter(|&&row| row != LOCKED) {
                sizes[row as usize] = 1.0 / representative.length;
            }
        }
        let entries = layout.structure.pattern.entries();
        Self {
            unit: UnitStart::new(count),
            jump: part(),
            glide: part(),
            step: vec![Vector6::zeros(); at.nodes.len()],
            after: at.clone(),
            end: at.clone(),
            change_after: Changes::new(at),
            change_end: Changes::new(at),
            rate_after: vec![0.0; count],
            rate_end: vec![0.0; count],
            multipliers: state.multipliers.clone(),
            definitions: vec![0.0; at.coordinates.len()],
            violations_after: vec![0.0; layout.multipliers],
            violations_end: vec![0.0; layout.multipliers],
            mean_rows: vec![[LocalGradient::zeros(); 2]; system.joints().len()],
            definers: vec![nalgebra::SMatrix::zeros(); system.joints().len()],
            residual: vec![0.0; layout.size()],
            before: vec![0.0; layout.size()],
            backed_off: false,
            correction: f64::INFINITY,
            saved: [Vec::new(), Vec::new()],
            linearization: Linearization::new(system),
            transported: tangent::Transported::new(system),
            solver: (solver.real)(&layout.structure),
            values: vec![0.0; entries],
            sizes,
            report: None,
            initial: Initial::new(system, state, representative, solver),
            layout,
        }
    }

    pub(crate) fn factor_entries(&self) -> usize {
        self.solver.factor_entries()
    }

    /// Condition number of the tangent factored last, estimated in the 1-norm.
    pub(crate) fn condition_estimate(&mut self) -> f64 {
        condition_estimate(&mut *self.solver, &self.layout.structure.pattern, &self.values)
    }

    /// Motion at the end of the step, its changes since the start and the violations there.
    pub(crate) fn end(&self) -> (&Kinematics, &[MotionChange], &[f64]) {
        (&self.end, &self.change_end.nodes, &self.violations_end)
    }
}

/// One step from `start`.
pub(crate) struct DecayingEquations<'a> {
    pub(crate) system: &'a System,
    pub(crate) scheme: TimeDiscontinuous,
    pub(crate) scaled: Scaled,
    /// The scaling of the step of a given share.
    pub(crate) rescale: &'a dyn Fn(f64) -> Scaled,
    pub(crate) start: &'a State,
    pub(crate) work: &'a mut DecayingWorkspace,
}

impl DecayingEquations<'_> {
    /// First guess: going straight on. Accelerations of stiff parts, at large steps, mean nothing.
    pub(crate) fn predict(&mut self) {
        let work = &mut *self.work;
        work.correction = f64::INFINITY;
        for row in 0..work.layout.coordinates {
            work.jump.increments[row] = 0.0;
            work.glide.increments[row] = work.unit.rate[row];
        }
        work.multipliers.copy_from_slice(&self.start.multipliers);
        work.definitions.fill(0.0);
        for (joint, definer) in self.system.joints().iter().zip(&mut work.definers) {
            let rows = joint.gradient_at(&joint.outright(&self.start.kinematics));
            definer.copy_from(&rows.fixed_columns::<MOST_COORDINATES>(12));
        }
        self.update();
    }

    /// Configurations, rates and mean quantities from the increments.
    pub(crate) fn update(&mut self) {
        self.move_nodes();
        let work = &mut *self.work;
        for row in 0..work.layout.coordinates {
            let (after, end) =
                self.scheme.rates(work.jump.increments[row], work.glide.increments[row], work.unit.rate[row]);
            work.rate_after[row] = after;
            work.rate_end[row] = end;
        }
        let mut after = std::mem::take(&mut self.work.violations_after);
        let mut end = std::mem::take(&mut self.work.violations_end);
        self.system.stage_violations(&self.point(&self.work.after, &self.work.change_after), &mut after);
        self.system.stage_violations(&self.point(&self.work.end, &self.work.change_end), &mut end);
        self.work.violations_after = after;
        self.work.violations_end = end;
        self.update_gradients();
    }

    fn move_nodes(&mut self) {
        let work = &mut *self.work;
        let from = &self.start.kinematics;
        (work.after.time, work.after.elapsed) = (from.time, 0.0);
        work.end.elapsed = self.scaled.step_size();
        work.end.time = from.time + work.end.elapsed;
        for (node, rows) in self.system.layout().node_rows.iter().enumerate() {
            let mut jump = Vector6::zeros();
            let mut glide = Vector6::zeros();
            for (k, &row) in rows.iter().enumerate().filter(|&(_, &row)| row != LOCKED) {
                jump[k] = work.jump.increments[row as usize];
                glide[k] = work.glide.increments[row as usize];
            }
            let start = from.nodes[node].frame;
            let after = start * Motion::exponential(&jump);
            work.after.nodes[node].frame = after;
            work.end.nodes[node].frame = after * Motion::exponential(&glide);
            let change = MotionChange::exponential(&jump);
            work.change_after.nodes[node] = change;
            work.change_end.nodes[node] = change.then(&MotionChange::exponential(&glide));
            work.jump.nodes[node] = jump;
            work.glide.nodes[node] = glide;
            work.step[node] = jump + glide;
        }
        for (coordinate, &row) in self.system.layout().coordinate_rows.iter().enumerate() {
            let (jump, glide) = (work.jump.increments[row as usize], work.glide.increments[row as usize]);
            let start = from.coordinates[coordinate].value;
            work.after.coordinates[coordinate].value = start + jump;
            work.end.coordinates[coordinate].value = start + jump + glide;
            work.jump.coordinates[coordinate] = jump;
            work.glide.coordinates[coordinate] = glide;
            work.change_after.coordinates[coordinate] = jump;
            work.change_end.coordinates[coordinate] = jump + glide;
        }
    }

    fn point<'b>(&'b self, at: &'b Kinematics, changes: &'b Changes) -> Point<'b> {
        Point {
            at,
            stressed: at,
            increments: Increments {
                start: &self.start.kinematics,
                nodes: &changes.nodes,
                coordinates: &changes.coordinates,
            },
            multipliers: &self.work.multipliers,
            violations: &self.start.violations,
            augmentation: self.scaled.augmentation(),
        }
    }

    fn update_gradients(&mut self) {
        let work = &mut *self.work;
        let from = &self.start.kinematics;
        let glide = interval(&work.glide, &work.after, &work.end, 0.0, 0.0);
        let jump = interval(&work.jump, from, &work.after, 0.0, 0.0);
        for (joint, rows) in self.system.joints().iter().zip(&mut work.mean_rows) {
            let first = joint.first_multiplier;
            let change = |from: &[f64], to: &[f64]| {
                let mut change = crate::joints::Equations::default();
                for k in 0..joint.equations() {
                    change[k] = to[first + k] - from[first + k];
                }
                change
            };
            *rows = [
                joint.mean_gradient(&glide, &change(&work.violations_after, &work.violations_end)),
                joint.mean_gradient(&jump, &change(&self.start.violations, &work.violations_after)),
            ];
        }
    }

    /// Mean forces of the elements over jump and glide.
    fn evaluate_forces(&mut self) {
        let work = &mut *self.work;
        let mut jump = std::mem::take(&mut work.jump.forces);
        let mut glide = std::mem::take(&mut work.glide.forces);
        jump.fill(0.0);
        glide.fill(0.0);
        let over_jump =
            interval(&work.jump, &self.start.kinematics, &work.after, 0.5 * self.scheme.alpha, 0.0);
        let over_glide = interval(&work.glide, &work.after, &work.end, 0.0, self.scaled.step_size());
        for batch in &self.system.batches {
            batch.mean_forces(&over_jump, &mut jump);
            batch.mean_forces(&over_glide, &mut glide);
        }
        work.jump.forces = jump;
        work.glide.forces = glide;
    }

    fn evaluate(&mut self) {
        self.evaluate_forces();
        let work = &mut *self.work;
        let count = work.layout.coordinates;
        let (force, inertia) = (self.scaled.dynamic_factor(), self.scaled.inertia_factor());
        work.residual.fill(0.0);
        for row in 0..count {
            let (jump, glide) = (work.jump.forces[row], work.glide.forces[row]);
            work.residual[row] = -force / 3.0 * (glide - jump);
            work.residual[count + row] = force * glide;
        }
        for element in self.system.inertias() {
            let rows = self.system.layout().rows_of_node(element.node());
            let gather = |values: &[f64]| {
                Vector6::from_fn(|k, _| if rows[k] == LOCKED { 0.0 } else { values[rows[k] as usize] })
            };
            let start = gather(&work.unit.rate);
            let after = element.mass() * (gather(&work.rate_after) - start);
            let mean = gather(&work.jump.increments) + gather(&work.glide.increments);
            let turning = coadjoint_times(&mean, &(element.mass() * mean));
            let end = element.mass() * (gather(&work.rate_end) - start) - turning;
            for (k, &row) in rows.iter().enumerate().filter(|&(_, &row)| row != LOCKED) {
                work.residual[row as usize] += inertia * after[k];
                work.residual[count + row as usize] += inertia * end[k];
            }
        }
        self.add_constraints();
    }

    fn add_constraints(&mut self) {
        let work = &mut *self.work;
        let layout = &work.layout;
        let count = layout.coordinates;
        let (scale, penalty) = (self.scaled.scale(), self.scaled.augmented_factor());
        let factor = self.scaled.dynamic_factor();
        for (index, joint) in self.system.joints().iter().enumerate() {
            let unknowns = 12 + joint.coordinates.len();
            let rows = &layout.joints[index].rows[..unknowns];
            let [glide, jump] = &work.mean_rows[index];
            for k in 0..joint.equations() {
                let multiplier = joint.first_multiplier + k;
                let violation = work.violations_end[multiplier];
                let mu = factor * work.multipliers[multiplier] + penalty * violation;
                work.residual[2 * count + multiplier] = scale * violation;
                for (i, &row) in rows.iter().enumerate().filter(|&(_, &row)| row != LOCKED) {
                    work.residual[count + row as usize] += glide[(k, i)] * mu;
                    work.residual[row as usize] -= (glide[(k, i)] - jump[(k, i)]) * mu / 3.0;
                }
            }
            for (c, &coordinate) in joint.coordinates.iter().enumerate() {
                let definer = work.definers[index].column(c);
                let first = joint.first_multiplier;
                let violation: f64 =
                    (0..joint.equations()).map(|k| definer[k] * work.violations_after[first + k]).sum();
                work.residual[layout.definition(coordinate)] = scale * violation;
                let mu = scale * work.definitions[coordinate] + penalty * violation;
                let along = jump.tr_mul(&definer);
                for (i, &row) in rows.iter().enumerate().filter(|&(_, &row)| row != LOCKED) {
                    work.residual[row as usize] += along[i] * mu;
                }
            }
        }
        for drive in self.system.drives() {
            let row = self.system.layout().row_of_coordinate(drive.prescribed.coordinate);
            let violation = work.violations_end[drive.multiplier];
            work.residual[2 * count + drive.multiplier] = scale * violation;
            work.residual[count + row] += factor * work.multipliers[drive.multiplier] + penalty * violation;
        }
    }

    fn add_corrections(&mut self) -> Correction {
        let work = &mut *self.work;
        let count = work.layout.coordinates;
        let (mut size, mut reference) = (0.0_f64, 0.0_f64);
        for row in 0..count {
            // The linear system's unknowns are the jump and the whole step.
            work.residual[count + row] -= work.residual[row];
            let correction = work.sizes[row] * (work.residual[row].abs() + work.residual[count + row].abs());
            if !correction.is_finite() {
                return Correction { size: f64::NAN, reference };
            }
            size = size.max(correction);
            let departure = work.jump.increments[row] + work.glide.increments[row] - work.unit.rate[row];
            reference = reference.max(work.sizes[row] * departure.abs());
        }
        let cut = if size > LARGEST_ROTATION { LARGEST_ROTATION / size } else { 1.0 };
        work.correction = size;
        for value in &mut work.residual {
            *value *= -cut;
        }
        let correction = std::mem::take(&mut work.residual);
        self.apply(&correction, 1.0);
        self.work.residual = correction;
        Correction { size, reference }
    }

    /// Adds a correction times `share`.
    fn apply(&mut self, correction: &[f64], share: f64) {
        let work = &mut *self.work;
        let count = work.layout.coordinates;
        for row in 0..count {
            work.jump.increments[row] += share * correction[row];
            work.glide.increments[row] += share * correction[count + row];
        }
        let factor = share * self.scaled.multiplier_factor();
        for (k, value) in work.multipliers.iter_mut().enumerate() {
            *value += factor * correction[2 * count + k];
        }
        for (coordinate, value) in work.definitions.iter_mut().enumerate() {
            *value += share * correction[work.layout.definition(coordinate)];
        }
    }

    /// Name of the unknown with the largest entry in the last corrections.
    pub(crate) fn worst_unknown(&self) -> String {
        let count = self.work.layout.coordinates;
        let size = |row: usize| {
            let value = self.work.residual[row].abs();
            if value.is_finite() { self.work.sizes[row % count] * value } else { f64::INFINITY }
        };
        let worst = (0..2 * count).max_by(|&a, &b| size(a).total_cmp(&size(b))).unwrap_or(0);
        self.system.layout().name_of(worst % count)
    }
}

impl Approachable for DecayingEquations<'_> {
    fn set_share(&mut self, share: f64) {
        self.scaled = (self.rescale)(share);
        self.scaled.enter(self.system.layout(), self.start, &mut self.work.unit);
    }

    fn save(&mut self) {
        let work = &mut *self.work;
        work.saved = [work.jump.increments.clone(), work.glide.increments.clone()];
    }

    fn extrapolate(&mut self, factor: f64) {
        let work = &mut *self.work;
        let [jump, glide] = &work.saved;
        for (value, saved) in work.jump.increments.iter_mut().zip(jump) {
            *value = factor * factor * saved;
        }
        for (value, saved) in work.glide.increments.iter_mut().zip(glide) {
            *value = factor * saved;
        }
        work.correction = f64::INFINITY;
        self.update();
    }
}

fn interval<'a>(
    part: &'a Part,
    from: &'a Kinematics,
    to: &'a Kinematics,
    dissipation: f64,
    duration: f64,
) -> Interval<'a> {
    Interval {
        from,
        to,
        increments: &part.nodes,
        coordinate_increments: &part.coordinates,
        dissipation,
        duration,
    }
}

impl Equations for DecayingEquations<'_> {
    fn correct(&mut self) -> Correction {
        if !std::mem::take(&mut self.work.backed_off) {
            std::mem::swap(&mut self.work.residual, &mut self.work.before);
        }
        self.evaluate();
        let work = &mut *self.work;
        work.solver.solve(&mut work.residual);
        let correction = self.add_corrections();
        self.update();
        correction
    }

    fn renew_tangent(&mut self) -> Result<(), FactorError> {
        self.assemble_tangent();
        let work = &mut *self.work;
        let report = work.solver.factor(&work.values).map_err(|error| match error {
            FactorError::ZeroPivot { unknown, pivot, largest } => {
                FactorError::ZeroPivot { unknown: work.layout.single(unknown, self.system), pivot, largest }
            }
            FactorError::NotFinite { unknown } => {
                FactorError::NotFinite { unknown: work.layout.single(unknown, self.system) }
            }
        })?;
        work.report = Some(report);
        Ok(())
    }

    fn restart(&mut self) {
        self.predict();
    }

    fn back_off(&mut self) {
        let last = std::mem::take(&mut self.work.residual);
        let mut before = std::mem::take(&mut self.work.before);
        // A correction that is not finite was not applied.
        if last.iter().all(|value| value.is_finite()) {
            self.apply(&last, -1.0);
        }
        self.apply(&before, -0.5);
        for value in &mut before {
            *value *= 0.5;
        }
        self.work.residual = last;
        self.work.before = before;
        self.work.backed_off = true;
        self.update();
    }
}
