//! A blade of a wind turbine from a table of third parties, as sections and one beam of a model file. Knows the two
//! layouts of such tables: the axis z along the blade, sections turned by minus the twist about it, and either diagonal
//! matrices and a twist in degrees, or full matrices and a twist in radians. The axis is a natural cubic spline through
//! the table's points; sections and twist are linear between theirs.

use std::fmt::Write as _;
use std::path::Path;

use serde::Deserialize;

/// A table of either layout.
#[derive(Deserialize)]
#[serde(untagged)]
enum Table {
    Full(Full),
    Diagonal(Diagonal),
}

/// Full matrices, by stations: rows and columns in the order Fx, Fy, Fz, Mx, My, Mz.
#[derive(Deserialize)]
struct Full {
    reference_axis: Axes,
    twist_rad: Profile,
    grid: Vec<f64>,
    stiffness: Vec<Matrix>,
    mass: Vec<Matrix>,
}

/// A section's matrix.
type Matrix = [[f64; 6]; 6];

/// Diagonal matrices, by stations.
#[derive(Deserialize)]
struct Diagonal {
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
/// The section's axes: 1 along z, 2 along x, 3 along y.
pub(crate) fn tables(path: &Path, elements: usize) -> Result<String, String> {
    let failure = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    let text = std::fs::read_to_string(path).map_err(|error| failure(&error))?;
    let table: Table = serde_json::from_str(&text).map_err(|error| failure(&error))?;
    let (sections, grid, axes, twist) = match &table {
        Table::Full(table) => (full(table), &table.grid, &table.reference_axis, piecewise(&table.twist_rad)),
        Table::Diagonal(table) => {
            let twist = format!("({})*pi/180", piecewise(&table.twist));
            (diagonal(table), &table.grid, &table.reference_axis, twist)
        }
    };
    let sections = sections.ok_or_else(|| failure(&"its columns differ in length"))?;
    let mut out = String::new();
    let mut stations = Vec::new();
    for (k, (at, section)) in grid.iter().zip(&sections).enumerate() {
        let _ = writeln!(out, "[sections.s{k}]\nshape = \"general\"\n{section}\n");
        stations.push(format!("{{ at = {at:?}, section = \"s{k}\" }}"));
    }
    let _ = writeln!(
        out,
        "[beams.blade]\n{}\nelements = {elements}\nup = [0, 1, 0]\ntwist = \"-({twist})\"\nstations = [{}]\n",
        line(axes).ok_or_else(|| failure(&"it has no axis"))?,
        stations.join(", ")
    );
    Ok(out)
}

/// Stiffness and mass of every station, diagonal.
fn diagonal(table: &Diagonal) -> Option<Vec<String>> {
    let numbers = |list: &[&Vec<f64>], k: usize| {
        let list: Option<Vec<String>> =
            list.iter().map(|column| column.get(k).map(|value| format!("{value:?}"))).collect();
        list.map(|list| list.join(", "))
    };
    let section = |k: usize| {
        let columns = [&table.k33, &table.k11, &table.k22, &table.k66, &table.k44, &table.k55];
        let inertia = [&table.i_plr, &table.i_edge, &table.i_flap];
        Some(format!(
            "stiffness = [{}]\nmass = {{ per_length = {}, inertia = [{}] }}",
            numbers(&columns, k)?,
            numbers(&[&table.mass], k)?,
            numbers(&inertia, k)?,
        ))
    };
    (0..table.grid.len()).map(section).collect()
}

/// Stiffness and mass of every station, full.
fn full(table: &Full) -> Option<Vec<String>> {
    /// Rows of the table for axes 1, 2, 3.
    const ORDER: [usize; 6] = [2, 0, 1, 5, 3, 4];
    let matrix = |matrix: &Matrix| {
        let row = |i: usize| {
            // Exactly symmetric, which the tables are to their last digits only.
            let entry = |j: usize| format!("{:?}", 0.5 * (matrix[i][j] + matrix[j][i]));
            format!("[{}]", ORDER.map(entry).join(", "))
        };
        format!("[{}]", ORDER.map(row).join(", "))
    };
    let section = |k: usize| {
        let (stiffness, mass) = (table.stiffness.get(k)?, table.mass.get(k)?);
        Some(format!("stiffness = {}\nmass = {}", matrix(stiffness), matrix(mass)))
    };
    (0..table.grid.len()).map(section).collect()
}

/// The axis: a line, or a curve where it is not straight.
fn line(axes: &Axes) -> Option<String> {
    let straight = axes.x.values.iter().chain(&axes.y.values).all(|value| *value == 0.0);
    if straight {
        return Some(format!("from = [0, 0, 0]\nto = [0, 0, {:?}]", axes.z.values.last()?));
    }
    let [x, y, z] = [&axes.x, &axes.y, &axes.z].map(spline);
    Some(format!("curve = [\"{x}\", \"{y}\", \"{z}\"]"))
}

/// The natural cubic spline through a profile as an expression of `s`: a cubic, and a jump of the third derivative at
/// every inner point.
fn spline(profile: &Profile) -> String {
    let (x, y) = (&profile.grid, &profile.values);
    let count = x.len().min(y.len());
    if count < 3 {
        return piecewise(profile);
    }
    let width = |k: usize| x[k + 1] - x[k];
    let slope = |k: usize| (y[k + 1] - y[k]) / width(k);
    // Second derivatives: tridiagonal, zero at both ends.
    let mut diagonal = vec![1.0; count];
    let mut second = vec![0.0; count];
    for k in 1..count - 1 {
        let factor = if k == 1 { 0.0 } else { width(k - 1) / diagonal[k - 1] };
        diagonal[k] = 2.0 * (width(k - 1) + width(k)) - factor * width(k - 1);
        second[k] = 6.0 * (slope(k) - slope(k - 1)) - factor * second[k - 1];
    }
    for k in (1..count - 1).rev() {
        second[k] = (second[k] - width(k) * second[k + 1]) / diagonal[k];
    }
    let first = slope(0) - width(0) * (2.0 * second[0] + second[1]) / 6.0;
    let mut text = format!("{:?}+({first:?})*(s-({:?}))", y[0], x[0]);
    let mut before = 0.0;
    for k in 0..count - 1 {
        let third = (second[k + 1] - second[k]) / width(k);
        let _ = write!(text, "+({:?})*max(s-({:?}), 0)^3", (third - before) / 6.0, x[k]);
        before = third;
    }
    text
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

    fn value(expression: &str, at: f64) -> f64 {
        let none = std::collections::BTreeMap::default();
        lissom_model::expression::Expression::parse(expression, Some("s"), &none).unwrap().jet(at).value
    }

    #[test]
    fn a_spline_goes_through_its_points_and_reproduces_a_line() {
        let profile = Profile { grid: vec![0.0, 0.2, 0.5, 0.6, 1.0], values: vec![1.0, -0.5, 2.0, 0.3, 0.7] };
        let text = spline(&profile);
        for (at, wanted) in profile.grid.iter().zip(&profile.values) {
            assert!((value(&text, *at) - wanted).abs() < 1e-12);
        }
        let line = Profile { grid: profile.grid.clone(), values: vec![0.0, 0.4, 1.0, 1.2, 2.0] };
        assert!((value(&spline(&line), 0.37) - 0.74).abs() < 1e-12);
    }

    #[test]
    fn a_profile_becomes_an_expression_through_its_points() {
        let profile = Profile { grid: vec![0.0, 0.25, 1.0], values: vec![0.5, 1.0, -2.0] };
        for (at, wanted) in [(0.0, 0.5), (0.25, 1.0), (0.625, -0.5), (1.0, -2.0)] {
            assert!((value(&piecewise(&profile), at) - wanted).abs() < 1e-14);
        }
    }
}
