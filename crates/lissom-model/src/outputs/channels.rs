//! What is recorded: named columns, evaluated from a system and its state.

use std::sync::Arc;

use lissom_system::Need;
use lissom_system::OutputDerivatives;
use lissom_system::{State, System};

use crate::outputs::differences;
use crate::outputs::kinds::{Feature, OutputKind};
use crate::outputs::{Evaluation, OutputQuantity};
use crate::sweep::Fatigue;

pub use crate::outputs::signal::signal_value;

/// One output: a name, its components, and how they are found.
#[derive(Clone)]
pub struct Channel {
    /// Name in the model.
    pub name: String,
    /// What it is.
    pub kind: OutputKind,
    /// Components, as `u1`.
    pub components: Vec<String>,
    /// Unit of all components, or of each where they differ.
    pub units: Vec<String>,
    /// The plot in which it is drawn, if it is not its own.
    pub plot: Option<String>,
    /// How its cycles are counted, if they are.
    pub fatigue: Option<Fatigue>,
    pub(crate) quantity: Arc<dyn OutputQuantity>,
}

impl Channel {
    /// Appends the components' values.
    pub fn evaluate(&self, system: &System, state: &State, out: &mut Vec<f64>) {
        self.quantity.append_values(&Evaluation { system, state }, out);
    }

    /// Whether it, or an output in its formula, has this feature. A signal is what acts, whatever it consists of.
    fn has(&self, feature: Feature) -> bool {
        let of_arguments = self.quantity.arguments().iter().any(|(channel, _)| channel.has(feature));
        self.kind.has(feature) || of_arguments
    }

    /// What has to be recovered from the positions before it is evaluated.
    pub fn need(&self) -> Need {
        if self.has(Feature::Accelerations) || self.reports_internal_forces() {
            Need::Forces
        } else if self.has(Feature::Velocities) {
            Need::Velocities
        } else {
            Need::Positions
        }
    }

    /// What has to be recovered from the positions before one of its components is evaluated.
    pub fn need_of(&self, component: usize) -> Need {
        if self.quantity.is_of_positions(component) { Need::Positions } else { self.need() }
    }

    /// Whether it reports forces of springs or within beams.
    pub fn reports_internal_forces(&self) -> bool {
        self.has(Feature::InternalForces)
    }

    /// Column names, as `midspan.u1`.
    pub fn columns(&self) -> impl Iterator<Item = String> + '_ {
        self.components.iter().map(|component| format!("{}.{component}", self.name))
    }
}

impl Channel {
    /// Derivatives of its components by positions, velocities, accelerations, multipliers and held values at a state; exact
    /// where there are formulas, otherwise by differences. `length` [m] is of the size of the model.
    pub fn derivatives_at(
        &self,
        system: &System,
        state: &State,
        length: f64,
    ) -> Option<Vec<OutputDerivatives>> {
        let at = Evaluation { system, state };
        let by_differences = || differences::of(self, &at, length);
        self.quantity.derivatives(&at, length).or_else(by_differences)
    }
}
