//! Tests of `elements::force_law`, a module of it.

use std::sync::Arc;

use super::*;
use crate::registry::{ForceFunction, Value};

#[derive(Debug)]
struct Cubic {
    by_rate: f64,
}

impl ForceFunction for Cubic {
    fn evaluate(&self, first: f64, second: f64) -> [f64; 3] {
        [first * first * first + self.by_rate * second, 3.0 * first * first, self.by_rate]
    }
    fn depends_on_second(&self) -> bool {
        self.by_rate != 0.0
    }
}

#[derive(Debug)]
struct Attraction;

impl ForceFunction for Attraction {
    fn evaluate(&self, first: f64, _second: f64) -> [f64; 3] {
        [first.powi(-2), -2.0 * first.powi(-3), 0.0]
    }
    fn depends_on_second(&self) -> bool {
        false
    }
}

fn law(parameters: &Parameters) -> ForceLaw {
    let declared = parameters.declared(crate::elements::point_spring::KIND.parameters);
    ForceLaw::new(&declared, ["force", "damper_force"]).unwrap()
}

fn cubic(by_rate: f64) -> Value {
    Value::Force(Arc::new(Cubic { by_rate }))
}

#[test]
fn forces_act_on_their_side_past_the_play_within_limits() {
    let given = Parameters::new()
        .with("stiffness", Value::Number(100.0))
        .with("damping", Value::Number(10.0))
        .with("backlash", Value::Number(0.2));
    let both = law(&given);
    assert_eq!(both.evaluate(0.05, 3.0, &[]), Response::default());
    assert!((both.evaluate(0.3, 0.0, &[]).force - 20.0).abs() < 1e-12);
    assert!((both.evaluate(-0.3, 1.0, &[]).force + 10.0).abs() < 1e-12);
    assert!((both.potential(-0.3) - 2.0).abs() < 1e-12);
    let compressed = law(&given.clone().with("side", Value::Text("compression".to_owned())));
    assert_eq!(compressed.evaluate(0.3, 0.0, &[]).force, 0.0);
    assert!((compressed.evaluate(-0.3, 0.0, &[]).force + 20.0).abs() < 1e-12);
    // It does not pull during unloading.
    assert_eq!(compressed.evaluate(-0.3, 5.0, &[]), Response::default());
    assert_eq!(compressed.potential(0.3), 0.0);
    let limited = law(&given.with("limits", Value::Range([-5.0, 8.0])));
    assert_eq!(limited.evaluate(0.5, 0.0, &[]), Response { force: 8.0, ..Response::default() });
    // On a known side it is continued, however far an iterate moves.
    let free = [-1.0; 4];
    assert_eq!(limited.switch_count(), 4);
    assert_eq!(limited.evaluate(0.5, 1.0, &free), Response::default());
    assert!((limited.evaluate(0.05, 0.0, &[1.0, -1.0, -1.0, -1.0]).force + 5.0).abs() < 1e-12);
    // ½ k (8/k)² up to saturation, then 8 N along the rest.
    assert!((limited.potential(0.5) - (0.32 + 8.0 * 0.32)).abs() < 1e-8, "{}", limited.potential(0.5));
}

#[test]
fn switches_change_their_sign_where_the_force_has_a_kink() {
    let given = Parameters::new()
        .with("stiffness", Value::Number(100.0))
        .with("backlash", Value::Number(0.2))
        .with("limits", Value::Range([f64::NEG_INFINITY, 8.0]));
    let at = |law: &ForceLaw, elongation: f64| {
        let mut found = Vec::new();
        law.add_switches([elongation, 0.0], &[], &mut found);
        found.iter().map(|switch| switch.number).collect::<Vec<f64>>()
    };
    let both = law(&given);
    for (place, which) in [(0.1, 0), (-0.1, 1), (0.18, 2)] {
        let [before, after] = [-1e-6, 1e-6].map(|step| at(&both, place + step));
        assert_eq!(before.len(), 3);
        for k in 0..3 {
            assert_eq!(before[k] * after[k] < 0.0, k == which, "{place} {k}");
        }
    }
    let compressed = law(&given.with("side", Value::Text("compression".to_owned())));
    assert_eq!(at(&compressed, 0.3).len(), 1);
    assert!(at(&law(&Parameters::new().with("stiffness", Value::Number(1.0))), 0.3).is_empty());
}

