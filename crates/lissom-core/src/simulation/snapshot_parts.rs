//! Saves and restores the data of a workspace that are reused from step to step.

use lissom_solver::FactorError;
use serde::{Deserialize, Serialize};

use crate::consistent::redundancy::Selection;
use crate::integrator::anderson::Anderson;
use crate::integrator::predictor::Predictor;
use crate::integrator::workspace::{Effort, Workspace};
use crate::saddle_point;
use crate::system::System;

/// Data that are reused from step to step, except the state.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Learned {
    predictors: [Predictor; 2],
    anderson: Anderson,
    effort: Effort,
    backed_off: bool,
    tangent: saddle_point::Learned,
    redundancy: Vec<Selection>,
    force_round_off: f64,
    /// Angles of rotors at which the tangent was assembled [rad].
    angles: Vec<f64>,
    /// Nodes that the tangent couples because they have touched.
    coupled: Vec<[usize; 2]>,
}

impl Workspace {
    pub(crate) fn learned(&self) -> Learned {
        Learned {
            predictors: self.prediction.predictors.clone(),
            anderson: self.newton.anderson.clone(),
            effort: self.newton.effort,
            backed_off: self.newton.backed_off,
            tangent: self.tangent.learned(),
            redundancy: self.redundancy.selections(),
            force_round_off: self.round_off.force,
            angles: self.unit.spins.angles_of_tangent(),
            coupled: self.contacts.as_ref().map(|contacts| contacts.pattern.couples()).unwrap_or_default(),
        }
    }

    /// Restores the data, and factors the tangent again.
    ///
    /// # Errors
    /// If a tangent cannot be factored: the data are damaged.
    pub(crate) fn restore(&mut self, system: &System, from: &Learned) -> Result<(), FactorError> {
        for (guess, learned) in self.prediction.predictors.iter_mut().zip(&from.predictors) {
            guess.restore(learned);
        }
        self.newton.anderson.restore(&from.anderson);
        self.newton.effort = from.effort;
        self.newton.backed_off = from.backed_off;
        self.round_off.force = from.force_round_off;
        self.redundancy.restore(&from.redundancy);
        self.unit.spins.restore(&from.angles);
        self.unit.spins.omit(self.redundancy.omitted());
        let Some(contacts) = &mut self.contacts else {
            return self.tangent.restore(system.structure(), &from.tangent);
        };
        // Every step with touches begins with a new tangent.
        contacts.pattern.restore(system.layout(), &from.coupled);
        Ok(())
    }
}
