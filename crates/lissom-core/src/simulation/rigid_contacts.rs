//! Constraints that switch between two steps: impacts of latches and at rigid contacts, and the modes of all rigid contacts.
//!
//! All contacts that touch take part in an impact at once, see [`impacts`](crate::impacts). Without restitution the impulses dissipate, with
//! the velocities of a contact u before (-) and after (+) it: ΔT = P·(u⁺ + u⁻)/2 = P·u⁺ - P·G P/2 with P·u⁺ ≤ 0.
//!
//! Between impacts its conditions relate forces and accelerations of the contacts that touch and do not separate. They
//! determine which contacts open, slide and stick. Forces of redundant contacts have minimum norm, as have reactions of redundant
//! joints. A contact that pulls opens. A contact whose friction is beyond its cone is saturated, and the others keep the part at
//! rest.

use nalgebra::{DMatrix, DVector, Matrix3, Vector2, Vector3};

use super::Simulation;
use super::held_values::settle;
use crate::consistent::initial_conditions::{ConsistentInitialConditions, Inertias, add_rates};
use crate::contact::point::PointMotion;
use crate::contact::rigid::{Mode, RigidContact};
use crate::errors::{InitialError, StepError, Warning, warn};
use crate::impacts::dense::{Condition, ContactProblem};
use crate::impacts::{Rebounds, tangents};
use crate::integrator::dense::at_share;
use crate::kinematics::{Kinematics, LOCKED, Subject};
use crate::system::{State, System};

/// Gaps below this fraction of the representative length are closed.
const CLOSED: f64 = 1e-8;
/// If other contacts keep a contact from closing, changes of its gap below this fraction of the length are round-off.
const BAND: f64 = 1e-9;
/// Gaps below this fraction of the length are closed at the start, where positions are given.
const CLOSED_AT_START: f64 = 1e-6;
/// Forces and accelerations below this fraction of the largest are zero.
const ZERO: f64 = 1e-8;
/// Fraction below which forces of redundant contacts, which are known to fewer digits, are zero.
const ZERO_SHARE: f64 = 1e-7;
/// Eigenvalue of normal equations that repeat each other.
const DEPENDENT: f64 = 1e-10;
/// Smallest coefficient in a dependence.
const PARTICIPATES: f64 = 1e-6;
/// Energy beyond this fraction of that before is not round-off.
const GAIN: f64 = 1e-12;
/// Largest number of shares of the rebounds.
const MAX_SHARES: usize = 50;

/// A contact that touches.
struct Candidate<'s> {
    contact: &'s RigidContact,
    touching: PointMotion,
    /// Normal and two tangents.
    axes: Matrix3<f64>,
    /// Velocities along them [m/s].
    velocity: Vector3<f64>,
    /// Rows of these velocities.
    rows: Vec<DVector<f64>>,
}

impl<'s> Candidate<'s> {
    fn new(system: &System, contact: &'s RigidContact, at: &Kinematics) -> Self {
        let touching = contact.touching(at);
        let [first, second] = tangents(&touching.gap.normal);
        let axes = Matrix3::from_columns(&[touching.gap.normal, first, second]);
        let layout = system.layout();
        let local = contact.rows(&touching, &axes);
        let rows = (0..3)
            .map(|k| {
                let mut row = DVector::zeros(layout.size());
                for (j, &node) in contact.nodes().iter().enumerate() {
                    for (i, &unknown) in layout.rows_of_node(node).iter().enumerate() {
                        if unknown != LOCKED {
                            row[unknown as usize] += local[(k, 6 * j + i)];
                        }
                    }
                }
                row
            })
            .collect();
        let velocity = axes.tr_mul(&touching.velocity);
        Self { contact, touching, axes, velocity, rows }
    }

    fn sliding(&self) -> Vector2<f64> {
        Vector2::new(self.velocity[1], self.velocity[2])
    }

