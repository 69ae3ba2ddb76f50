//! Derivatives by departures from going on: `H(t) = H exp(t V) exp ψ̂(t)`, differentiated along the motion itself.

use lissom_mechanics::joints::evaluation_point::Chart;
use lissom_motion::{Motion, Vector6, tangent};
use lissom_system::System;

use crate::derivatives::configuration::{Configuration, Unknown, difference, unknown};

const TOLERANCE: f64 = 2e-8;
/// Round-off of a difference, relative to the residual: that of a tyre deflected far beyond its friction is large.
const ROUND_OFF: f64 = 1e4 * f64::EPSILON;

/// The configuration at t = 0 where ψ̂(t) of one unknown is `jet[0] + jet[1] t + jet[2] t²/2`.
fn departed(here: &Configuration, system: &System, row: usize, jet: [f64; 3]) -> Configuration {
    let mut moved = here.displaced(system, row, jet[0], false);
    match unknown(system.layout(), row) {
        Unknown::Node(node, k) => {
            let own = here.at.nodes[node].twist;
            let along = |number: f64| Vector6::ith(k, number);
            let twist = |time: f64| {
                let psi = along(jet[0] + time * (jet[1] + 0.5 * time * jet[2]));
                let rate = along(jet[1] + time * jet[2]);
                let carried = Motion::exponential(&psi).adjoint_inverse_times(&own);
                (carried + tangent(&psi) * rate).as_slice().to_vec()
            };
            moved.at.nodes[node].twist = Vector6::from_vec(twist(0.0));
            moved.at.nodes[node].acceleration = Vector6::from_vec(difference(twist));
        }
        Unknown::Coordinate(coordinate) => {
            moved.at.coordinates[coordinate].rate += jet[1];
            moved.at.coordinates[coordinate].acceleration += jet[2];
        }
        Unknown::Multiplier(_) => {}
    }
    moved
}

/// Compares the linearisation with differences of the residual, about motions with constant twists.
pub(crate) fn check(name: &str, system: &System, mut here: Configuration) {
    for node in &mut here.at.nodes {
        node.acceleration.fill(0.0);
    }
    let layout = system.layout();
    let pattern = system.pattern();
    let mut linearization = system.empty_linearization();
    system.linearize(&here.point(0.0), Chart::RelativeToDrift(&here.at.nodes, &[]), &mut linearization);
    for column in 0..layout.coordinate_count() {
        let by = |order: usize| {
            difference(|step| {
                let mut jet = [0.0; 3];
                jet[order] = step;
                departed(&here, system, column, jet).residual(system, 0.0)
            })
        };
        let found = [0, 1, 2].map(by);
        let residual = here.residual(system, 0.0);
        for row in 0..layout.size() {
            let at = |values: &[f64]| pattern.position(row, column).map_or(0.0, |p| values[p]);
            let gradient = at(&linearization.constraint);
            // B v, where a violation lapses in one second.
            let by_rate = layout.velocity_rows().any(|own| own == row);
            let [place, rate] = if by_rate { [0.0, gradient] } else { [gradient, 0.0] };
            let place = at(&linearization.stiffness) + place;
            let exact = [place, at(&linearization.damping) + rate, at(&linearization.mass)];
            for (what, (exact, found)) in ["stiffness", "damping", "mass"]
                .into_iter()
                .zip(exact.into_iter().zip(found.iter().map(|f| f[row])))
            {
                let scale = 1.0 + exact.abs().max(found.abs());
                assert!(
                    (exact - found).abs() < TOLERANCE * scale + ROUND_OFF * residual[row].abs(),
                    "{name}: {what} of {} by the departure of {}: {exact} but difference {found}",
                    layout.name_of(row),
                    layout.name_of(column),
                );
            }
        }
    }
}
