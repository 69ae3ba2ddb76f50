//! Two methods for the derivatives of a state: direct differentiation along the steps, with derivatives as linear unknowns,
//! or differences of two neighbouring models with the same steps.

use lissom_core::differentiation::Sensitivities;
use lissom_core::simulation::Simulation;
use lissom_core::system::State;
use lissom_model::Document;
use lissom_model::numbers::number_at;

use super::{GradientError, Target, prepared};
use crate::model_text::Model;
use crate::session::{Observed, Session};

/// Relative change of the number in neighbouring models with the same steps. The error of central differences is proportional
/// to its square, and to the round-off of a solution over it.
const APART: f64 = 1e-4;
/// Relative change for comparing initial states and direct effects of the number only, with differences of fourth order: at such
/// a large distance round-off is small.
const AROUND: f64 = 2e-3;
/// Relative change for differences of second order, if models at the larger distance do not exist.
const NEAR: f64 = 3e-5;
/// The largest displacement of a state over which a column is differentiated [-, rad], the ratio to the next one, and their
/// number.
const MAX_DISPLACEMENT: f64 = 1e-3;
const SMALLER: f64 = 0.125;
const TRIED: i32 = 5;
/// A step that is shorter than the others by more than this fraction has a different size.
const WHOLE: f64 = 1e-9;

/// Breakpoints closer than this fraction of the run are at the same time.
const SAME_TIME: f64 = 1e-12;

/// The request and its model.
pub(super) struct Question<'a> {
    pub(super) model: &'a Model,
    pub(super) target: &'a Target,
    pub(super) document: &'a Document,
    /// The model at its start.
    pub(super) session: &'a Session,
}

/// Models with a slightly smaller and a slightly larger number, each with its weight in their difference.
struct Neighbours {
    path: String,
    number: f64,
    sensitivity: Sensitivity,
}

/// Method for the derivatives with respect to a number.
enum Sensitivity {
    /// Direct differentiation, with this index; the neighbours are kept for their outputs.
    Direct(usize, Vec<NeighbourOutputs>),
    /// The neighbours perform the steps themselves.
    FiniteDifference(Vec<(Session, f64)>),
}

/// A model with a slightly different number.
struct Neighbour {
    session: Session,
    weight: f64,
    /// Number of the neighbour less that of the model.
    distance: f64,
}

/// Outputs of a neighbour.
struct NeighbourOutputs {
    observed: Observed,
    weight: f64,
    /// Number of the neighbour less that of the model.
    distance: f64,
}

/// All numbers, each with its method.
pub(super) struct ParameterSensitivities {
    numbers: Vec<Neighbours>,
    sensitivities: Option<Sensitivities>,
    corrections: usize,
    /// Storage for displaced states.
    state: State,
}

