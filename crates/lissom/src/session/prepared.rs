//! A prepared model, shared by many sessions: its system is built once.

use lissom_core::diagnostics::Diagnose;
use std::sync::Arc;

use crate::start::{Lowered, lower_with_units};
use lissom_core::errors::InitialError;
use lissom_core::kinematics::Kinematics;
use lissom_core::system::{State, System};
use lissom_model::Document;
use lissom_model::document::AnalysisKind;
use lissom_model::lower::Plan;

use super::{Session, SessionError};
use crate::ids::{ForeignId, IdNames, InputId, Part};

/// Allowed violation of a constraint in a given state: of an angle [rad], and of a length over the size of the model.
const MAX_VIOLATION: f64 = 1e-6;

/// A prepared model. Sessions that are started from it, or from its copies, share one [`System`], also in several threads.
#[derive(Clone)]
pub struct Prepared {
    lowered: Lowered,
    ids: Option<Arc<IdNames>>,
}

/// Why no session can start from a state.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[error("{}", self.diagnostic())]
pub enum StartError {
    /// It does not match the model.
    OtherModel {
        /// The quantity with a different number.
        what: &'static str,
        /// The number found.
        found: usize,
        /// The number expected.
        wanted: usize,
    },
    /// A number is not finite.
    NotFinite,
    /// Positions do not satisfy the constraints.
    Violated {
        /// Name of the joint.
        joint: String,
        /// Which of its equations.
        equation: &'static str,
        /// By how much [m, rad].
        violation: f64,
    },
    /// There are no consistent velocities or accelerations.
    #[error(transparent)]
    Initial(#[from] InitialError),
}

/// Why the initial motion of an id cannot be set.
#[derive(Debug, thiserror::Error)]
#[error("{}", self.diagnostic())]
#[non_exhaustive]
pub enum PartError {
    /// The model was read from a text: its parts have no ids.
    NotBuilt,
    /// The id belongs to another model.
    Foreign(#[from] ForeignId),
    /// The state is of another model.
    NoInput(String),
    /// A beam has many nodes.
    Beam(String),
}

impl Prepared {
    /// Prepares a document.
    ///
    /// # Errors
    /// If the model is invalid, or its analysis has no time history.
    pub fn of(document: &Document) -> Result<Self, SessionError> {
        Self::new(document, None)
    }

    pub(crate) fn new(document: &Document, ids: Option<Arc<IdNames>>) -> Result<Self, SessionError> {
        let kind = &document.analysis.kind;
        if !matches!(kind, AnalysisKind::Dynamics { .. } | AnalysisKind::Statics { .. }) {
            return Err(SessionError::NotInTime(kind.name()));
        }
        Ok(Self { lowered: lower_with_units(document)?, ids })
    }

    pub(crate) fn lowered(&self) -> &Lowered {
        &self.lowered
    }

    /// The shared system.
    pub fn system(&self) -> &Arc<System> {
        &self.lowered.system
    }

    /// The initial state of the model: accelerations and multipliers are not yet computed.
    pub fn state(&self) -> &State {
        &self.lowered.state
    }

    /// Names of the inputs, in the order of the file.
    pub fn inputs(&self) -> &[String] {
        &self.lowered.names.inputs
    }

    /// A session at the initial state of the model.
    ///
    /// # Errors
    /// If there are no consistent initial values.
    pub fn session(&self) -> Result<Session, InitialError> {
        Ok(Session::start(self.lowered.clone())?.with_ids(self.ids.clone()))
    }

    /// A session that starts from `state`, at its time: from its positions, velocities and held values. Velocities are made
    /// consistent with the constraints, accelerations and multipliers follow. This is a new start; to continue to the last bit,
    /// use [`Session::snapshot`] or [`Session::try_clone`].
    ///
    /// # Errors
    /// If the state does not match the model, or its positions violate the constraints.
    pub fn session_from(&self, state: State) -> Result<Session, StartError> {
        self.check(&state)?;
        let mut lowered = self.lowered.clone();
        lowered.settings.from_equilibrium = false;
        lowered.plan = plan_from(&lowered.plan, state.kinematics.time, lowered.settings.step_size);
        lowered.state = state;
        lowered.state.kinematics.elapsed = 0.0;
        Ok(Session::start(lowered)?.with_ids(self.ids.clone()))
    }

