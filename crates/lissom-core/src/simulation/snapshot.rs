//! A simulation between two steps, as plain values: sufficient to continue to the last bit. Contains the state, and all data that are
//! reused from step to step: the tangent in use, estimates of round-off, predictions, secants, the controller.
//!
//! Factors are not stored: the values of the tangent are stored and factored again.

use std::sync::Arc;

use lissom_motion::{Motion, Rotation, Vector3, Vector6, Versor};
use serde::{Deserialize, Serialize};

use super::laws::Magnitudes;
use super::units::SavedUnit;
use super::{EventState, RunReport};
use crate::diagnostics::diagnostics;
use crate::integrator::IntegratorHistory;
use crate::kinematics::{CoordinateMotion, Kinematics, NodeMotion, Subject};
use crate::newton::JacobianState;
use crate::scaling::Scaled;
use crate::settings::Settings;
use crate::simulation::Simulation;
use crate::simulation::signal_history::SignalHistory;
use crate::simulation::snapshot_parts::Learned;
use crate::system::{State, Touch};
use crate::units::Unit;

/// Incremented whenever the contents of a snapshot change.
const VERSION: u32 = 33;

/// A simulation between two steps.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Snapshot {
    version: u32,
    /// Scheme, unknowns, nodes and entries of the tangent, which identify the model.
    belongs_to: (String, usize, usize, usize),
    states: [StateNumbers; 2],
    /// Motion at the start, and the correction of its velocities.
    origin: (StateNumbers, f64),
    step_size: f64,
    integrator: IntegratorSnapshot,
    control: Vec<u8>,
    report: RunReport,
    event_state: EventState,
    /// Magnitudes of scalar laws.
    magnitudes: Magnitudes,
    /// Data of the monitors, by name.
    monitors: Vec<(String, Vec<u8>)>,
    learned: Learned,
    history: SignalHistory,
    units: Vec<SavedUnit>,
}

/// State of the integrator: the tangent in use and the memory of the scheme.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct IntegratorSnapshot {
    scaled: Scaled,
    jacobian_state: JacobianState,
    history: Option<(f64, bool, Vec<f64>, Vec<f64>)>,
}

diagnostics! {
    /// A snapshot that cannot be restored.
    #[derive(Clone, Debug, PartialEq, Eq)]
    #[non_exhaustive]
    Failure SnapshotError {
        /// It was taken by another version of the program.
        Version {
            /// The snapshot's version.
            found: u32,
        } => "snapshot-version" {
            cause: ("the snapshot is of version {found}, but this program reads version {VERSION}"),
            remedy: "run the model again",
            meaning: "A snapshot was taken by another version of the program.",
        }
        /// It was taken of another model, or with another scheme.
        OtherModel {
            /// Description of the snapshot's model and scheme.
            found: String,
        } => "snapshot-of-other-model" {
            cause: ("the snapshot belongs to another model or scheme ({found})"),
            remedy: "restore it in a session of the model of which it was taken",
            meaning: "A snapshot was taken of another model, or with another scheme.",
        }
        /// It contains invalid data, such as a tangent that cannot be factored again.
        Damaged {} => "snapshot-damaged" {
            cause: ("the snapshot is damaged"),
            remedy: "run the model again",
            meaning: "A snapshot cannot be read, or its tangent cannot be factored again.",
        }
        /// A unit cannot return its state.
        Unit {
            /// The unit.
            unit: String,
        } => "snapshot-of-unit" {
            subject: Subject::new("unit", unit),
            cause: ("the state of the unit `{unit}` cannot be stored or copied"),
            remedy: "run without checkpoints, or use a unit with `canSerializeFMUState`",
            meaning: "A snapshot of a model with a unit of another program contains the state of the unit, which not all units can return. \
                Copies of a session have no unit of their own.",
        }
        /// A unit does not accept a state.
        UnitRestore {
            /// The unit.
            unit: String,
            /// Why not.
            reason: String,
        } => "snapshot-rejected-by-unit" {
            subject: Subject::new("unit", unit),
            cause: ("the unit `{unit}` cannot return to its stored state: {reason}"),
            remedy: "run the model again",
            meaning: "A unit of another program rejects a state that it has returned before.",
        }
    }
}

