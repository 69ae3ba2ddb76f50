//! A scene along an equilibrium path, where time represents the length of the path.

use lissom_motion::Vector3;
use serde::{Deserialize, Serialize};

use super::Scene;

/// Lengths at which the size of a load is sampled, less one.
const SAMPLES: u32 = 600;

/// Parameter of an equilibrium path: the load factor, or a number of the model file.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PathValues {
    /// `load factor`, or the path to the number.
    pub name: String,
    /// Length of the path at every equilibrium [-], ascending from zero.
    pub lengths: Vec<f64>,
    /// Value of the parameter at every equilibrium.
    pub values: Vec<f64>,
}

impl PathValues {
    /// No values yet, for the parameter of this name.
    pub fn new(name: &str) -> Self {
        Self { name: name.to_owned(), ..Self::default() }
    }

    /// Adds an equilibrium.
    pub fn push(&mut self, length: f64, value: f64) {
        self.lengths.push(length);
        self.values.push(value);
    }

    /// The value at a length, straight between equilibria; that of the nearest one outside of the path, zero without any.
    pub fn at(&self, length: f64) -> f64 {
        let next = self.lengths.partition_point(|known| *known < length);
        let Some(end) = self.lengths.get(next) else { return self.values.last().copied().unwrap_or(0.0) };
        let Some(before) = next.checked_sub(1) else { return self.values[0] };
        let start = self.lengths[before];
        let share = if *end > start { (length - start) / (end - start) } else { 1.0 };
        (1.0 - share) * self.values[before] + share * self.values[next]
    }
}

impl Scene {
    /// This scene along an equilibrium path. With `scales_loads` loads are those at the start of the analysis times the
    /// values, which then are load factors; without, loads and stiffnesses may depend on the values and are omitted.
    #[must_use]
    pub fn along(mut self, path: PathValues, scales_loads: bool) -> Self {
        let length = path.lengths.last().copied().unwrap_or(0.0);
        // Pictures divide by the length of their range.
        (self.start, self.end) = (0.0, if length > 0.0 { length } else { 1.0 });
        if scales_loads {
            let factors: Vec<f64> =
                (0..=SAMPLES).map(|k| path.at(self.end * f64::from(k) / f64::from(SAMPLES))).collect();
            self.scale_loads(&factors);
        } else {
            self.loads.clear();
            self.beam_loads.clear();
            self.beams
                .iter_mut()
                .flat_map(|beam| &mut beam.stations)
                .for_each(|station| station.stiffness.clear());
        }
        self.path = Some(path);
        self
    }

    /// Loads of these factors, at equal distances, times their first size.
    fn scale_loads(&mut self, factors: &[f64]) {
        for load in &mut self.loads {
            if let Some(first) = load.scale.first().copied() {
                load.scale = factors.iter().map(|factor| factor * first).collect();
            }
        }
        for load in &mut self.beam_loads {
            if let Some(first) = load.vectors.first().cloned() {
                let times =
                    |factor: &f64| first.iter().map(|v| (Vector3::from(*v) * *factor).into()).collect();
                load.vectors = factors.iter().map(times).collect();
            }
        }
    }
}

#[cfg(test)]
#[path = "../../tests/unit/scene/path_values.rs"]
mod tests;