#[test]
fn energy_is_the_integral_of_the_force() {
    let cubic_law = law(&Parameters::new().with("force", cubic(0.0)));
    assert!((cubic_law.potential(-1.3) - 0.25 * 1.3_f64.powi(4)).abs() < 1e-12);
    let saturated =
        law(&Parameters::new().with("force", cubic(0.0)).with("limits", Value::Range([-1.0, 1.0])));
    assert!((saturated.potential(2.0) - 1.25).abs() < 1e-8, "{}", saturated.potential(2.0));
}

/// Intervals of a cubic are integrated exactly, so that a kink costs no accuracy, and additional breakpoints have
/// no effect.
#[test]
fn integrals_stop_at_kinks() {
    let (kink, other) = (0.3_f64, -0.37_f64);
    let bent = |x: f64| x * x + 5.0 * (x - kink).max(0.0) - 7.0 * (other - x).max(0.0);
    let places = [kink, other, -3.0, 2.0];
    for (end, wanted) in [
        (0.2, 0.2_f64.powi(3) / 3.0),
        (1.1, 1.1_f64.powi(3) / 3.0 + 2.5 * (1.1 - kink).powi(2)),
        (-0.2, -(0.2_f64.powi(3)) / 3.0),
        (-1.1, 3.5 * (other + 1.1).powi(2) - 1.1_f64.powi(3) / 3.0),
    ] {
        let found = integral(&Integrand { value: &bent, bounds: &|_| None }, end, &places);
        assert!((found - wanted).abs() < 1e-14, "{end}: {found:e}, {wanted:e}");
    }
}

#[test]
fn what_puts_energy_in_is_counted_as_a_load() {
    for (name, by_rate, active) in
        [("force", 2.0, false), ("force", -2.0, true), ("force", 0.0, false), ("damper_force", 0.0, false)]
    {
        let law = law(&Parameters::new().with(name, cubic(by_rate)));
        assert_eq!(law.is_active(), active, "{name} {by_rate}");
    }
    // A damper with a constant force supplies energy in one direction.
    assert!(law(&Parameters::new().with("damper_force", Value::Number(1.0))).is_active());
    let active = law(&Parameters::new().with("force", cubic(-2.0)));
    assert_eq!(active.potential(1.0), 0.0);
    // The potential of an attraction is infinite at zero distance.
    let attraction = Value::Force(Arc::new(Attraction));
    assert!(law(&Parameters::new().with("force", attraction)).is_active());
}

/// A force of any formula.
#[derive(Debug)]
struct Formula(fn(f64, f64) -> f64, bool);

impl ForceFunction for Formula {
    fn evaluate(&self, first: f64, second: f64) -> [f64; 3] {
        [(self.0)(first, second), 0.0, 0.0]
    }
    fn depends_on_second(&self) -> bool {
        self.1
    }
}

fn formula(force: fn(f64, f64) -> f64, depends_on_second: bool) -> Value {
    Value::Force(Arc::new(Formula(force, depends_on_second)))
}

