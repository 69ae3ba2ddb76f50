//! Energy balance: energy of the model compared with the work of loads and drives. Dissipation by dampers and schemes
//! lowers it; nothing may raise it.
//!
//! ```text
//! D = E - W,     surplus = D - (least D so far),     lost = (D at the start) - D
//! ```
//!
//! In a model without dissipation, the lost energy is dissipated by the scheme, or work is computed with wrong
//! forces.
//!
//! E kinetic, elastic and potential energy, W work of loads and drives (see `System::work_of_loads`). In statics
//! weight is a load, because it may be applied in steps, and nothing dissipates energy; the potential energy is that
//! of the full weight.

use serde::{Deserialize, Serialize};

use crate::elements::Energy;
use crate::errors::StepError;
use crate::kinematics::Kinematics;
use crate::round_off;
use crate::scaling::{Representative, StageMotion};
use crate::system::{State, System};

/// A surplus of this fraction of the energy exchanged is reported.
const NOTEWORTHY: f64 = 0.05;
/// A surplus of this fraction of the energy exchanged, over a run or in a single step, makes the motion invalid.
const GROSS: f64 = 0.25;

/// Input of the energy balance from a state.
pub(crate) struct Entry<'a> {
    at: &'a Kinematics,
    multipliers: &'a [f64],
    violations: &'a [f64],
    of_touches: Energy,
}

impl<'a> From<&'a State> for Entry<'a> {
    fn from(state: &'a State) -> Self {
        Self {
            at: &state.kinematics,
            multipliers: &state.multipliers,
            violations: &state.violations,
            of_touches: state.touch_energy(),
        }
    }
}

/// Work of loads and drives in a step [J].
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct StepWork {
    loads: f64,
    drives: f64,
}

impl StepWork {
    /// From the ends of a step, for forces that change linearly in time.
    pub(crate) fn between(system: &System, start: &State, end: &State) -> Self {
        let [from, to] = [start, end].map(|state| (&state.kinematics, &state.multipliers[..]));
        Self { loads: system.work_of_loads(from.0, to.0), drives: system.work_of_drives(from, to) }
    }

    /// With further work of loads [J].
    pub(crate) fn with_loads(self, work: f64) -> Self {
        Self { loads: self.loads + work, ..self }
    }

    /// By the quadrature of a scheme over its stages, in a step of `size` [s]: to the order of the scheme, and so that what an
    /// algebraically stable scheme dissipates is never negative.
    pub(crate) fn of_stages(
        system: &System,
        (weights, size): (&[f64], f64),
        stages: &[StageMotion],
        multipliers: &[Vec<f64>],
    ) -> Self {
        let mut work = Self::default();
        for ((weight, stage), multipliers) in weights.iter().zip(stages).zip(multipliers) {
            let duration = weight * size;
            work.loads += duration * system.power_of_loads(&stage.at);
            work.drives += duration * system.power_of_drives(&stage.at, multipliers);
        }
        work
    }
}

/// In smooth motion energy is evaluated after this number of steps, so that it costs about one part in a hundred.
const STRIDE: u32 = 8;

/// Energy and work since the start of a simulation [J].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct EnergyBalance {
    /// Energy at its last evaluation, at most eight steps ago.
    pub energy: Energy,
    /// Work of forces, moments and other loads since the start, in statics that of weight included.
    pub loads: f64,
    /// Work of prescribed motions since the start.
    pub drives: f64,
    /// Energy that latches have dissipated when they engaged.
    #[serde(default)]
    pub latches: f64,
    /// The largest surplus so far: energy without a source.
    pub surplus: f64,
    /// Energy dissipated by dampers, friction, impacts and the scheme since the start: negative if they supplied energy.
    #[serde(default)]
    pub lost: f64,
    /// Energy exchanged so far: the largest sum of kinetic and elastic energy, the range of the potential one, and
    /// the work of loads and drives in both directions.
    pub turned_over: f64,
    #[serde(default)]
    first_balance: f64,
    least_balance: f64,
    /// The largest sum of kinetic and elastic energy.
    most: f64,
    potential: [f64; 2],
    moved: f64,
    floor: f64,
    /// Upper bound of the energy of violated constraints: redundant ones have a small compliance, like springs.
    constraint_energy: f64,
    /// Steps since the energy was evaluated.
    steps_since_check: u32,
}

impl EnergyBalance {
    /// At the start of a simulation; of a motion, with the `interval` in which positions change [s].
    pub(crate) fn new(
        system: &System,
        state: &State,
        representative: &Representative,
        interval: Option<f64>,
    ) -> Self {
        let energy = system.energy_of(state);
        let place = round_off::POSITION * representative.length;
        // Models at rest move by round-off of positions, and then have energy although none was supplied.
        let speed = interval.map_or(0.0, |interval| round_off::INCREMENT * representative.length / interval);
        let mut energy_balance = Self {
            energy,
            most: energy.kinetic + energy.strain.abs(),
            potential: [energy.potential; 2],
            floor: representative.stiffness * place * place + representative.mass * speed * speed,
            ..Self::default()
        };
        energy_balance.least_balance = energy_balance.balance(interval.is_some());
        energy_balance.first_balance = energy_balance.least_balance;
        energy_balance
    }

    /// Whether the surplus requires a warning.
    pub fn is_noteworthy(&self) -> bool {
        self.surplus > NOTEWORTHY * self.turned_over + self.least_known()
    }