    /// A tangential direction in the axes of the base.
    fn in_base(&self, tangential: &Vector2<f64>) -> Vector3<f64> {
        self.axes.column(1) * tangential[0] + self.axes.column(2) * tangential[1]
    }

    fn subject(&self) -> Subject {
        Subject::new("contact", &self.contact.name)
    }
}

fn set_mode(contact: &RigidContact, mode: Mode, at: &mut Kinematics) {
    at.held[contact.held.mode.index()] = mode.number();
}

fn set_direction(contact: &RigidContact, direction: &Vector3<f64>, at: &mut Kinematics) {
    for (held, value) in contact.held.direction.iter().zip(direction.iter()) {
        at.held[held.index()] = *value;
    }
}

/// Opens all contacts.
fn open_all(system: &System, at: &mut Kinematics) {
    system.rigid_contacts().for_each(|contact| set_mode(contact, Mode::Open, at));
}

/// Change of velocities with the multipliers of joints, for unit impulses at the contacts, by column.
fn responses(
    system: &System,
    initial: &mut ConsistentInitialConditions,
    candidates: &[Candidate<'_>],
) -> Vec<DVector<f64>> {
    let rows = candidates.iter().flat_map(|candidate| &candidate.rows);
    rows.map(|row| {
        let mut response = row.clone();
        initial.solve(system, response.as_mut_slice());
        response
    })
    .collect()
}

fn compliance(candidates: &[Candidate<'_>], responses: &[DVector<f64>]) -> DMatrix<f64> {
    let rows: Vec<_> = candidates.iter().flat_map(|candidate| &candidate.rows).collect();
    let mut found = DMatrix::from_fn(rows.len(), rows.len(), |i, j| rows[i].dot(&responses[j]));
    let transposed = found.transpose();
    found += transposed;
    found * 0.5
}

/// What changed at an instant.
#[derive(Default)]
pub(super) struct Outcome {
    /// Energy that an impact has dissipated [J].
    lost: Option<f64>,
    /// Whether no part approached faster than its velocity of rest: a part that rocks is stopped.
    is_slow: bool,
    warnings: Vec<Warning>,
}

/// Solves impacts at `state`, and determines the modes of all contacts. `touched` are known to touch; gaps up to
/// `near` [m] are closed, and those of contacts that others keep from closing may change by `band` [m].
pub(super) fn resolve(
    system: &System,
    initial: &mut ConsistentInitialConditions,
    state: &mut State,
    (touched, [near, band]): (&[usize], [f64; 2]),
) -> Result<Outcome, InitialError> {
    let mut outcome = Outcome::default();
    let mut free = state.clone();
    open_all(system, &mut free.kinematics);
    let at = &state.kinematics;
    let is_candidate = |index: usize, contact: &RigidContact| {
        contact.mode(at) != Mode::Open || touched.contains(&index) || contact.touching(at).gap.value <= near
    };
    let all = system.rigid_contacts().enumerate().filter(|&(index, contact)| is_candidate(index, contact));
    let mut candidates: Vec<_> = all.map(|(_, contact)| Candidate::new(system, contact, at)).collect();
    if candidates.is_empty() {
        return Ok(outcome);
    }
    initial.factor(system, &free, Inertias::All)?;
    let responses = responses(system, initial, &candidates);
    let compliance = compliance(&candidates, &responses);
    if candidates.iter().any(|candidate| candidate.velocity[0] < -candidate.contact.still()) {
        outcome.is_slow = candidates.iter().all(|own| own.velocity[0] >= -own.contact.law.rest_velocity);
        impact(system, (&candidates, &responses, &compliance), state, &mut outcome)?;
        for candidate in &mut candidates {
            *candidate = Candidate::new(system, candidate.contact, &state.kinematics);
        }
        let held = std::mem::take(&mut free.kinematics.held);
        free.kinematics.clone_from(&state.kinematics);
        free.kinematics.held = held;
    }
    let accelerations = initial.acceleration_with_factors(system, &free)?;
    let is_resting = |candidate: &Candidate<'_>| {
        let contact = candidate.contact;
        let fastest = if outcome.is_slow { contact.law.rest_velocity } else { contact.still() };
        candidate.velocity[0] <= fastest
    };
    let resting: Vec<usize> = (0..candidates.len()).filter(|&k| is_resting(&candidates[k])).collect();
    // Modes with the unique forces of the contacts that remain.
    let (mut carrying, mut kept) = (resting.clone(), Vec::new());
    let modes = loop {
        let forces = (&compliance, &accelerations[..]);
        let (modes, omitted) = select(&candidates, &carrying, forces, &state.kinematics)?;
        if omitted.is_empty() {
            break modes;
        }
        carrying.retain(|k| !omitted.contains(k));
        kept.extend(omitted);
    };
    for candidate in &candidates {
        let gap = candidate.touching.gap.value;
        state.kinematics.held[candidate.contact.held.offset.index()] = gap.min(0.0);
        set_mode(candidate.contact, Mode::Open, &mut state.kinematics);
    }
    if let Some(&k) = kept.iter().find(|&&k| sliding_directions_differ(&candidates, &resting, k)) {
        let (time, contact) = (state.kinematics.time, candidates[k].subject());
        outcome.warnings.push(Warning::SlidingForcesNotUnique { time, contact });
    }
    for k in kept {
        // Its gap changes by round-off.
        set_mode(candidates[k].contact, Mode::Kept, &mut state.kinematics);
        state.kinematics.held[candidates[k].contact.held.offset.index()] -= band;
    }
    // Where sliding begins, it begins from rest: what remains of an earlier velocity has another direction.
    let begins = |k: usize| {
        candidates[k].contact.has_friction()
            && candidates[k].sliding().norm() <= candidates[k].contact.still()
    };
    for &(k, mode, _) in &modes {
        let stops = mode == Mode::Sliding && begins(k);
        set_mode(candidates[k].contact, if stops { Mode::Sticking } else { mode }, &mut state.kinematics);
    }
    if modes.iter().any(|&(k, mode, _)| mode == Mode::Sliding && begins(k)) {
        initial.velocities(system, state)?;
    }
    for (k, mode, direction) in modes {
        set_mode(candidates[k].contact, mode, &mut state.kinematics);
        set_direction(candidates[k].contact, &direction, &mut state.kinematics);
    }
    share(system, initial, (&candidates, &resting, band), state)?;
    Ok(outcome)
}

/// Velocities after the impact of latches that engage. Contacts do not take part: their own impact, which obeys the latches, follows.
pub(super) fn impact_of_latches(
    system: &System,
    initial: &mut ConsistentInitialConditions,
    state: &mut State,
) -> Result<(), InitialError> {
    let held = state.kinematics.held.clone();
    open_all(system, &mut state.kinematics);
    let found = initial.velocities(system, state);
    state.kinematics.held = held;
    found.map(|_| ())
}

/// Solves an impact at all contacts.
fn impact(
    system: &System,
    (candidates, responses, compliance): (&[Candidate<'_>], &[DVector<f64>], &DMatrix<f64>),
    state: &mut State,
    outcome: &mut Outcome,
) -> Result<(), InitialError> {
    let before = DVector::from_iterator(
        3 * candidates.len(),
        candidates.iter().flat_map(|own| own.velocity.iter().copied()),
    );
    let kinetic = system.energy(&state.kinematics).kinetic;
    let solve = |share: f64| {
        let condition = |candidate: &Candidate<'_>| {
            let law = &candidate.contact.law;
            let approach = candidate.velocity[0];
            // That of points at rest, zero up to round-off, is consistent with that of the others.
            let rebounds = !outcome.is_slow && approach <= candidate.contact.still();
            let rebound = if rebounds { share * law.restitution * approach } else { 0.0 };
            Condition { friction: law.friction, rebound, sliding: None }
        };
        let conditions = candidates.iter().map(condition).collect();
        let problem = ContactProblem { compliance: compliance.clone(), free: before.clone(), conditions };
        let impulses = problem.solve()?;
        let gain = 0.5 * impulses.dot(&(problem.velocities(&impulses) + &before));
        Some((impulses, gain))
    };
    let unsolved = || InitialError::ContactForces { contact: candidates[0].subject() };
    let (mut impulses, mut gain) = solve(1.0).ok_or_else(unsolved)?;
    if gain > GAIN * kinetic {
        let with_all = gain;
        (impulses, gain) = solve(0.0).ok_or_else(unsolved)?;
        let least = gain;
        let mut rebounds = Rebounds::new(-least, [GAIN * kinetic; 2], MAX_SHARES);
        rebounds.record(with_all - least);
        while let Some(share) = rebounds.next_share() {
            let found = solve(share);
            let returned = found.as_ref().map_or(f64::INFINITY, |(_, gain)| gain - least);
            if rebounds.record(returned)
                && let Some(found) = found
            {
                (impulses, gain) = found;
            }
        }
        outcome.warnings.push(Warning::RestitutionReduced {
            time: state.kinematics.time,
            contact: candidates[0].subject(),
            factor: rebounds.found().unwrap_or(0.0),
        });
    }
    let mut changes = DVector::zeros(system.layout().size());
    for (response, impulse) in responses.iter().zip(impulses.iter()) {
        changes += response * *impulse;
    }
    add_rates(system.layout(), (1.0, changes.as_slice()), &mut state.kinematics);
    outcome.lost = Some(-gain);
    Ok(())
}

/// Indices of candidates with their modes and the directions against which their friction acts.
type Modes = Vec<(usize, Mode, Vector3<f64>)>;

/// Modes of the contacts that touch and do not separate, without those that open; and the contacts to omit, which others
/// keep closed.
fn select(
    candidates: &[Candidate<'_>],
    resting: &[usize],
    (compliance, accelerations): (&DMatrix<f64>, &[f64]),
    at: &Kinematics,
) -> Result<(Modes, Vec<usize>), InitialError> {
    if resting.is_empty() {
        return Ok(Default::default());
    }
    let index: Vec<usize> = resting.iter().flat_map(|k| 3 * k..3 * k + 3).collect();
    let compliance = DMatrix::from_fn(index.len(), index.len(), |i, j| compliance[(index[i], index[j])]);
    let mut free = DVector::zeros(index.len());
    let mut conditions = Vec::new();
    let accelerations = DVector::from_column_slice(accelerations);
    for (row, &k) in resting.iter().enumerate() {
        let Candidate { contact, touching, axes, rows, .. } = &candidates[k];
        let remaining = contact.remaining_acceleration(at, touching, axes);
        for i in 0..3 {
            free[3 * row + i] = rows[i].dot(&accelerations) + remaining[i];
        }
        let sliding = candidates[k].sliding();
        let slides = contact.has_friction() && sliding.norm() > contact.still();
        let sliding = slides.then(|| sliding.normalize());
        conditions.push(Condition { friction: contact.law.friction, rebound: 0.0, sliding });
    }
    let problem = ContactProblem { compliance, free, conditions };
    if let Some(row) = problem.paradox() {
        return Err(InitialError::ContactParadox { contact: candidates[resting[row]].subject() });
    }
    let forces = problem
        .solve()
        .ok_or_else(|| InitialError::ContactForces { contact: candidates[resting[0]].subject() })?;
    let after = problem.velocities(&forces);
    let largest = problem.free.amax();
    let (mut modes, mut normal_forces, mut kept) = (Vec::new(), Vec::new(), Vec::new());
    let is_pressed = |row: usize| problem.compliance[(3 * row, 3 * row)] * forces[3 * row] > ZERO * largest;
    if !(0..resting.len()).any(is_pressed) {
        return Ok((modes, Vec::new()));
    }
    for (row, &k) in resting.iter().enumerate() {
        let Candidate { contact, .. } = &candidates[k];
        if after[3 * row] > ZERO * largest {
            continue;
        }
        let begins = Vector2::new(after[3 * row + 1], after[3 * row + 2]);
        let (mode, direction) = match problem.conditions[row].sliding {
            Some(direction) => (Mode::Sliding, direction),
            None if !contact.has_friction() => (Mode::Sliding, Vector2::zeros()),
            None if begins.norm() > ZERO * largest => (Mode::Sliding, begins.normalize()),
            None => (Mode::Sticking, Vector2::zeros()),
        };
        modes.push((k, mode, candidates[k].in_base(&direction)));
        normal_forces.push(forces[3 * row]);
    }
    if modes.iter().any(|(k, mode, _)| *mode == Mode::Sliding && candidates[*k].contact.has_friction()) {
        kept = reduce(candidates, &mut modes, normal_forces);
    }
    Ok((modes, kept))
}

/// Omits contacts that slide and whose normal equations repeat those of others: the shares of normal forces affect friction, and must
/// be unique.
///
/// Legend: B rows of the normal velocities, y with Bᵀ y = 0, f normal forces.
///
/// ```text
/// f ← f - α y,      α the smallest with f_k = 0 for a contact k that slides
/// ```
fn reduce(candidates: &[Candidate<'_>], modes: &mut Modes, mut forces: Vec<f64>) -> Vec<usize> {
    let mut kept = Vec::new();
    loop {
        let rows: Vec<_> = modes
            .iter()
            .map(|(k, ..)| {
                let row = &candidates[*k].rows[0];
                row / row.norm().max(f64::MIN_POSITIVE)
            })
            .collect();
        let products = DMatrix::from_fn(rows.len(), rows.len(), |i, j| rows[i].dot(&rows[j]));
        let eigen = products.symmetric_eigen();
        let Some((least, _)) = eigen
            .eigenvalues
            .iter()
            .enumerate()
            .min_by(|a, b| a.1.total_cmp(b.1))
            .filter(|(_, value)| **value < DEPENDENT)
        else {
            return kept;
        };
        let dependence: Vec<f64> = (0..rows.len())
            .map(|i| {
                eigen.eigenvectors[(i, least)] / candidates[modes[i].0].rows[0].norm().max(f64::MIN_POSITIVE)
            })
            .collect();
        let size = dependence.iter().fold(0.0_f64, |most, own| most.max(own.abs()));
        let omitted = (0..rows.len())
            .filter(|&i| modes[i].1 == Mode::Sliding && dependence[i].abs() > PARTICIPATES * size)
            .min_by(|&a, &b| (forces[a] / dependence[a]).abs().total_cmp(&(forces[b] / dependence[b]).abs()));
        let Some(omitted) = omitted else { return kept };
        let alpha = forces[omitted] / dependence[omitted];
        forces.iter_mut().zip(&dependence).for_each(|(force, own)| *force -= alpha * own);
        forces.remove(omitted);
        kept.push(modes.remove(omitted).0);
    }
}

/// Smallest cosine of an angle between two directions that is round-off.
const PARALLEL: f64 = 1.0 - 1e-6;

/// Whether contacts that slide do so in other directions than one of them: their sum of friction then depends on the share of each.
fn sliding_directions_differ(candidates: &[Candidate<'_>], resting: &[usize], one: usize) -> bool {
    let direction = |k: usize| {
        let own = &candidates[k];
        let speed = own.sliding().norm();
        let slides = own.contact.has_friction() && speed > own.contact.still();
        slides.then(|| own.in_base(&(own.sliding() / speed)))
    };
    let Some(of_one) = direction(one) else { return false };
    resting.iter().filter_map(|&k| direction(k)).any(|own| own.dot(&of_one) < PARALLEL)
}

/// Makes velocities consistent with the modes, and the modes with the shares that contacts have in the forces.
fn share(
    system: &System,
    initial: &mut ConsistentInitialConditions,
    (candidates, resting, band): (&[Candidate<'_>], &[usize], f64),
    state: &mut State,
) -> Result<(), InitialError> {
    let is_closed = |k: usize, at: &Kinematics| candidates[k].contact.mode(at).is_closed();
    if !resting.iter().any(|&k| is_closed(k, &state.kinematics)) {
        return Ok(());
    }
    let count = system.layout().coordinate_count();
    // Every contact opens or is saturated once.
    for _ in 0..=2 * resting.len() {
        initial.velocities(system, state)?;
        let found = initial.acceleration_at(system, state)?;
        let multipliers = &found[count..];
        let at = &state.kinematics;
        let forces: Vec<_> = resting.iter().map(|&k| candidates[k].contact.forces(at, multipliers)).collect();
        let largest = forces.iter().fold(0.0_f64, |most, (normal, _)| most.max(normal.abs()));
        for &k in resting {
            let held = candidates[k].contact.held.scale;
            state.kinematics.held[held.index()] = largest;
        }
        let at = &state.kinematics;
        let worst = resting
            .iter()
            .zip(&forces)
            .filter(|(k, (normal, _))| is_closed(**k, at) && *normal < -ZERO_SHARE * largest)
            .min_by(|a, b| a.1.0.total_cmp(&b.1.0));
        if let Some((&k, _)) = worst {
            let contact = candidates[k].contact;
            set_mode(contact, Mode::Kept, &mut state.kinematics);
            state.kinematics.held[contact.held.offset.index()] -= band;
            continue;
        }
        let excess = |k: usize, (normal, friction): &(f64, Vector3<f64>)| {
            friction.norm() - candidates[k].contact.law.friction * normal
        };
        let slips = resting
            .iter()
            .zip(&forces)
            .filter(|(k, _)| candidates[**k].contact.mode(at) == Mode::Sticking)
            .filter(|(k, force)| excess(**k, force) > ZERO_SHARE * largest)
            .max_by(|a, b| excess(*a.0, a.1).total_cmp(&excess(*b.0, b.1)));
        let Some((&k, (_, friction))) = slips else { return Ok(()) };
        let direction = -friction.normalize();
        set_mode(candidates[k].contact, Mode::Saturated, &mut state.kinematics);
        set_direction(candidates[k].contact, &direction, &mut state.kinematics);
    }
    Err(InitialError::ContactForces { contact: candidates[resting[0]].subject() })
}

impl Simulation {
    /// Indices of the contacts whose events these are.
    pub(super) fn contacts_of(&self, happened: &[usize]) -> Vec<usize> {
        let of = self.system.contact_events();
        let found = happened.iter().filter_map(|event| of.iter().find(|(own, _)| own == event));
        found.map(|&(_, contact)| contact).collect()
    }

    /// Determines the modes of the contacts that touch at the start.
    ///
    /// # Errors
    /// If there are no consistent forces.
    pub(crate) fn begin_contacts(&mut self) -> Result<(), InitialError> {
        if !self.system.has_rigid_contacts() {
            return Ok(());
        }
        let Some(initial) = &mut self.held_values else { return Ok(()) };
        let length = self.integrator.representative.length;
        for contact in self.system.rigid_contacts() {
            let gap = contact.touching(&self.state.kinematics).gap.value;
            if gap < -CLOSED_AT_START * length {
                let contact = Subject::new("contact", &contact.name);
                return Err(InitialError::ContactPenetration { contact, depth: -gap });
            }
            self.state.kinematics.held[contact.held.drawn.index()] = gap.min(0.0);
        }
        let before = self.state.kinematics.clone();
        let outcome = resolve(
            &self.system,
            initial,
            &mut self.state,
            (&[], [CLOSED_AT_START * length, BAND * length]),
        )?;
        settle(&self.system, &mut self.state, initial, &self.settings)?;
        self.finish_contacts(&before, outcome);
        self.previous.clone_from(&self.state);
        self.origin.kinematics.clone_from(&self.state.kinematics);
        Ok(())
    }

    /// Changes held values, or the time at which functions of time are evaluated, and solves impacts of latches that engage and of
    /// contacts that `touched`; accelerations, multipliers and the rates of states jump.
    ///
    /// # Errors
    /// If there are no consistent forces; the state is then unchanged.
    pub(super) fn switch_constraints(
        &mut self,
        touched: &[usize],
        held: Option<Vec<f64>>,
        [earlier, later]: [f64; 2],
    ) -> Result<(), InitialError> {
        // With the tangent of a former equation, the new one would be solved to the tolerance only, and leave a force of that size
        // where there is none.
        self.integrator.jacobian_state.has_tangent = false;
        let kept = self.state.clone();
        let time = kept.kinematics.time;
        let engages = held.as_ref().is_some_and(|held| self.latches_switch(held).1);
        let Some(initial) = &mut self.held_values else {
            self.state.kinematics.held = held.unwrap_or(kept.kinematics.held);
            return Ok(());
        };
        let near = [CLOSED, BAND].map(|share| share * self.integrator.representative.length);
        let (system, state) = (&self.system, &mut self.state);
        let change = || {
            state.kinematics.time = earlier;
            if !touched.is_empty() {
                // In schemes of low order velocities deviate from those of drives.
                initial.velocities(system, state)?;
            }
            let before = initial.acceleration_at(system, state)?;
            state.kinematics.time = later;
            if let Some(held) = held {
                state.kinematics.held = held;
            }
            let mut latched = None;
            if engages {
                impact_of_latches(system, initial, state)?;
                latched = Some(state.clone());
            }
            let outcome = resolve(system, initial, state, (touched, near))?;
            let mut jump = initial.acceleration_at(system, state)?;
            jump.iter_mut().zip(&before).for_each(|(after, before)| *after -= before);
            Ok((outcome, jump, latched))
        };
        let changed = change();
        self.state.kinematics.time = time;
        match changed {
            Ok((outcome, jump, latched)) => {
                self.add_jump(jump);
                let mut before = &kept.kinematics;
                if let Some(latched) = &latched {
                    self.report.energy_balance.record_impact(&self.system, before, latched, None);
                    before = &latched.kinematics;
                }
                self.finish_contacts(before, outcome);
                Ok(())
            }
            Err(error) => {
                self.state = kept;
                Err(error)
            }
        }
    }

    /// Fails if a contact has begun to slide in Painlevé's paradox within the last step.
    ///
    /// # Errors
    /// If one has.
    pub(super) fn check_sliding(&mut self) -> Result<(), StepError> {
        let (system, state) = (&self.system, &self.state);
        let slides = |contact: &RigidContact| {
            contact.has_friction() && contact.mode(&state.kinematics) == Mode::Sliding
        };
        let sliding: Vec<_> = system
            .rigid_contacts()
            .filter(|contact| slides(contact))
            .map(|contact| Candidate::new(system, contact, &state.kinematics))
            .filter(|candidate| candidate.sliding().norm() > candidate.contact.still())
            .collect();
        let Some(initial) = self.held_values.as_mut().filter(|_| !sliding.is_empty()) else { return Ok(()) };
        let time = state.kinematics.time;
        let mut check = || {
            let mut free = state.clone();
            open_all(system, &mut free.kinematics);
            initial.factor(system, &free, Inertias::All)?;
            let responses = responses(system, initial, &sliding);
            let condition = |candidate: &Candidate<'_>| Condition {
                friction: candidate.contact.law.friction,
                rebound: 0.0,
                sliding: Some(candidate.sliding().normalize()),
            };
            let problem = ContactProblem {
                compliance: compliance(&sliding, &responses),
                free: DVector::zeros(3 * sliding.len()),
                conditions: sliding.iter().map(condition).collect(),
            };
            let paradox = problem.paradox().map(|k| sliding[k].subject());
            paradox.map_or(Ok(()), |contact| Err(InitialError::ContactParadox { contact }))
        };
        check().map_err(|error| StepError::Velocities { time, error })
    }

    /// Records an impact, and makes all events of contacts possible.
    fn finish_contacts(&mut self, before: &Kinematics, outcome: Outcome) {
        if !self.system.has_rigid_contacts() {
            return;
        }
        if outcome.lost.is_some() {
            self.report.energy_balance.record_impact(&self.system, before, &self.state, outcome.lost);
        }
        for warning in outcome.warnings {
            warn(&mut self.report.warnings, warning);
        }
        for contact in self.system.rigid_contacts() {
            let mode = contact.mode(&self.state.kinematics);
            let first = contact.first_multiplier;
            let sticks = mode == Mode::Sticking;
            let own = &mut self.state.multipliers[first..first + contact.multiplier_count()];
            // Multipliers of released constraints are round-off only.
            if !mode.is_closed() || sticks {
                own[0] = 0.0;
            }
            if !sticks {
                own[1..].fill(0.0);
            }
        }
        self.state.kinematics.show_multipliers(&self.state.multipliers);
        self.events.known.has_switched = true;
        self.rearm_contacts();
    }

    /// Makes all events of contacts possible.
    pub(super) fn rearm_contacts(&mut self) {
        let events = self.system.contact_events().iter().map(|&(event, _)| event);
        self.events.known.rise(events);
    }

    /// Warns of a contact within the last step of planned size that was not detected: the solids penetrated each other.
    ///
    /// Advances over the step by the gap over twice the largest velocity found.
    pub(super) fn report_missed_contacts(&mut self) {
        let Some(step) = self.control.planned() else { return };
        let (from, to) = (&self.previous, &self.state);
        let duration = to.kinematics.time - from.kinematics.time;
        let allowed = -CLOSED * self.integrator.representative.length;
        let mut between = to.clone();
        let mut missed = None;
        for contact in self.system.rigid_contacts() {
            if [from, to].iter().any(|end| contact.mode(&end.kinematics) != Mode::Open) {
                continue;
            }
            let speed = |at: &Kinematics| contact.touching(at).velocity.norm();
            let mut fastest = speed(&from.kinematics).max(speed(&to.kinematics));
            let mut share = LEAST_ADVANCE;
            while share < 1.0 {
                at_share(from, to, share, &mut between);
                let touching = contact.touching(&between.kinematics);
                fastest = fastest.max(touching.velocity.norm());
                if touching.gap.value < allowed {
                    missed = Some(Subject::new("contact", &contact.name));
                    break;
                }
                let safe = touching.gap.value / (2.0 * fastest * duration).max(f64::MIN_POSITIVE);
                share += safe.max(LEAST_ADVANCE);
            }
        }
        if let Some(function) = missed {
            let time = from.kinematics.time;
            warn(&mut self.report.warnings, Warning::FunctionUnseen { time, function, step });
        }
    }

    /// Updates the directions of friction at contacts whose sliding has turned, and opens contacts that others no longer keep.
    pub(super) fn follow_contacts(&mut self) {
        let closed = CLOSED * self.integrator.representative.length;
        for contact in self.system.rigid_contacts() {
            let at = &self.state.kinematics;
            if contact.mode(at) == Mode::Kept && contact.touching(at).gap.value > closed {
                set_mode(contact, Mode::Open, &mut self.state.kinematics);
                continue;
            }
            if contact.mode(at) != Mode::Sliding || !contact.has_friction() {
                continue;
            }
            let sliding = contact.touching(at).sliding();
            let speed = sliding.norm();
            if speed > contact.still() && sliding.dot(&contact.direction(at)) < TURNED * speed {
                set_direction(contact, &(sliding / speed), &mut self.state.kinematics);
            }
        }
    }
}

/// Smallest step fraction of an advance.
const LEAST_ADVANCE: f64 = 1e-3;
/// Cosine of the angle between sliding and its reference from which the reference is updated.
const TURNED: f64 = 0.95;
