//! Positions at which a model turns steadily.

use lissom_core::linearized::{LinearModel, steady};
use lissom_core::settings::Settings;
use lissom_core::system::{State, System};
use lissom_model::Problem;
use lissom_model::document::Document;

/// A rotation whose twists change by more, relative to the square of its rate, is not steady.
const STEADY: f64 = 1e-5;

/// Moves positions to where the model keeps turning with the velocities that it has.
pub(super) fn steady_rotation(
    document: &Document,
    system: &System,
    state: &State,
    settings: &Settings,
) -> Result<State, Problem> {
    let refused = |words: String| {
        let help = "give all parts the angular velocity of one rotation by `[initial]`, without gravity or loads across \
                    its axis, or leave out `steady_rotation`";
        Problem::error(document.analysis.span, words).help(help)
    };
    let mut turning = steady(system, state, settings.solver).map_err(|error| refused(error.to_string()))?;
    let model =
        LinearModel::of(system, &turning, settings.solver).map_err(|error| refused(error.to_string()))?;
    // Loads at rest in space can be balanced at one angle, and are not at another.
    let later = model.turned().map_err(|error| refused(error.to_string()))?;
    let unsteadiness = model.unsteadiness().max(later.unsteadiness());
    if unsteadiness > STEADY {
        return Err(refused(format!(
            "the velocities at the start are no steady rotation: in the axes of the nodes they change by {unsteadiness:.1e} \
             of their squares"
        )));
    }
    // A run finds its own.
    turning.multipliers.fill(0.0);
    turning.position_remainders.clone_from(&state.position_remainders);
    Ok(turning)
}
