//! Units of other programs in a graph of signals: where their inputs are from, and what their outputs are.

use std::ops::Range;
use std::sync::Arc;

use super::{DiscreteValueId, Graph, SignalId};
use crate::kinematics::{CoordinateId, Kinematics};
use crate::units::{GroupPoint, UnitFault, UnitPoint, UnitValues};

/// A unit in a graph of signals.
#[derive(Clone, Debug)]
pub struct UnitPorts {
    /// Name of the unit.
    pub name: String,
    /// How it is connected.
    pub coupling: Coupling,
}

/// How a unit is connected to signals.
#[derive(Clone, Debug)]
pub enum Coupling {
    /// By samples.
    Sampled(SampledPorts),
    /// By its equations.
    Equations(EquationPorts),
}

/// Held values that are inputs and outputs of a unit.
#[derive(Clone, Debug)]
pub struct SampledPorts {
    /// Time from sample to sample, from the start of the simulation [s].
    pub period: f64,
    /// Inputs: samples of signals.
    pub inputs: Vec<DiscreteValueId>,
    /// Outputs, which are among the readings, with their names.
    pub outputs: Vec<(DiscreteValueId, String)>,
}

/// States, inputs and event indicators of a unit with equations. Its outputs are signals.
#[derive(Clone, Debug)]
pub struct EquationPorts {
    /// States.
    pub states: Vec<CoordinateId>,
    /// Signals that are its inputs.
    pub inputs: Vec<SignalId>,
    /// Events that are its indicators.
    pub indicators: Range<usize>,
}

/// A value of a unit with equations, as a function of its states and the inputs of the value's group.
#[derive(Clone, Copy, Debug)]
pub struct UnitValue {
    /// Index of the unit.
    pub unit: usize,
    /// The group.
    pub group: usize,
    /// Index among the values of the group.
    pub index: usize,
}

impl UnitPorts {
    /// Samples of the unit, if it is sampled.
    pub fn sampled(&self) -> Option<&SampledPorts> {
        match &self.coupling {
            Coupling::Sampled(ports) => Some(ports),
            Coupling::Equations(_) => None,
        }
    }

    /// Equations of the unit, if it has these.
    pub fn equations(&self) -> Option<&EquationPorts> {
        match &self.coupling {
            Coupling::Sampled(_) => None,
            Coupling::Equations(ports) => Some(ports),
        }
    }

    /// Inputs at a configuration.
    pub fn inputs(&self, graph: &Graph, at: &Kinematics) -> Vec<f64> {
        match &self.coupling {
            Coupling::Sampled(ports) => ports.inputs.iter().map(|input| at.held[input.index()]).collect(),
            Coupling::Equations(ports) => ports.inputs_at(graph, at),
        }
    }

    /// Sets outputs of a sampled unit, or states of another one.
    ///
    /// # Errors
    /// If an output is not finite.
    pub fn set(&self, values: &[f64], at: &mut Kinematics) -> Result<(), UnitFault> {
        match &self.coupling {
            Coupling::Sampled(ports) => {
                let wrong = ports.outputs.iter().zip(values).find(|(_, value)| !value.is_finite());
                if let Some(((_, name), value)) = wrong {
                    let cause = format!("its output `{name}` is {value}");
                    let remedy = "look for the cause in its inputs and parameters".to_owned();
                    return Err(UnitFault { cause, remedy });
                }
                for ((output, _), value) in ports.outputs.iter().zip(values) {
                    at.held[output.index()] = *value;
                }
            }
            Coupling::Equations(ports) => {
                for (&state, value) in ports.states.iter().zip(values) {
                    at.coordinates[state].value = *value;
                }
            }
        }
        Ok(())
    }
}

impl EquationPorts {
    fn inputs_at(&self, graph: &Graph, at: &Kinematics) -> Vec<f64> {
        graph.evaluate(at, |values| self.inputs.iter().map(|input| values[input.index()]).collect())
    }

    /// Time, states and inputs at a configuration.
    pub fn point(&self, graph: &Graph, at: &Kinematics) -> UnitPoint {
        let states = self.states.iter().map(|&state| at.coordinates[state].value).collect();
        UnitPoint { time: at.time, states, inputs: self.inputs_at(graph, at) }
    }
}

impl UnitValue {
    /// The value at a configuration, at which the unit runs.
    pub(super) fn value(self, at: &Kinematics, arguments: &[f64]) -> f64 {
        match self.group_at(at, arguments, false) {
            Ok(found) => found.values[self.index],
            Err(instead) => instead,
        }
    }

    /// Derivatives with respect to the arguments.
    pub(super) fn gradient(self, at: &Kinematics, arguments: &[f64], out: &mut [f64]) {
        let count = arguments.len();
        match self.group_at(at, arguments, true) {
            Ok(found) => out.copy_from_slice(&found.derivatives[self.index * count..][..count]),
            Err(instead) => out.fill(instead),
        }
    }

    /// The values of the group; instead of them zero without a running unit, and NaN where it returns none.
    fn group_at(
        self,
        at: &Kinematics,
        arguments: &[f64],
        differentiates: bool,
    ) -> Result<Arc<UnitValues>, f64> {
        let unit = at.units.get(self.unit).ok_or(0.0)?;
        let point = GroupPoint { group: self.group, time: at.time, arguments };
        unit.evaluate(point, differentiates).ok_or(f64::NAN)
    }
}