/// A state as plain values, in the order of its fields.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct StateNumbers {
    time: f64,
    elapsed: f64,
    time_remainder: f64,
    nodes: Vec<[f64; 19]>,
    coordinates: Vec<[f64; 3]>,
    held: Vec<f64>,
    multipliers: Vec<f64>,
    /// Whether elements depend on the multipliers.
    shows_multipliers: bool,
    violations: Vec<f64>,
    algorithmic: Vec<f64>,
    position_remainders: Vec<[f64; 3]>,
    accumulated: Vec<f64>,
    touches: Vec<Touch>,
}

impl From<&State> for StateNumbers {
    fn from(state: &State) -> Self {
        let State {
            kinematics,
            multipliers,
            violations,
            algorithmic,
            time_remainder,
            position_remainders,
            accumulated,
            touches,
        } = state;
        let Kinematics { time, elapsed, nodes, coordinates, held, multipliers: shown, units: _ } = kinematics;
        let of_node = |node: &NodeMotion| {
            let mut numbers = [0.0; 19];
            numbers[..4].copy_from_slice(&node.frame.rotation.quaternion());
            numbers[4..7].copy_from_slice(node.frame.position.as_slice());
            numbers[7..13].copy_from_slice(node.twist.as_slice());
            numbers[13..].copy_from_slice(node.acceleration.as_slice());
            numbers
        };
        Self {
            time: *time,
            elapsed: *elapsed,
            time_remainder: *time_remainder,
            nodes: nodes.iter().map(of_node).collect(),
            coordinates: coordinates.iter().map(|own| [own.value, own.rate, own.acceleration]).collect(),
            held: held.clone(),
            multipliers: multipliers.clone(),
            shows_multipliers: !shown.is_empty(),
            violations: violations.clone(),
            algorithmic: algorithmic.clone(),
            position_remainders: position_remainders.iter().map(|place| (*place).into()).collect(),
            accumulated: accumulated.clone(),
            touches: touches.clone(),
        }
    }
}

impl StateNumbers {
    /// The state with the running units of a simulation.
    fn to_state(&self, units: &[Arc<dyn Unit>]) -> State {
        let of_node = |numbers: &[f64; 19]| {
            let vector = Vector3::new(numbers[1], numbers[2], numbers[3]);
            let rotation = Rotation::from(Versor { scalar: numbers[0], vector: (&vector).into() });
            NodeMotion {
                frame: Motion::new(rotation, Vector3::new(numbers[4], numbers[5], numbers[6])),
                twist: Vector6::from_column_slice(&numbers[7..13]),
                acceleration: Vector6::from_column_slice(&numbers[13..]),
            }
        };
        State {
            kinematics: Kinematics {
                time: self.time,
                elapsed: self.elapsed,
                nodes: self.nodes.iter().map(of_node).collect(),
                coordinates: self
                    .coordinates
                    .iter()
                    .map(|&[value, rate, acceleration]| CoordinateMotion { value, rate, acceleration })
                    .collect(),
                held: self.held.clone(),
                multipliers: if self.shows_multipliers { self.multipliers.clone() } else { Vec::new() },
                units: units.to_vec(),
            },
            multipliers: self.multipliers.clone(),
            violations: self.violations.clone(),
            algorithmic: self.algorithmic.clone(),
            time_remainder: self.time_remainder,
            position_remainders: self.position_remainders.iter().map(|&place| place.into()).collect(),
            accumulated: self.accumulated.clone(),
            touches: self.touches.clone(),
        }
    }
}

