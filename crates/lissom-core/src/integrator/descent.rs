//! The corrections of a step with touches, see `contacts`.

use lissom_motion::Vector6;
use lissom_solver::{FactorError, KINDS, SYMMETRIC};

use super::contacts::{CoupledPattern, StepContacts, TouchPoint, TouchState, share_of_correction};
use super::equations::StepEquations;
use crate::kinematics::{LOCKED, NodeId, Quantity};
use crate::newton::Descent;
use crate::round_off;
use crate::saddle_point::TangentValues;
use crate::saddle_point::stage_tangents::StageTangents;
use crate::settings::{Phase, Settings};

/// Tolerance of the residual over that of other schemes: the errors of all parts add to the energy.
const SHARE_OF_TOLERANCE: f64 = 0.1;

impl Descent for StepEquations<'_> {
    fn residual(&mut self) -> f64 {
        self.watch.begin(Phase::Evaluation);
        self.evaluate();
        let Some(mut contacts) = self.work.contacts.take() else { return 0.0 };
        let layout = self.system.layout();
        let motion = &self.work.motions[0];
        contacts.add_forces(&self.start.kinematics, motion, layout, &mut self.work.residuals[0]);
        self.watch.begin(Phase::Rest);
        self.omit_redundant();
        contacts.residual.copy_from_slice(&self.work.residuals[0]);
        if contacts.smooth.diagonal.is_empty() {
            // In the norm of an earlier step, whose constraints or size were others, any residual might be small.
            self.watch.begin(Phase::Linearisation);
            self.linearize_without_touches(&mut contacts);
            self.watch.begin(Phase::Rest);
        }
        let size = self.unbalance(&contacts);
        contacts.unbalance = [contacts.unbalance[1], size];
        self.work.contacts = Some(contacts);
        size
    }

    fn descend(&mut self) -> Result<bool, FactorError> {
        let Some(mut contacts) = self.work.contacts.take() else { return Ok(false) };
        let result = self.correct_with(&mut contacts);
        self.work.contacts = Some(contacts);
        result
    }

    fn settle(&mut self) -> bool {
        let Some(mut contacts) = self.work.contacts.take() else { return true };
        let (motion, start) = (&self.work.motions[0], self.start);
        let is_settled = contacts.is_settled((start, motion), self.scaled.step_size());
        self.work.contacts = Some(contacts);
        is_settled
    }
}

