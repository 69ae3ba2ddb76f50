//! A straight blade of a wind turbine from a table of third parties, as sections and one beam of a model file. Knows
//! the layout of that table: the axis z along the blade, matrices diagonal, sections turned by minus the twist, which
//! is in degrees.

use std::fmt::Write as _;
use std::path::Path;

use serde::Deserialize;

/// The table, by stations.
#[derive(Deserialize)]
struct Table {
    reference_axis: Axes,
    twist: Profile,
    grid: Vec<f64>,
    #[serde(rename = "K11")]
    k11: Vec<f64>,
    #[serde(rename = "K22")]
    k22: Vec<f64>,
    #[serde(rename = "K33")]
    k33: Vec<f64>,
    #[serde(rename = "K44")]
    k44: Vec<f64>,
    #[serde(rename = "K55")]
    k55: Vec<f64>,
    #[serde(rename = "K66")]
    k66: Vec<f64>,
    mass: Vec<f64>,
    i_edge: Vec<f64>,
    i_flap: Vec<f64>,
    i_plr: Vec<f64>,
}

#[derive(Deserialize)]
struct Axes {
    x: Profile,
    y: Profile,
    z: Profile,
}

/// Values over the fraction of the length, linear between.
#[derive(Deserialize)]
struct Profile {
    grid: Vec<f64>,
    values: Vec<f64>,
}

/// Sections `s0`, `s1` … and the beam `blade` of `elements` elements, as text to be followed by a model's tables.
/// The blade's axes: 1 along z, 2 along x, 3 along y.
pub(crate) fn tables(path: &Path, elements: usize) -> Result<String, String> {
    let failure = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    let text = std::fs::read_to_string(path).map_err(|error| failure(&error))?;
    let table: Table = serde_json::from_str(&text).map_err(|error| failure(&error))?;
    if table.reference_axis.x.values.iter().chain(&table.reference_axis.y.values).any(|value| *value != 0.0) {
        return Err(failure(&"the blade is not straight"));
    }
    let length = table.reference_axis.z.values.last().copied().ok_or_else(|| failure(&"it has no axis"))?;
    let mut out = String::new();
    let mut stations = Vec::new();
    for (k, at) in table.grid.iter().enumerate() {
        let stiffness = [&table.k33, &table.k11, &table.k22, &table.k66, &table.k44, &table.k55]
            .map(|column| column.get(k));
        let inertia = [&table.i_plr, &table.i_edge, &table.i_flap].map(|column| column.get(k));
        let numbers = |list: &[Option<&f64>]| {
            let list: Option<Vec<String>> =
                list.iter().map(|value| value.map(|value| format!("{value:?}"))).collect();
            list.map(|list| list.join(", ")).ok_or_else(|| failure(&"its columns differ in length"))
        };
        let _ = writeln!(
            out,
            "[sections.s{k}]\nshape = \"general\"\nstiffness = [{}]\nmass = {{ per_length = {}, inertia = [{}] }}\n",
            numbers(&stiffness)?,
            numbers(&[table.mass.get(k)])?,
            numbers(&inertia)?,
        );
        stations.push(format!("{{ at = {at:?}, section = \"s{k}\" }}"));
    }
    let _ = writeln!(
        out,
        "[beams.blade]\nfrom = [0, 0, 0]\nto = [0, 0, {length:?}]\nelements = {elements}\nup = [0, 1, 0]\n\
         twist = \"-({})*pi/180\"\nstations = [{}]\n",
        piecewise(&table.twist),
        stations.join(", ")
    );
    Ok(out)
}

/// A piecewise linear profile as an expression of `s`: a line, and a kink at every inner point.
fn piecewise(profile: &Profile) -> String {
    let slope =
        |k: usize| (profile.values[k + 1] - profile.values[k]) / (profile.grid[k + 1] - profile.grid[k]);
    let first = profile.values.first().copied().unwrap_or(0.0);
    let count = profile.grid.len().min(profile.values.len());
    let mut text = format!("{first:?}");
    let mut before = 0.0;
    for k in 0..count.saturating_sub(1) {
        let change = slope(k) - before;
        before = slope(k);
        let _ = write!(text, "+({change:?})*max(s-({:?}), 0)", profile.grid[k]);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_profile_becomes_an_expression_through_its_points() {
        let profile = Profile { grid: vec![0.0, 0.25, 1.0], values: vec![0.5, 1.0, -2.0] };
        let expression = lissom_model::expression::Expression::parse(
            &piecewise(&profile),
            Some("s"),
            &std::collections::BTreeMap::default(),
        )
        .unwrap();
        for (at, value) in [(0.0, 0.5), (0.25, 1.0), (0.625, -0.5), (1.0, -2.0)] {
            assert!((expression.jet(at).value - value).abs() < 1e-14);
        }
    }
}
