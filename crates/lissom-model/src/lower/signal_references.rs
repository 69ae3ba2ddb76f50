//! What expressions of signals name, while the model is lowered.

use std::collections::BTreeMap;

use lissom_mechanics::kinematics::CoordinateId;
use lissom_mechanics::signals::{Argument, DiscreteValueId, MeasurementId, SignalId};

use crate::text::report::Span;

/// A component of an output that a signal names before it exists, and the argument `target` that it becomes.
#[derive(Clone)]
pub(super) struct NamedComponent<Target> {
    pub(super) target: Target,
    pub(super) output: String,
    pub(super) component: String,
    /// Where it is named, and by what.
    pub(super) place: Span,
    pub(super) reader: String,
}

/// What expressions of signals name besides signals, inputs and states.
#[derive(Clone, Default)]
pub(super) struct SignalReferences {
    /// Values of sampled signals between samples.
    pub(super) samples: BTreeMap<String, DiscreteValueId>,
    /// Signals that are straight lines of time, a + b t.
    pub(super) lines_of_time: BTreeMap<SignalId, (f64, f64)>,
    /// Components of outputs and of joints' coordinates, by the names they are written with and whether the signals are sampled.
    pub(super) measured: BTreeMap<(String, bool), Argument>,
    /// Measured components of elements, which are added after signals.
    pub(super) later_measurements: Vec<NamedComponent<MeasurementId>>,
    /// Measured components that are read at samples.
    pub(super) readings: Vec<NamedComponent<DiscreteValueId>>,
    /// Outputs that are expressions and are being resolved, each named by the one before.
    pub(super) open_expressions: Vec<String>,
    /// Units with equations.
    pub(super) units: BTreeMap<String, AddedUnit>,
}

/// A unit with equations, as far as it is added.
#[derive(Clone)]
pub(super) struct AddedUnit {
    /// Index among all units.
    pub(super) index: usize,
    /// States.
    pub(super) states: Vec<CoordinateId>,
    /// The states as arguments of its values.
    pub(super) arguments: Vec<Argument>,
    /// Signals that are its inputs; none before they are added.
    pub(super) inputs: Vec<Option<SignalId>>,
    /// For each group its signals; none before they are added, and while they are.
    pub(super) groups: Vec<Option<Vec<SignalId>>>,
    /// Groups whose inputs are being added.
    pub(super) open: Vec<usize>,
}