impl Simulation {
    /// Snapshot of the simulation between two steps: a simulation of the same model that restores it continues as this one does, to
    /// the last bit.
    pub fn snapshot(&self) -> Snapshot {
        let with = |at: &Kinematics| (&State { kinematics: at.clone(), ..self.state.clone() }).into();
        Snapshot {
            version: VERSION,
            belongs_to: self.belonging(),
            states: [(&self.previous).into(), (&self.state).into()],
            origin: (with(&self.origin.kinematics), self.origin.velocity_correction),
            step_size: self.settings.step_size,
            integrator: IntegratorSnapshot {
                scaled: self.integrator.scaled,
                jacobian_state: self.integrator.jacobian_state,
                history: self.integrator.history.as_ref().map(IntegratorHistory::to_numbers),
            },
            control: self.control.save(),
            report: self.report.clone(),
            event_state: self.events.known.clone(),
            magnitudes: self.stops.laws.magnitudes.clone(),
            monitors: self.monitors.save(),
            learned: self.integrator.work.learned(),
            history: self.stops.history.clone(),
            units: self.save_units(),
        }
    }

    /// Sets the simulation to the state of a snapshot.
    ///
    /// # Errors
    /// If it was taken of another model, or by another version of the program. The simulation is then unchanged.
    pub fn restore(&mut self, from: &Snapshot) -> Result<(), SnapshotError> {
        if from.version != VERSION {
            return Err(SnapshotError::Version { found: from.version });
        }
        let is_alike = from.states[1].accumulated.len() == self.accumulation.numbers.len()
            && from.history.is_like(&self.stops.history);
        if !is_alike || from.belongs_to != self.belonging() {
            let (scheme, unknowns, nodes, _) = &from.belongs_to;
            return Err(SnapshotError::OtherModel {
                found: format!("{scheme}, {unknowns} unknowns, {nodes} nodes"),
            });
        }
        self.restore_units(&from.units)?;
        let is_read = self.integrator.work.restore(&self.system, &from.learned).is_ok()
            && self.control.restore(&from.control)
            && self.monitors.restore(&from.monitors);
        if !is_read {
            return Err(SnapshotError::Damaged {});
        }
        let units = std::mem::take(&mut self.state.kinematics.units);
        self.previous = from.states[0].to_state(&units);
        self.state = from.states[1].to_state(&units);
        self.origin.kinematics = from.origin.0.to_state(&units).kinematics;
        self.origin.velocity_correction = from.origin.1;
        self.stops.laws.magnitudes.clone_from(&from.magnitudes);
        self.stops.history.clone_from(&from.history);
        self.settings.step_size = from.step_size;
        let integrator = &mut self.integrator;
        integrator.scaled = from.integrator.scaled;
        integrator.jacobian_state = from.integrator.jacobian_state;
        if let (Some(history), Some(numbers)) = (&mut integrator.history, &from.integrator.history) {
            history.set_numbers(numbers);
        }
        integrator.work.note_scales(self.system.layout(), &integrator.scaled);
        self.report.clone_from(&from.report);
        self.events.known.clone_from(&from.event_state);
        self.integrator.has_last_step = false;
        Ok(())
    }

    /// A second simulation in the same state, which continues with bit-identical results. Both share the system.
    ///
    /// # Errors
    /// If the tangent in use cannot be factorised again.
    pub fn try_clone(&self) -> Result<Self, SnapshotError> {
        let settings = Settings { from_equilibrium: false, ..self.settings.clone() };
        let origin = State { kinematics: self.origin.kinematics.clone(), ..self.state.clone() };
        let mut copy =
            Self::start(Arc::clone(&self.system), origin, settings, Some(&self.integrator.representative))
                .map_err(|_| SnapshotError::Damaged {})?;
        copy.accumulate(self.accumulation.numbers.clone());
        copy.restore(&self.snapshot())?;
        Ok(copy)
    }

    fn belonging(&self) -> (String, usize, usize, usize) {
        let layout = self.system.layout();
        let entries = self.system.structure().pattern.entries();
        (self.settings.scheme.name.clone(), layout.size(), layout.node_count(), entries)
    }
}