/// The energy of every combination of side, play, limits and force, against a sum over many small steps.
#[test]
fn energies_are_integrals_with_all_settings() {
    let laws = [
        ("stiffness", Value::Number(100.0)),
        ("force", cubic(0.0)),
        // Steep on one side and flat on the other, so that intervals differ in length.
        ("force", formula(|x, _| (6.0 * x).exp() - 1.0 + 2.0 / (1.0 + 900.0 * (x - 0.4) * (x - 0.4)), false)),
    ];
    for (name, value) in laws {
        for side in [None, Some("tension"), Some("compression")] {
            for play in [0.0, 0.3] {
                for limits in
                    [None, Some([-6.0, 9.0]), Some([-6.0, f64::INFINITY]), Some([f64::NEG_INFINITY, 9.0])]
                {
                    let mut given =
                        Parameters::new().with(name, value.clone()).with("backlash", Value::Number(play));
                    if let Some(side) = side {
                        given = given.with("side", Value::Text(side.to_owned()));
                    }
                    if let Some(limits) = limits {
                        given = given.with("limits", Value::Range(limits));
                    }
                    let law = law(&given);
                    for end in [0.05, 0.7, 1.2, -0.05, -0.7, -1.2] {
                        let steps = 20_000;
                        let width = end / f64::from(steps);
                        let force = |k: u32| law.evaluate(width * (f64::from(k) + 0.5), 0.0, &[]).force;
                        let wanted: f64 = width * (0..steps as u32).map(force).sum::<f64>();
                        let found = law.potential(end);
                        assert!(
                            (found - wanted).abs() < 1e-5 * (0.01 + wanted.abs()),
                            "{name} {side:?} {play} {limits:?} up to {end}: {found}, {wanted}"
                        );
                    }
                }
            }
        }
    }
}

/// Forces that supply energy only at some rates or deformations, within the range examined.
#[test]
fn forces_that_drive_anywhere_are_active() {
    type Case = (&'static str, fn(f64, f64) -> f64, bool, bool);
    let cases: [Case; 12] = [
        ("damper_force", |v, _| v, false, false),
        ("damper_force", |v, _| v * v * v, false, false),
        ("damper_force", |v, _| -1e-9 * v, false, true),
        ("damper_force", |v, _| v.max(0.0), false, false),
        // Supplies energy beyond a rate, or below one, in one direction.
        ("damper_force", |v, _| if v > 5e5 { -v } else { v }, false, true),
        ("damper_force", |v, _| if v < -5e5 { -v } else { v }, false, true),
        ("damper_force", |v, _| if v.abs() < 2e-6 { -v } else { v }, false, true),
        // Supplies energy at large or small deformations.
        ("damper_force", |v, x| v * x * x, true, false),
        ("damper_force", |v, x| if x > 5e5 { -v } else { v }, true, true),
        ("damper_force", |v, x| if x.abs() < 2e-6 { -v } else { v }, true, true),
        ("force", |x, v| x + v * x * x, true, false),
        ("force", |x, v| if x < -5e5 { x - v } else { x + v }, true, true),
    ];
    for (index, (name, force, depends_on_second, is_active)) in cases.into_iter().enumerate() {
        let law = law(&Parameters::new().with(name, formula(force, depends_on_second)));
        assert_eq!(law.is_active(), is_active, "case {index}");
    }
}

/// The length without force of a spring of stiffness 200 N/m that is 0.5 m long at the start, with further parameters.
fn rest(more: &[(&str, Value)]) -> Result<f64, ParameterError> {
    let mut parameters = Parameters::new().with("stiffness", Value::Number(200.0));
    for (name, value) in more {
        parameters.insert(name, value.clone());
    }
    law(&parameters).rest(&parameters, "length", [0.5, 0.3])
}

#[test]
fn a_preload_determines_the_length_without_force() {
    let preload = || ("preload", Value::Number(-20.0));
    assert_eq!(rest(&[]), Ok(0.3));
    assert_eq!(rest(&[preload()]), Ok(0.6));
    let wrong = |more: &[(&str, Value)], words: &str| {
        let problem = rest(more).unwrap_err().to_string();
        assert!(problem.contains(words), "{problem}");
    };
    wrong(&[preload(), ("length", Value::Number(0.4))], "remove one of them");
    wrong(&[preload(), ("stiffness", Value::Number(0.0))], "needs a `stiffness`");
    wrong(&[preload(), ("side", Value::Text("tension".to_owned()))], "cannot be reached");
    wrong(&[preload(), ("backlash", Value::Number(0.01))], "cannot be reached");
}
