//! Natural modes for a page: the tables of `lissom modes`, read back.

use serde::Serialize;

/// A mode for pictures.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Mode {
    pub(crate) name: String,
    /// Frequency [Hz].
    pub(crate) frequency: f64,
    /// Damping ratio [-].
    damping: f64,
    /// Kind, such as `oscillation`.
    kind: String,
    /// Displacement [m] and rotation [rad] of every node except the ground, concatenated.
    pub(crate) real: Vec<f32>,
    /// Imaginary parts; empty where there are none.
    pub(crate) imaginary: Vec<f32>,
}

/// Reads `modes.csv` and `shapes.csv` of a model with this number of nodes, the ground included; none if they are
/// invalid.
pub(crate) fn read(modes: &str, shapes: &str, nodes: usize) -> Option<Vec<Mode>> {
    let mut rows = shapes.lines();
    let is_complex = rows.next()?.ends_with("_im");
    let columns = if is_complex { 15 } else { 9 };
    let mut found = Vec::new();
    for line in modes.lines().skip(1) {
        let mut fields = line.split(',').skip(1);
        let mut number = || fields.next()?.parse::<f64>().ok();
        let (frequency, damping) = (number()?, number()?);
        let kind = fields.next()?.to_owned();
        let (mut real, mut imaginary) = (Vec::new(), Vec::new());
        for _ in 1..nodes {
            // Names of nodes are first and may contain commas: numbers are counted from the end.
            let numbers: Option<Vec<f32>> =
                rows.next()?.rsplitn(columns + 1, ',').take(columns).map(|text| text.parse().ok()).collect();
            let mut numbers = numbers.filter(|numbers| numbers.len() == columns)?;
            numbers.reverse();
            real.extend_from_slice(&numbers[3..9]);
            imaginary.extend_from_slice(&numbers[9..]);
        }
        found.push(Mode { name: String::new(), frequency, damping, kind, real, imaginary });
    }
    rows.next().is_none().then_some(found)
}
