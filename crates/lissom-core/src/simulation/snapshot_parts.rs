//! What a workspace has learned from step to step, taken out of it and put back.

use lissom_solver::FactorError;
use serde::{Deserialize, Serialize};

use crate::integrator::anderson::Anderson;
use crate::integrator::predictor::Predictor;
use crate::integrator::workspace::{Effort, Workspace};
use crate::saddle_point;
use crate::system::System;

/// All that outlives a step besides the state.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Learned {
    predictors: [Predictor; 2],
    anderson: Anderson,
    effort: Effort,
    backed_off: bool,
    tangent: saddle_point::Learned,
    force_round_off: f64,
}

impl Workspace {
    pub(crate) fn learned(&self) -> Learned {
        Learned {
            predictors: self.predictors.clone(),
            anderson: self.anderson.clone(),
            effort: self.effort,
            backed_off: self.backed_off,
            tangent: self.tangent.learned(),
            force_round_off: self.force_round_off,
        }
    }

    /// Puts back what was learned, and factors the tangent again.
    ///
    /// # Errors
    /// If a tangent cannot be factored: it is not the one that was taken.
    pub(crate) fn restore(&mut self, system: &System, from: &Learned) -> Result<(), FactorError> {
        for (guess, learned) in self.predictors.iter_mut().zip(&from.predictors) {
            guess.restore(learned);
        }
        self.anderson.restore(&from.anderson);
        self.effort = from.effort;
        self.backed_off = from.backed_off;
        self.force_round_off = from.force_round_off;
        self.tangent.restore(system.structure(), &from.tangent)
    }
}