impl Question<'_> {
    /// The number at `path`.
    pub(super) fn number(&self, path: &str) -> Result<f64, GradientError> {
        if path.split('.').next().is_some_and(|table| table.trim() == "analysis") {
            let words = format!(
                "`{path}` belongs to the analysis, not to the model: outputs have no derivative with respect to it"
            );
            return Err(GradientError::Number(words));
        }
        let number = number_at(self.model.text(), self.model.overrides(), &self.document.parameters, path)
            .map_err(GradientError::Number)?;
        if number == 0.0 {
            let words = format!(
                "the number at `{path}` is zero, so its magnitude is unknown: set it to a small value, or add a parameter to it"
            );
            return Err(GradientError::Number(words));
        }
        Ok(number)
    }

    /// Models around the number at `path`, with the weights of a difference of second or fourth order over this relative
    /// distance.
    fn neighbours(
        &self,
        path: &str,
        number: f64,
        (distance, is_fourth): (f64, bool),
    ) -> Result<Vec<Neighbour>, GradientError> {
        let apart = number * distance;
        let sides: &[(f64, f64)] = if is_fourth {
            &[(-1.0, -8.0 / 12.0), (1.0, 8.0 / 12.0), (-2.0, 1.0 / 12.0), (2.0, -1.0 / 12.0)]
        } else {
            &[(-1.0, -0.5), (1.0, 0.5)]
        };
        let neighbour = |&(side, weight): &(f64, f64)| {
            let changed = self.model.with(path, number + side * apart);
            let neighbour = Session::new(&prepared(&changed, self.target)?)?;
            let unknowns = |session: &Session| {
                let layout = session.simulation().system().layout();
                (layout.coordinate_count(), layout.size(), session.columns().len())
            };
            if unknowns(&neighbour) == unknowns(self.session)
                && neighbour.simulation().system().pattern() == self.session.simulation().system().pattern()
            {
                match self.moved_kink(&neighbour) {
                    Some(time) => Err(GradientError::KinkMoves { path: path.to_owned(), time }),
                    None => {
                        Ok(Neighbour { session: neighbour, weight: weight / apart, distance: side * apart })
                    }
                }
            } else {
                Err(GradientError::Unlike(path.to_owned()))
            }
        };
        sides.iter().map(neighbour).collect()
    }

    /// A time of the run at which functions of time have a kink that a neighbouring model has at another time [s].
    fn moved_kink(&self, neighbour: &Session) -> Option<f64> {
        let plan = self.session.plan();
        let near = SAME_TIME * (plan.end.abs().max(plan.start.abs()) + (plan.end - plan.start));
        let is_within = |time: &f64| (plan.start + near..plan.end - near).contains(time);
        let [own, other] =
            [self.session, neighbour].map(|session| session.simulation().system().breakpoints().into_iter());
        let other: Vec<f64> = other.collect();
        let is_elsewhere = |time: &f64| other.iter().all(|there| (there - time).abs() > near);
        own.filter(is_within).find(is_elsewhere)
    }

    /// Whether all steps have one size, as required by the memory of one-stage schemes.
    fn has_even_steps(&self) -> bool {
        let plan = self.session.plan();
        let size = self.session.simulation().settings().step_size;
        (plan.steps as f64 * size - (plan.end - plan.start)).abs() <= WHOLE * size
    }
}

impl ParameterSensitivities {
    pub(super) fn new(question: &Question<'_>, paths: &[String]) -> Result<Self, GradientError> {
        let base = question.session.simulation();
        let is_even = base.settings().scheme.stages.len() > 1 || question.has_even_steps();
        // Accumulated outputs are not functions of the state: neighbours accumulate their own.
        let is_of_state = base.state().accumulated.is_empty();
        let mut sensitivities = if is_even && is_of_state { Sensitivities::new(base) } else { None };
        let mut count = 0;
        let mut of = |path: &String| {
            let number = question.number(path)?;
            if let Some(sensitivities) = &mut sensitivities {
                // A difference that fails at one distance may succeed at a smaller one.
                let sessions = question
                    .neighbours(path, number, (AROUND, true))
                    .or_else(|_| question.neighbours(path, number, (NEAR, false)))?;
                let simulations: Vec<(&Simulation, f64)> =
                    sessions.iter().map(|near| (near.session.simulation(), near.weight)).collect();
                if sensitivities.add(base, &simulations) {
                    count += 1;
                    let outputs = |Neighbour { session, weight, distance }| NeighbourOutputs {
                        observed: session.into_observed(),
                        weight,
                        distance,
                    };
                    let sensitivity =
                        Sensitivity::Direct(count - 1, sessions.into_iter().map(outputs).collect());
                    return Ok(Neighbours { path: path.clone(), number, sensitivity });
                }
            }
            let sessions = question.neighbours(path, number, (APART, false))?;
            let sessions = sessions.into_iter().map(|near| (near.session, near.weight)).collect();
            let sensitivity = Sensitivity::FiniteDifference(sessions);
            Ok(Neighbours { path: path.clone(), number, sensitivity })
        };
        let numbers = paths.iter().map(&mut of).collect::<Result<Vec<_>, GradientError>>()?;
        Ok(Self { numbers, sensitivities, corrections: 0, state: base.state().clone() })
    }