impl StepEquations<'_> {
    /// Finds the points at which parts may touch in the step. Whether there are parts that may.
    pub(super) fn begin_contacts(&mut self, settings: &Settings) -> bool {
        let Some(contacts) = &mut self.work.contacts else { return false };
        contacts.tolerance = SHARE_OF_TOLERANCE * settings.limits.tolerance;
        let sizes = [self.scaled.step_size(), settings.step_size];
        contacts.begin(self.system, (self.start, false), sizes);
        true
    }

    /// Norm of the residual over that of the motion, in the norm of the tangent's diagonal, and over the tolerance.
    fn unbalance(&self, contacts: &StepContacts) -> f64 {
        let layout = self.system.layout();
        let count = layout.coordinate_count();
        let h = self.scaled.step_size();
        let fall = h * h * self.system.gravity().norm();
        let (mut unbalance, mut motion) = (0.0, 0.0);
        for (row, diagonal) in
            contacts.smooth.diagonal.iter().enumerate().filter(|(_, diagonal)| **diagonal > 0.0)
        {
            unbalance += contacts.residual[row].powi(2) / diagonal;
            let path = self.work.unit.velocity[row] + self.work.increments[0][row];
            let fall = if layout.quantities()[row] == Quantity::Length { fall } else { 0.0 };
            motion += diagonal * (path * path + fall * fall);
        }
        let length = self.work.units.length;
        // At rest and without weight only round-off of positions remains.
        let floor = (round_off::POSITION * length).powi(2) * contacts.smooth.diagonal[0].abs();
        let violations = layout.relative_violations(&contacts.residual[count..], length);
        let violation = violations.fold(0.0, f64::max);
        ((unbalance / (motion + floor)).sqrt() / contacts.tolerance).max(violation / round_off::ITERATION)
    }

    fn correct_with(&mut self, contacts: &mut StepContacts) -> Result<bool, FactorError> {
        self.work.newton.effort.iterations += 1;
        self.work.newton.correction = 0.0;
        let is_slow = contacts.count_correction();
        let is_new = !contacts.keeps_tangent();
        if is_new {
            self.factor(contacts, is_slow)?;
        }
        self.solve_for_corrections();
        // Larger corrections of rotations are cut to a radian, as with other schemes.
        let most = self.measure_places().size.max(1.0).recip();
        let share = self.share_of_correction(contacts).min(most);
        let corrections = std::mem::take(&mut self.work.residuals);
        self.apply(&corrections, -share);
        self.work.residuals = corrections;
        self.update_motions();
        Ok(is_new)
    }

    /// Factors the tangent at the iterate, with that of elements and joints if it is to be renewed.
    fn factor(&mut self, contacts: &mut StepContacts, is_renewed: bool) -> Result<(), FactorError> {
        let layout = self.system.layout();
        if is_renewed {
            self.watch.begin(Phase::Linearisation);
            self.linearize_without_touches(contacts);
        }
        let is_first = contacts.corrections == 1;
        let points = &contacts.near.points;
        if contacts.pattern.follow((layout, is_first), points, (points, &contacts.states)) {
            self.take_pattern(contacts);
        }
        let TangentValues::Real(smooth) = &contacts.smooth.values else {
            unreachable!("the scheme has one stage")
        };
        let touches = (&contacts.near.points[..], &contacts.states[..], self.scaled.dynamic_factor());
        self.watch.begin(Phase::Factorisation);
        self.factor_with(&contacts.pattern, smooth, touches)?;
        self.note_scales();
        contacts.slopes.clear();
        contacts.slopes.extend(contacts.states.iter().map(|state| state.slope));
        Ok(())
    }

    /// Factors the tangent with these values on the system's own pattern, and a factor times the blocks of touches.
    pub(super) fn factor_with(
        &mut self,
        pattern: &CoupledPattern,
        smooth: &[f64],
        touches: (&[TouchPoint], &[TouchState], f64),
    ) -> Result<(), FactorError> {
        self.work.newton.effort.factorizations += 1;
        let TangentValues::Real(mut values) = self.work.tangent.matrices.take_values(0) else {
            unreachable!("the scheme has one stage")
        };
        let at = (&self.work.motions[0].at, self.system.layout());
        pattern.assemble(smooth, touches, at, &mut values);
        self.work.tangent.matrices.set_values(0, TangentValues::Real(values));
        self.work.tangent.renew(&pattern.structure, self.scaled.scale(), &mut |_| true)?;
        Ok(())
    }

    fn linearize_without_touches(&mut self, contacts: &mut StepContacts) {
        let scaled = self.scaled;
        let [system] = &self.scheme.coupling.systems[..] else { unreachable!("the scheme has one stage") };
        let mut smooth = std::mem::replace(&mut contacts.smooth.values, TangentValues::Real(Vec::new()));
        self.assemble_tangent(&mut smooth.receiver(&scaled, system, &mut []));
        if let TangentValues::Real(values) = &smooth {
            let pattern = &self.system.structure().pattern;
            let rows = 0..self.system.layout().coordinate_count();
            let of = |row| pattern.position(row, row).map_or(0.0, |position| values[position]);
            contacts.smooth.diagonal.clear();
            contacts.smooth.diagonal.extend(rows.map(|row| of(row) / scaled.dynamic_factor()));
        }
        contacts.smooth.values = smooth;
    }

    /// Continues with a solver for the pattern of the touches.
    pub(super) fn take_pattern(&mut self, contacts: &StepContacts) {
        // Without controls only gyroscopic terms and those of rotations in the step make it unsymmetric.
        let is_symmetric = contacts.solver.name == KINDS[0].name && !self.system.has_feedback();
        let solver = if is_symmetric { &SYMMETRIC } else { contacts.solver };
        let structure = &contacts.pattern.structure;
        self.work.tangent.matrices = StageTangents::new(solver, structure, &self.scheme.coupling);
    }

    /// The part of the correction, as solved, that leads to the least value along it.
    fn share_of_correction(&self, contacts: &mut StepContacts) -> f64 {
        let layout = self.system.layout();
        let (places, multipliers) = self.work.residuals[0].split_at(layout.coordinate_count());
        let (forces, violations) = contacts.residual.split_at(layout.coordinate_count());
        let dot = |one: &[f64], other: &[f64]| one.iter().zip(other).map(|(a, b)| a * b).sum::<f64>();
        // The correction is subtracted.
        let slope = self.scaled.multiplier_factor() * dot(multipliers, violations) - dot(places, forces);
        let at = &self.work.motions[0].at;
        let increment = |node: NodeId| {
            let rows = layout.rows_of_node(node);
            Vector6::from_fn(|k, _| if rows[k] == LOCKED { 0.0 } else { -places[rows[k] as usize] })
        };
        contacts.changes.clear();
        contacts.changes.extend(contacts.near.points.iter().map(|point| point.change(at, increment)));
        let force = |k: usize, displacement| contacts.near.points[k].force(&displacement);
        let touches = (&contacts.states[..], contacts.slopes.iter(), &contacts.changes[..]);
        share_of_correction(slope, touches, force)
    }
}
