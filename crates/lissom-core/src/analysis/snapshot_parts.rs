//! What a workspace has learned from step to step, taken out of it and put back.

use lissom_solver::FactorError;
use serde::{Deserialize, Serialize};

use super::anderson::Anderson;
use super::predictor::Predictor;
use super::regularization::Regularization;
use super::tangent_numbers::TangentNumbers;
use super::workspace::{Effort, Workspace};
use crate::system::System;

/// All that outlives a step besides the state.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Learned {
    predictors: [Predictor; 2],
    is_miss_known: bool,
    anderson: Anderson,
    effort: Effort,
    backed_off: bool,
    /// The tangent factored last, if any was, and what belongs to it.
    tangent: Option<Vec<TangentNumbers>>,
    equilibration: Option<Vec<f64>>,
    force_round_off: f64,
    regularization: Option<(Regularization, usize)>,
    fell_back: Option<(usize, f64)>,
}

impl Workspace {
    pub(crate) fn learned(&self) -> Learned {
        Learned {
            predictors: self.predictors.clone(),
            is_miss_known: self.is_miss_known,
            anderson: self.anderson.clone(),
            effort: self.effort,
            backed_off: self.backed_off,
            tangent: self.report.as_ref().map(|_| self.factorization.numbers()),
            equilibration: self.equilibration.as_ref().map(|found| found.factors().to_vec()),
            force_round_off: self.force_round_off,
            regularization: self.regularization.clone(),
            fell_back: self.fell_back,
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
        self.is_miss_known = from.is_miss_known;
        self.anderson.restore(&from.anderson);
        self.effort = from.effort;
        self.backed_off = from.backed_off;
        if let (Some(equilibration), Some(factors)) = (&mut self.equilibration, &from.equilibration) {
            equilibration.set_factors(factors);
        }
        self.force_round_off = from.force_round_off;
        self.regularization.clone_from(&from.regularization);
        if from.fell_back.is_some() && self.fell_back.is_none() {
            let pivoting = lissom_solver::kind("pivoting").unwrap_or(self.solver);
            self.factorization.replace_solver(self.fall_back.take().unwrap_or(pivoting), system.structure());
        }
        self.fell_back = from.fell_back;
        self.report = None;
        if let Some(tangent) = &from.tangent {
            self.factorization.set_numbers(tangent);
            self.report = Some(self.factorization.factor()?);
        }
        Ok(())
    }
}