    /// Repeats the last step of `session`.
    pub(super) fn advance(&mut self, session: &mut Session) -> Result<(), GradientError> {
        let time = session.progress().time;
        let base = session.simulation_mut();
        let is_carried =
            self.numbers.iter().any(|number| matches!(number.sensitivity, Sensitivity::Direct(..)));
        let is_known = match &mut self.sensitivities {
            Some(sensitivities) if is_carried => sensitivities.advance(base)?,
            _ => base.renew_at_solution()?,
        };
        if !is_known {
            return Err(GradientError::InParts(time));
        }
        for Neighbours { sensitivity, .. } in &mut self.numbers {
            let Sensitivity::FiniteDifference(sessions) = sensitivity else { continue };
            for (neighbour, _) in sessions {
                self.corrections += neighbour.simulation_mut().follow(base)?;
            }
        }
        Ok(())
    }

    /// Derivatives of a column with respect to all numbers, at the state of `session`.
    pub(super) fn derivatives(&mut self, session: &Session, column: usize) -> Vec<f64> {
        let Self { numbers, sensitivities, state, .. } = self;
        let base = session.simulation();
        let mut of = |number: &Neighbours| {
            let (index, observed) = match &number.sensitivity {
                Sensitivity::Direct(index, observed) => (*index, observed),
                Sensitivity::FiniteDifference(sessions) => {
                    let of = |(session, weight): &(Session, f64)| {
                        let simulation = session.simulation();
                        weight
                            * session.observed().value(column, simulation.state(), simulation.step_of_rates())
                    };
                    return sessions.iter().map(of).sum();
                }
            };
            let Some(sensitivities) = &*sensitivities else { return f64::NAN };
            // Stiff parts of a neighbour would be strained by its number in the state of the model itself.
            if session.observed().recovers(column) {
                let mut along = |near: &NeighbourOutputs| {
                    sensitivities.displace(base, index, near.distance, state);
                    near.weight * near.observed.value(column, state, base.step_of_rates())
                };
                return observed.iter().map(&mut along).sum();
            }
            // The column itself may depend on the number: by the location and reference of its measurement.
            let of = |near: &NeighbourOutputs| {
                near.weight * near.observed.value(column, base.state(), base.step_of_rates())
            };
            let directly: f64 = observed.iter().map(of).sum();
            let extent = sensitivities.extent(base, index);
            if extent == 0.0 {
                let share = NEAR * number.number;
                return directly + along(session, sensitivities, index, share, column, state);
            }
            let shares = (0..TRIED).map(|k| MAX_DISPLACEMENT / extent * SMALLER.powi(k));
            let found: Vec<f64> =
                shares.map(|share| along(session, sensitivities, index, share, column, state)).collect();
            directly + steadiest(&found)
        };
        numbers.iter().map(&mut of).collect()
    }

    /// Path and value of every number, and whether it was differentiated directly; and the number of corrections.
    pub(super) fn into_numbers(self) -> (Vec<(String, f64, bool)>, usize) {
        let carried = self.sensitivities.as_ref().map_or(0, Sensitivities::corrections);
        let of = |number: Neighbours| {
            (number.path, number.number, matches!(number.sensitivity, Sensitivity::Direct(..)))
        };
        (self.numbers.into_iter().map(of).collect(), self.corrections + carried)
    }
}

/// Derivative of a column along that of the state, as a central difference.
fn along(
    session: &Session,
    sensitivities: &Sensitivities,
    index: usize,
    share: f64,
    column: usize,
    state: &mut State,
) -> f64 {
    let simulation = session.simulation();
    let [below, above] = [-share, share].map(|share| {
        sensitivities.displace(simulation, index, share, state);
        session.observed().value(column, state, simulation.step_of_rates())
    });
    (above - below) / (2.0 * share)
}

/// Selects, of differences over decreasing displacements, the one that differs least from the previous one: the first are
/// inaccurate due to the curvature of the column, the last due to round-off.
fn steadiest(found: &[f64]) -> f64 {
    let pairs = found.windows(2).map(|pair| ((pair[1] - pair[0]).abs(), pair[1]));
    pairs.min_by(|one, other| one.0.total_cmp(&other.0)).map_or(f64::NAN, |(_, value)| value)
}
