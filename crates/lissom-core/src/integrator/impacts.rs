//! Velocities after the impacts of a step, see `contacts::impact`.

use lissom_motion::Vector3;

use super::contacts::impact::{Impacts, of_node};
use super::contacts::{FOLLOWING, StepContacts, TouchPoint, TouchState, share_of_correction};
use super::equations::StepEquations;
use crate::consistent::initial_conditions::gather_rates;
use crate::impacts::Rebounds;
use crate::joints::evaluation_point::Augmentation;
use crate::kinematics::{Kinematics, LOCKED, Layout, Quantity, split};
use crate::newton::Failure;
use crate::system::TangentAssembler;

/// Largest number of times in which offsets and bounds of friction are corrected.
const MAX_OFFSETS: usize = 3;
/// Largest number of shares of the rebounds.
const MAX_SHARES: usize = 7;
/// Energy left of what the step has lost, over the kinetic energy, with which a share is large enough.
const UNUSED: f64 = 1e-3;
/// Change of energy over the kinetic energy that is round-off.
const GAIN: f64 = 1e-10;
/// Residual over the momentum of the approach at which an iteration has converged.
const TOLERANCE: f64 = 1e-8;
/// Largest number of corrections.
const MAX_CORRECTIONS: usize = 60;

impl StepEquations<'_> {
    /// Finds the impacts of the step that was solved, and the velocities after them.
    pub(crate) fn resolve_impacts(&mut self) -> Result<(), Failure> {
        let Some(mut contacts) = self.work.contacts.take() else { return Ok(()) };
        contacts.impacts.clear();
        let (layout, size) = (self.system.layout(), self.scaled.step_size());
        let motions = (&self.start.kinematics, &self.work.motions[0].at);
        let result = if contacts.find_impacts(layout, motions, size) {
            self.solve_impacts(&mut contacts)
        } else {
            Ok(())
        };
        self.work.contacts = Some(contacts);
        result
    }

    fn solve_impacts(&mut self, contacts: &mut StepContacts) -> Result<(), Failure> {
        self.linearize_end(&mut contacts.impacts);
        let kinetic = self.system.energy(&self.work.motions[0].at).kinetic;
        let lost = self.lost(contacts);
        self.find_departures(contacts)?;
        let tolerances = [GAIN * kinetic, UNUSED * kinetic];
        let mut rebounds = Rebounds::new(lost, tolerances, MAX_SHARES);
        while let Some(share) = rebounds.next_share() {
            contacts.impacts.begin(share);
            for round in 0..=MAX_OFFSETS {
                self.converge(contacts, round == 0)?;
                // Both at once: in a pile each change opens and closes touches, and costs ten corrections.
                let impacts = &mut contacts.impacts;
                if !(impacts.correct_offsets(share) | impacts.fix_bounds()) {
                    break;
                }
            }
            if rebounds.record(self.returned(&mut contacts.impacts)) {
                let impacts = &mut contacts.impacts;
                std::mem::swap(&mut impacts.best, &mut impacts.change);
                impacts.best_states.clone_from(&impacts.states);
            }
        }
        let impacts = &mut contacts.impacts;
        if let Some(share) = rebounds.found() {
            std::mem::swap(&mut impacts.best, &mut impacts.change);
            std::mem::swap(&mut impacts.best_states, &mut impacts.states);
            for own in &mut impacts.participants {
                own.departure *= share;
            }
        } else {
            // The step stops what meets.
            impacts.clear();
        }
        self.note_scales();
        Ok(())
    }

    /// Sets the operators at the end of the step.
    fn linearize_end(&mut self, impacts: &mut Impacts) {
        let (system, at) = (self.system, &self.work.motions[0].at);
        let layout = system.layout();
        let pattern = &system.structure().pattern;
        let Impacts { linearization: all, operator, smooth, .. } = impacts;
        system.linearize_at(at, Augmentation::of_lengths(self.scaled.unit(Quantity::Angle)), all);
        operator.clear();
        operator.extend_from_slice(&all.mass);
        // States have no inertia.
        for (row, ..) in layout.states() {
            if let Some(diagonal) = pattern.position(row, row) {
                operator[diagonal] += 1.0;
            }
        }
        if system.has_stiff_elements() {
            all.damping.fill(0.0);
            all.stiffness.fill(0.0);
            let mass = std::mem::take(&mut all.mass);
            all.mass = vec![0.0; mass.len()];
            let mut scratch = all.scratch.take().unwrap_or_default();
            system.linearize_elements(true, at, &mut scratch, &mut TangentAssembler::Separate(all));
            all.scratch = Some(scratch);
            all.mass = mass;
            let size = self.scaled.step_size();
            for ((value, damping), stiffness) in operator.iter_mut().zip(&all.damping).zip(&all.stiffness) {
                *value += size * (damping + size * stiffness);
            }
        }
        smooth.clear();
        let scale = self.scaled.scale();
        let constraints = all.gram.iter().zip(&all.constraint);
        smooth.extend(
            operator
                .iter()
                .zip(constraints)
                .map(|(own, (gram, constraint))| own + scale * (gram + constraint)),
        );
        operator.iter_mut().zip(&all.constraint).for_each(|(own, constraint)| *own += constraint);
    }

    /// Velocities without the touches of the impacts, and from them the departures.
    fn find_departures(&mut self, contacts: &mut StepContacts) -> Result<(), Failure> {
        let layout = self.system.layout();
        let impacts = &mut contacts.impacts;
        impacts.change.fill(0.0);
        impacts.right.fill(0.0);
        let at = &self.work.motions[0].at;
        for (own, point) in impacts.participants.iter().zip(&impacts.points) {
            point.add_wrenches(&own.known, (at, layout), &mut impacts.right);
        }
        impacts.states.clear();
        impacts.states.resize(impacts.points.len(), TouchState::default());
        self.solve_velocities(contacts)?;
        let (at, impacts) = (&self.work.motions[0].at, &mut contacts.impacts);
        let right = &impacts.right;
        for (own, point) in impacts.participants.iter_mut().zip(&impacts.points) {
            let Some(restitution) = point.restitution().filter(|_| own.is_impact) else { continue };
            // The solution is subtracted.
            let free = own.before.z - point.change(at, |node| of_node(layout, node, right)).z;
            let arrival = point.approach;
            let squared = arrival * arrival - 2.0 * (arrival + free) * own.path;
            own.departure = restitution * squared.max(0.0).sqrt();
        }
        Ok(())
    }

    /// Newton's method for the velocities with the present offsets, and with the present bounds or ones that follow at first.
    fn converge(&mut self, contacts: &mut StepContacts, follows: bool) -> Result<(), Failure> {
        let system = self.system;
        let (layout, pattern) = (system.layout(), &*system.structure().pattern);
        let mut corrections = 0;
        loop {
            let (at, impacts) = (&self.work.motions[0].at, &mut contacts.impacts);
            impacts.evaluate(layout, at, follows && corrections <= FOLLOWING);
            impacts.residual((pattern, layout), at);
            let unbalance = impacts.unbalance(pattern, layout);
            if !unbalance.is_finite() {
                return Err(Failure::NotFinite { iterations: corrections });
            }
            if unbalance <= TOLERANCE {
                return Ok(());
            }
            if corrections >= MAX_CORRECTIONS {
                return Err(Failure::NotConverged { iterations: corrections, correction: unbalance });
            }
            corrections += 1;
            contacts.impacts.product.clone_from(&contacts.impacts.right);
            self.solve_velocities(contacts)?;
            let (at, impacts) = (&self.work.motions[0].at, &mut contacts.impacts);
            let count = layout.coordinate_count();
            let slope = -dot(&impacts.right, &impacts.product[..count]);
            let Impacts { participants, points, states, changes, change, right, .. } = impacts;
            changes.clear();
            changes.extend(points.iter().map(|point| -point.change(at, |node| of_node(layout, node, right))));
            let force = |k: usize, velocity: Vector3| {
                participants[k].clone().evaluate(&points[k], velocity, false).force
            };
            let slopes = states.iter().map(|state| &state.slope);
            let share = share_of_correction(slope, (states, slopes, changes), force);
            for (value, correction) in change.iter_mut().zip(&*right) {
                *value -= share * correction;
            }
        }
    }

    /// Solves for a correction of the velocities and the multipliers, in place of the right-hand side, with the slopes of the states.
    fn solve_velocities(&mut self, contacts: &mut StepContacts) -> Result<(), Failure> {
        let layout = self.system.layout();
        let StepContacts { impacts, pattern, near, .. } = &mut *contacts;
        if pattern.follow((layout, false), &near.points, (&impacts.points, &impacts.states)) {
            self.take_pattern(contacts);
        }
        let StepContacts { impacts, pattern, .. } = contacts;
        let touches = (&impacts.points[..], &impacts.states[..], 1.0);
        self.factor_with(pattern, &impacts.smooth, touches).map_err(Failure::Factor)?;
        let scale = self.scaled.scale();
        let right = &mut self.work.residuals[0];
        right.copy_from_slice(&impacts.right);
        let count = layout.coordinate_count();
        right[count..].iter_mut().for_each(|value| *value *= scale);
        self.work.tangent.scale(right);
        self.work.tangent.matrices.solve(&self.scheme.coupling, &mut self.work.residuals);
        let solution = &mut self.work.residuals[0];
        self.work.tangent.scale(solution);
        solution[count..].iter_mut().for_each(|value| *value *= scale);
        impacts.right.copy_from_slice(solution);
        Ok(())
    }

    /// Energy that the step has lost [J]: ½ (v_A - v)ᵀ M (v_A - v), and what its touches have dissipated.
    fn lost(&self, contacts: &mut StepContacts) -> f64 {
        let layout = self.system.layout();
        let pattern = &self.system.structure().pattern;
        let (start, at) = (&self.start.kinematics, &self.work.motions[0].at);
        let StepContacts { near, states, impacts, .. } = contacts;
        let Impacts { linearization, right, product, .. } = impacts;
        velocities(layout, at, right);
        for ((rows, before), after) in layout.node_rows.iter().zip(&start.nodes).zip(&at.nodes) {
            let turned =
                |vector: Vector3| after.frame.rotation.apply_inverse(&before.frame.rotation.apply(&vector));
            let (velocity, spin) = split(&before.twist);
            let (velocity, spin) = (turned(velocity), turned(spin));
            for (k, &row) in rows.iter().enumerate().filter(|(_, row)| **row != LOCKED) {
                right[row as usize] -= if k < 3 { velocity[k] } else { spin[k - 3] };
            }
        }
        for (&row, before) in layout.coordinate_rows.iter().zip(&start.coordinates) {
            right[row as usize] -= before.rate;
        }
        pattern.multiply(&linearization.mass, right, product);
        let stored = self.start.touch_energy().strain;
        let dissipated = |(point, state): (&TouchPoint, &TouchState)| {
            -state.force.dot(&state.displacement) - point.energy(state)
        };
        0.5 * dot(right, product) + stored + near.points.iter().zip(&*states).map(dissipated).sum::<f64>()
    }

    /// Kinetic energy that the impacts return [J].
    fn returned(&self, impacts: &mut Impacts) -> f64 {
        let pattern = &self.system.structure().pattern;
        let Impacts { linearization, right, product, change, .. } = impacts;
        velocities(self.system.layout(), &self.work.motions[0].at, right);
        for (velocity, change) in right.iter_mut().zip(&*change) {
            *velocity += 0.5 * change;
        }
        pattern.multiply(&linearization.mass, right, product);
        dot(&change[..self.system.layout().coordinate_count()], product)
    }
}

fn dot(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(a, b)| a * b).sum()
}

/// Velocities by row; zeros for states and multipliers.
fn velocities(layout: &Layout, at: &Kinematics, out: &mut [f64]) {
    out.fill(0.0);
    gather_rates(layout, at, out);
    for (row, ..) in layout.states() {
        out[row] = 0.0;
    }
}
