//! The recovery matrix: outputs of the reduced parts over the unknowns of the superelement.
//!
//! A row is the derivative of a component by the unknowns that are reduced, times their displacements for each unknown of the superelement:
//! what the output changes by from the state of the reduction, in axes that move with the floating frame.

use lissom_core::linearized::Reduction;
use lissom_core::system::{State, System};
use lissom_model::channels::Channel;

use super::{ReduceError, question};

/// Kinds of outputs that are linear in the displacements of the reduced parts, except for components with these words.
const LINEAR: [&str; 7] = [
    "displacement",
    "section_force",
    "section_moment",
    "shell_force",
    "shell_moment",
    "shell_stress",
    "solid_stress",
];
const NOT_LINEAR: [&str; 3] = ["error", "mises", "principal"];

/// Rows of the matrix.
pub(super) struct Recovery {
    /// Names of the components, with their units.
    pub(super) names: Vec<(String, String)>,
    /// Values by column.
    pub(super) rows: Vec<Vec<f64>>,
}

impl Recovery {
    /// All linear components of the channels.
    pub(super) fn of(
        channels: &[Channel],
        (system, state): (&System, &State),
        reduction: &Reduction,
    ) -> Result<Self, ReduceError> {
        let (mut names, mut rows) = (Vec::new(), Vec::new());
        let places = state.kinematics.nodes.iter().skip(1).map(|node| node.frame.position);
        let origin = places.clone().next().unwrap_or_default();
        let length = places.map(|own| (own - origin).norm()).fold(0.0, f64::max);
        for channel in channels {
            let name = &channel.name;
            if !LINEAR.contains(&channel.kind.name()) {
                return question(format!(
                    "the output `{name}` cannot be recovered: only those of kind {} can",
                    LINEAR.join(", ")
                ));
            }
            let Some(found) = channel.derivatives_at(system, state, length) else {
                return question(format!(
                    "the output `{name}` has no derivatives, so that it cannot be recovered"
                ));
            };
            for (index, (own, component)) in found.iter().zip(&channel.components).enumerate() {
                if NOT_LINEAR.iter().any(|word| component.contains(word)) {
                    continue;
                }
                let others = [&own.by_rate, &own.by_acceleration, &own.by_multiplier];
                if others.iter().any(|part| part.values().any(|value| *value != 0.0)) {
                    return question(format!(
                        "the output `{name}` depends on velocities or on forces of joints, and a recovery is of displacements"
                    ));
                }
                let unit = channel.units.get(index).or(channel.units.first()).cloned().unwrap_or_default();
                names.push((format!("{name}.{component}"), unit));
                let value = |column: usize| {
                    own.by_place.iter().map(|(&row, by)| by * reduction.shapes[(row, column)]).sum::<f64>()
                };
                rows.push((0..reduction.shapes.ncols()).map(value).collect::<Vec<f64>>());
            }
        }
        Ok(Self { names, rows })
    }
}
