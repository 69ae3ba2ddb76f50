//! Cubes that are dropped onto a plane and onto each other, with steps of chosen size: all corners of a face meet at one instant.

use std::fmt::Write;

use crate::support::runs::{record, session};
use crate::support::series::{last, series};

/// Gravity [m/s²].
const G: f64 = 9.81;
/// Stiffness of every point of contact [N/m].
const STIFFNESS: f64 = 1e6;
/// Distance between two parts at the start [m].
const DROP: f64 = 2e-3;
/// Coefficient of friction.
const FRICTION: f64 = 0.5;
/// Deflection at which friction slips [m].
const DEFLECTION: f64 = 1e-5;

/// Masses [kg] and sides [m], from below.
type Cubes = Vec<(f64, f64)>;

fn stack(cubes: &Cubes, has_friction: bool) -> String {
    let mut text = format!(
        "lissom = 1\ngravity = [0, 0, -{G}]\n[ground]\nshape = {{ kind = \"plane\" }}\n[contacts.all]\n\
        base = \"ground\"\ntip = \"b0\"\nothers = {:?}\nstiffness = {STIFFNESS}\ndissipation = 5\n",
        (1..cubes.len()).map(|k| format!("b{k}")).collect::<Vec<_>>()
    );
    if has_friction {
        writeln!(text, "friction = {FRICTION}\ndeflection = {DEFLECTION}").expect("a string");
    }
    let mut top = 0.0;
    for (k, (mass, side)) in cubes.iter().enumerate() {
        let middle = top + DROP + 0.5 * side;
        top = middle + 0.5 * side;
        writeln!(
            text,
            "[bodies.b{k}]\nmass = {mass}\ninertia = {{ box = [{side}, {side}, {side}] }}\nshape = {{ box = [{side}, {side}, {side}] }}\n\
             position = [0, 0, {middle}]\n[outputs.b{k}]\nkind = \"position\"\nof = \"b{k}\""
        )
        .expect("a string");
    }
    text + "[outputs.all]\nkind = \"contact_force\"\nof = \"all\"\n[outputs.energy]\nkind = \"energy\"\n\
            [analysis]\nkind = \"dynamics\"\nend = 1\n"
}

/// Weight of a cube and of those above it [N].
fn weight_from(cubes: &[(f64, f64)], k: usize) -> f64 {
    G * cubes[k..].iter().map(|cube| cube.0).sum::<f64>()
}

/// Heights of the middles at rest [m]. The plane touches four corners. Of two equal faces the four corners of the one below and the four
/// edges of the one above touch, of a narrower cube its edges alone, which are crowned: their ends do not touch.
fn heights(cubes: &Cubes) -> Vec<f64> {
    let (mut top, mut below, mut heights) = (0.0, None, Vec::new());
    for (k, (_, side)) in cubes.iter().enumerate() {
        let points = if below == Some(side) { 8.0 } else { 4.0 };
        let middle = top + 0.5 * side - weight_from(cubes, k) / (points * STIFFNESS);
        heights.push(middle);
        (top, below) = (middle + 0.5 * side, Some(side));
    }
    heights
}

/// The cubes rest at their heights in the end, and no step gains energy.
fn comes_to_rest(cubes: &Cubes, has_friction: bool) {
    let mut session = session(&stack(cubes, has_friction), &[]);
    let record = record(&mut session);
    let what = format!("{cubes:?} {has_friction}");
    for (k, wanted) in heights(cubes).into_iter().enumerate() {
        let place = ["x", "y", "z"].map(|axis| last(&record, &format!("b{k}.{axis}")));
        assert!((place[2] - wanted).abs() < 1e-6, "{what}: {k} at {} instead of {wanted}", place[2]);
        assert!(place[0].hypot(place[1]) < 1e-6, "{what}: {k} at {place:?}");
    }
    // The sum over all pairs.
    let weight: f64 = (0..cubes.len()).map(|k| weight_from(cubes, k)).sum();
    assert!((last(&record, "all.f3") / weight - 1.0).abs() < 1e-3, "{what}: {}", last(&record, "all.f3"));
    // A touch that begins anew has the energy of bristles that have kept their deflection.
    let energy = series(&record, "energy.total");
    let allowed = 1e-9 * energy[0] + if has_friction { weight * FRICTION * DEFLECTION } else { 0.0 };
    let rise = energy.windows(2).map(|pair| pair[1] - pair[0]).fold(f64::NEG_INFINITY, f64::max);
    assert!(rise < allowed, "{what}: {rise:e}");
    assert!(
        session.simulation().totals().steps < 5000,
        "{what}: {} steps",
        session.simulation().totals().steps
    );
}

const RATIOS: [[f64; 2]; 4] = [[1.0, 1.0], [1.0, 10.0], [10.0, 1.0], [60.0, 1.0]];

#[test]
fn cubes_with_friction_come_to_rest_on_each_other() {
    for [lowest, others] in RATIOS {
        for count in [2, 3] {
            comes_to_rest(&(0..count).map(|k| (if k == 0 { lowest } else { others }, 0.4)).collect(), true);
        }
    }
    comes_to_rest(&vec![(1.0, 0.4), (60.0, 0.4)], true);
}

/// Without friction a cube on one of the same width slides off: rounded edges are unstable. Here the upper one is narrower.
#[test]
fn cubes_without_friction_come_to_rest_on_each_other() {
    for [lowest, others] in RATIOS {
        for count in [2, 3] {
            let cube = |k: usize| (if k == 0 { lowest } else { others }, 0.4 - 0.04 * k as f64);
            comes_to_rest(&(0..count).map(cube).collect(), false);
        }
    }
}