    /// Energies below this are round-off, or stored in constraints.
    fn least_known(&self) -> f64 {
        let largest = self.most.max(self.potential[0].abs()).max(self.potential[1].abs());
        self.floor + self.constraint_energy + round_off::ENERGY * largest + f64::MIN_POSITIVE
    }

    fn balance(&self, is_motion: bool) -> f64 {
        let energy = if is_motion { self.energy.total() } else { self.energy.strain };
        energy - self.loads - self.drives
    }

    /// After a step in which loads and drives did this work. The energy of every element costs a tenth of a step: without `weighs`
    /// only work is summed.
    pub(crate) fn after(
        &self,
        system: &System,
        (start, end): (&Entry<'_>, &Entry<'_>),
        StepWork { loads, drives }: StepWork,
        (weighs, is_motion): (bool, bool),
    ) -> Self {
        let held = end.multipliers.iter().zip(end.violations);
        let constraint_energy = held.map(|(force, violation)| (force * violation).abs()).sum::<f64>();
        let mut after = Self {
            constraint_energy: if constraint_energy > self.constraint_energy {
                constraint_energy
            } else {
                self.constraint_energy
            },
            loads: self.loads + loads,
            drives: self.drives + drives,
            moved: self.moved + loads.abs() + drives.abs(),
            steps_since_check: self.steps_since_check + 1,
            ..*self
        };
        if weighs {
            // Weight that grows with the load parameter does work by the trapezoidal rule, as other loads do.
            let gravity = [start.at, end.at].map(|at| system.gravity_factor(at.time));
            let of_weight = (!is_motion).then_some(0.5 * (gravity[0] + gravity[1]));
            after.weigh([system.energy(end.at), end.of_touches].into_iter().sum(), of_weight);
        }
        after
    }

    /// Records an impact that dissipates `lost` [J] at an instant; without it an inelastic one, which dissipates the kinetic energy of
    /// the change of velocities. The rest of the change of energy is work of drives. Touches of a set keep their energy.
    pub(crate) fn record_impact(
        &mut self,
        system: &System,
        before: &Kinematics,
        after: &State,
        lost: Option<f64>,
    ) {
        let lost = lost.unwrap_or_else(|| {
            let mut change = after.kinematics.clone();
            change.nodes.iter_mut().zip(&before.nodes).for_each(|(own, before)| own.twist -= before.twist);
            let coordinates = change.coordinates.iter_mut().zip(&before.coordinates);
            coordinates.for_each(|(own, before)| own.rate -= before.rate);
            system.energy(&change).kinetic
        });
        let energy = system.energy_of(after);
        let drives = energy.kinetic - system.energy(before).kinetic + lost;
        self.latches += lost;
        self.drives += drives;
        self.moved += drives.abs();
        self.weigh(energy, None);
    }

    /// Records the energy; in statics with the part of the weight that acts as a load.
    fn weigh(&mut self, energy: Energy, of_weight: Option<f64>) {
        if let Some(part) = of_weight {
            self.loads -= part * (energy.potential - self.energy.potential);
        }
        let is_motion = of_weight.is_none();
        self.energy = energy;
        self.steps_since_check = 0;
        self.most = self.most.max(energy.kinetic + energy.strain.abs());
        self.potential = [self.potential[0].min(energy.potential), self.potential[1].max(energy.potential)];
        let balance = self.balance(is_motion);
        self.surplus = self.surplus.max(balance - self.least_balance);
        self.least_balance = self.least_balance.min(balance);
        self.lost = self.first_balance - balance;
        self.turned_over = self.most + (self.potential[1] - self.potential[0]) + self.moved;
    }

    /// Whether the energy has to be evaluated after the next step, however smooth it is.
    pub(crate) fn is_due(&self) -> bool {
        self.steps_since_check + 1 >= STRIDE
    }

    /// Fails if this energy balance, after `before`, has a gross surplus of energy.
    pub(crate) fn refuse_gain(
        &self,
        before: &Self,
        time: f64,
        (node, remedy): (impl FnOnce() -> String, &'static str),
    ) -> Result<(), StepError> {
        let allowed = GROSS * self.turned_over + self.least_known();
        if self.surplus <= allowed || self.surplus <= before.surplus {
            return Ok(());
        }
        let gain = self.balance(true) - before.balance(true);
        Err(StepError::EnergyFromNowhere {
            time,
            surplus: self.surplus,
            turned_over: self.turned_over,
            in_this_step: gain > 0.5 * self.surplus,
            node: node(),
            remedy,
        })
    }

    /// In statics, the energy lost or gained in the last load step relative to the work done in it: along a path of
    /// equilibria only the error of the trapezoidal rule is missing.
    pub(crate) fn missing_work(&self, before: &Self) -> f64 {
        let stored = self.energy.strain - before.energy.strain;
        let (loads, drives) = (self.loads - before.loads, self.drives - before.drives);
        // The work that drives do against a load is done by one and undone by the other.
        let turned_over = stored.abs() + loads.abs() + drives.abs();
        (stored - loads - drives).abs() / (turned_over + self.least_known())
    }

    /// The energy stored in the last load step beyond the work done in it [J].
    pub(crate) fn unexplained_work(&self, before: &Self) -> f64 {
        let stored = self.energy.strain - before.energy.strain;
        stored - (self.loads - before.loads) - (self.drives - before.drives)
    }
}
