//! Outputs that sampled signals read at samples: channels become quantities of the state.

use std::sync::Arc;

use lissom_mechanics::signals::DiscreteValueId;
use lissom_system::{Quantity, Reading, State, System};

use super::signal_references::NamedComponent;
use crate::format::suggest;
use crate::output::component::component_position;
use crate::outputs::channels::Channel;
use crate::text::report::Problem;

/// A component of a channel.
struct ChannelQuantity {
    channel: Channel,
    component: usize,
    /// How many numbers the model accumulates.
    accumulated: usize,
}

impl Quantity for ChannelQuantity {
    fn value(&self, system: &System, state: &State) -> f64 {
        let mut values = Vec::new();
        if state.accumulated.len() < self.accumulated {
            // Before the first step nothing is accumulated.
            let state = State { accumulated: vec![0.0; self.accumulated], ..state.clone() };
            self.channel.evaluate(system, &state, &mut values);
        } else {
            self.channel.evaluate(system, state, &mut values);
        }
        values.get(self.component).copied().unwrap_or(f64::NAN)
    }
}

/// The readings that signals name, from all channels of the model.
pub(super) fn bind(
    named: &[NamedComponent<DiscreteValueId>],
    channels: &[Channel],
    accumulated: usize,
    problems: &mut Vec<Problem>,
) -> Vec<Reading> {
    let mut readings = Vec::new();
    for NamedComponent { target: held, output, component, place, reader } in named {
        // An output without a channel has its own problem.
        let Some(channel) = channels.iter().find(|channel| channel.name == *output) else { continue };
        let known = || channel.components.iter().map(String::as_str);
        let Some(component) = component_position(known(), component) else {
            let message = format!("{reader} cannot be read: `{output}` has no component `{component}`");
            let help = suggest::help(component, known());
            problems.push(Problem::error(*place, message).label("here").maybe_help(help));
            continue;
        };
        let quantity = Arc::new(ChannelQuantity { channel: channel.clone(), component, accumulated });
        readings.push(Reading { held: *held, quantity });
    }
    readings
}
