//! A model without its gravity and loads.

use lissom_mechanics::elements::LOADS;
use lissom_mechanics::registry::{ParameterType, Value};

use super::{AnalysisKind, Document};

impl Document {
    /// This model without gravity, forces per length of beams, pressures and forces per area, and sizes of loads.
    /// Loads remain with size zero, so that outputs and inputs can refer to them and the pattern of the matrices is the same.
    /// Entries without a size are unchanged: the spin of a gyrostat is not an applied load.
    #[must_use]
    pub fn without_loads(&self) -> Self {
        let mut document = self.clone();
        document.gravity.fill(0.0);
        for beam in &mut document.beams {
            beam.distributed.clear();
        }
        // The elements between the nodes have the pattern of a pressure.
        document.shells.iter_mut().for_each(|shell| shell.loads.clear());
        document.elastic_solids.iter_mut().for_each(|solid| solid.pressures.clear());
        for load in &mut document.loads {
            let kind = LOADS.iter().find(|kind| kind.name == load.kind.value);
            let sizes = kind.into_iter().flat_map(|kind| kind.parameters);
            for size in sizes.filter(|parameter| parameter.holds == ParameterType::Size) {
                load.parameters.insert(size.name, Value::Number(0.0));
                load.signal = None;
            }
        }
        document
    }

    /// This model with the loads of one instant: those at the end of load steps, where constant loads have grown to their full size.
    #[must_use]
    pub fn under_full_loads(&self) -> Self {
        let mut document = self.clone();
        if matches!(document.analysis.kind, AnalysisKind::Statics { .. }) {
            document.analysis.start = document.analysis.end;
            document.analysis.end += 1.0;
            document.analysis.ramp = false;
        }
        document
    }
}
