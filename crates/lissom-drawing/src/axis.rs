//! Axes: their ranges and ticks.

/// Largest extent of values that are constant except for round-off, relative to their size.
const ROUND_OFF: f64 = 1e-10;

/// Division of an axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scale {
    /// Evenly.
    #[default]
    Linear,
    /// By decades; only positive numbers have a position.
    Logarithmic,
}

/// An axis of a panel.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Axis {
    /// Quantity and unit.
    pub label: String,
    /// Division of the axis.
    pub scale: Scale,
    /// Range of the axis; by default that of the curves with a margin.
    pub range: Option<[f64; 2]>,
}

impl Axis {
    /// A linear axis.
    pub fn new(label: &str) -> Self {
        Self { label: label.to_owned(), ..Self::default() }
    }

    /// A logarithmic axis.
    pub fn logarithmic(label: &str) -> Self {
        Self { scale: Scale::Logarithmic, ..Self::new(label) }
    }

    /// Whether a number has a position.
    pub(crate) fn shows(&self, number: f64) -> bool {
        number.is_finite() && (self.scale == Scale::Linear || number > 0.0)
    }

    /// The range of numbers with a position, of which there is at least one.
    pub(crate) fn extent(&self, numbers: impl Iterator<Item = f64>, room: f64) -> [f64; 2] {
        if let Some([from, to]) = self.range.filter(|[from, to]| from < to) {
            return [from, to];
        }
        let (low, high) =
            numbers.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        if self.scale == Scale::Logarithmic {
            let [low, high] = [low.log10().floor(), high.log10().ceil()];
            return [10.0_f64.powf(low), 10.0_f64.powf(if high > low { high } else { low + 1.0 })];
        }
        let extent = high - low;
        // The axis of a constant would have zero length, and that of its round-off would enlarge it.
        let room = match (extent > ROUND_OFF * high.abs().max(low.abs()), high == 0.0) {
            (true, _) => room * extent,
            (false, true) => 1.0,
            (false, false) => 0.1 * high.abs(),
        };
        [low - room, high + room]
    }

    /// Fraction of the axis before a number.
    pub(crate) fn share(&self, [from, to]: [f64; 2], number: f64) -> f64 {
        match self.scale {
            // Halves, so that the largest numbers do not overflow.
            Scale::Linear => (0.5 * number - 0.5 * from) / (0.5 * to - 0.5 * from),
            Scale::Logarithmic => (number / from).ln() / (to / from).ln(),
        }
    }

    /// Numbers with a tick and their labels; at most `most` of them have one.
    pub(crate) fn ticks(&self, range: [f64; 2], most: usize) -> Vec<(f64, String)> {
        match self.scale {
            Scale::Linear => linear(range, most),
            Scale::Logarithmic => decades(range, most),
        }
    }
}

fn linear([from, to]: [f64; 2], most: usize) -> Vec<(f64, String)> {
    let rough = (to / most.max(1) as f64) - from / most.max(1) as f64;
    let power = 10.0_f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0]
        .map(|digit| digit * power)
        .into_iter()
        .find(|step| *step >= rough * (1.0 - 1e-9));
    let step = step.unwrap_or(rough);
    if !(step.is_finite() && step > 0.0) {
        return Vec::new();
    }
    let (first, last) = ((from / step - 1e-6).ceil(), (to / step + 1e-6).floor());
    // Digits after the point, or of the mantissa for very large or small numbers.
    let largest = (first.abs().max(last.abs()) * step).max(f64::MIN_POSITIVE);
    let decimals = (-(step.log10() + 1e-9).floor()).max(0.0) as usize;
    let is_plain = largest < 1e5 && decimals <= 5;
    let digits = (largest.log10().floor() - (step.log10() + 1e-9).floor()).clamp(0.0, 15.0) as usize;
    let text = |number: f64| {
        if number == 0.0 {
            "0".to_owned()
        } else if is_plain {
            format!("{number:.decimals$}")
        } else {
            let below = (largest.log10().floor() - number.abs().log10().floor()).max(0.0) as usize;
            format!("{number:.*e}", digits.saturating_sub(below))
        }
    };
    let count = (last - first).clamp(0.0, 1000.0) as usize;
    (0..=count)
        .map(|k| {
            let number = (first + k as f64) * step;
            let number = if number.abs() < 1e-9 * step { 0.0 } else { number };
            (number, text(number))
        })
        .collect()
}

/// Every decade, or every n-th; if there are few, halves and fifths of them as well.
fn decades([from, to]: [f64; 2], most: usize) -> Vec<(f64, String)> {
    let (first, last) = (from.log10() - 1e-9, to.log10() + 1e-9);
    let count = (last - first).floor().max(0.0) as usize + 1;
    let stride = i32::try_from(count.div_ceil(most.max(2))).unwrap_or(i32::MAX);
    let digits: &[u8] = if count <= 2 { &[1, 2, 5] } else { &[1] };
    let mut ticks = Vec::new();
    for decade in first.floor() as i32..=last.floor() as i32 {
        for digit in digits {
            let exponent = f64::from(decade) + f64::from(*digit).log10();
            if exponent >= first && exponent <= last && decade.rem_euclid(stride) == 0 {
                let text = if decade.abs() <= 3 {
                    format!("{}", f64::from(*digit) * 10.0_f64.powi(decade))
                } else {
                    format!("{digit}e{decade}")
                };
                ticks.push((10.0_f64.powf(exponent), text));
            }
        }
    }
    ticks
}

#[cfg(test)]
#[path = "../tests/unit/axis.rs"]
mod tests;