    /// Sets `velocity` [m/s, global axes] and `angular_velocity` [rad/s, body axes] of a body or point mass in `state`.
    ///
    /// # Errors
    /// If the part is a beam, or of another model.
    pub fn set_velocity(
        &self,
        state: &mut State,
        part: impl Into<Part>,
        velocity: impl Into<[f64; 3]>,
        angular_velocity: impl Into<[f64; 3]>,
    ) -> Result<(), PartError> {
        let name = self.ids()?.name(part.into().0)?;
        let Some(node) =
            self.lowered.names.nodes.get(name).and_then(|&node| state.kinematics.nodes.get_mut(node.index()))
        else {
            return Err(PartError::Beam(name.to_owned()));
        };
        let velocity = node.frame.rotation.apply_inverse(&velocity.into().into());
        let angular: [f64; 3] = angular_velocity.into();
        for axis in 0..3 {
            node.twist[axis] = velocity[axis];
            node.twist[axis + 3] = angular[axis];
        }
        Ok(())
    }

    /// Sets the value of an input in `state`.
    ///
    /// # Errors
    /// If the input belongs to another model.
    pub fn set_input(&self, state: &mut State, input: InputId, value: f64) -> Result<(), PartError> {
        let name = self.ids()?.name(input)?;
        let held = self
            .lowered
            .system
            .signals()
            .input(name)
            .and_then(|held| state.kinematics.held.get_mut(held.index()));
        *held.ok_or_else(|| PartError::NoInput(name.to_owned()))? = value;
        Ok(())
    }

    fn ids(&self) -> Result<&IdNames, PartError> {
        self.ids.as_deref().ok_or(PartError::NotBuilt)
    }

    fn check(&self, state: &State) -> Result<(), StartError> {
        let own = &self.lowered.state;
        let sizes = |state: &State| {
            let Kinematics { nodes, coordinates, held, .. } = &state.kinematics;
            [
                ("nodes", nodes.len()),
                ("coordinates", coordinates.len()),
                ("held values", held.len()),
                ("multipliers", state.multipliers.len()),
                ("violations", state.violations.len()),
                ("remembered accelerations", state.algorithmic.len()),
                ("remainders", state.position_remainders.len()),
            ]
        };
        for ((what, found), (_, wanted)) in sizes(state).into_iter().zip(sizes(own)) {
            if found != wanted {
                return Err(StartError::OtherModel { what, found, wanted });
            }
        }
        if !is_finite(&state.kinematics) {
            return Err(StartError::NotFinite);
        }
        let system = &self.lowered.system;
        let violations = |at: &Kinematics| {
            let mut all = vec![0.0; system.layout().multiplier_rows().len()];
            system.violations(at, &mut all);
            all
        };
        let positions = state.kinematics.nodes.iter().map(|node| node.frame.position);
        let size = positions.map(|position| position.amax()).fold(0.0, f64::max);
        let rows = &system.layout().quantities()[system.layout().multiplier_rows()];
        let given = violations(&state.kinematics);
        for (index, ((violation, known), quantity)) in
            given.iter().zip(violations(&own.kinematics)).zip(rows).enumerate()
        {
            let unit = if *quantity == lissom_core::kinematics::Quantity::Angle { 1.0 } else { size };
            // Violations at the start of the model are reported when it is read.
            if violation.abs() > known.abs() + MAX_VIOLATION * unit {
                let (joint, equation) = system.layout().constraint_name(index);
                return Err(StartError::Violated {
                    joint: joint.to_owned(),
                    equation,
                    violation: violation.abs(),
                });
            }
        }
        Ok(())
    }
}

fn is_finite(at: &Kinematics) -> bool {
    let of_node = |node: &lissom_core::kinematics::NodeMotion| {
        node.frame.position.iter().chain(node.twist.iter()).all(|number| number.is_finite())
            && node.frame.rotation.quaternion().iter().all(|number| number.is_finite())
    };
    at.time.is_finite()
        && at.nodes.iter().all(of_node)
        && at.coordinates.iter().all(|own| own.value.is_finite() && own.rate.is_finite())
        && at.held.iter().all(|held| held.is_finite())
}

/// The rest of a plan from `time` [s] on, in planned steps of `size` [s].
fn plan_from(plan: &Plan, time: f64, size: f64) -> Plan {
    if time == plan.start {
        return *plan;
    }
    let rest = ((plan.end - time) / size - 1e-6).ceil().max(0.0);
    Plan { start: time, end: plan.end.max(time), steps: rest as usize, ..*plan }
}
