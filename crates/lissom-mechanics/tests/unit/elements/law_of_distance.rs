//! Tests of `elements::law_of_distance`, a module of it.

use super::*;
use crate::registry::{Parameters, Value};

/// Along a line that passes a point, values and second differences are within the bounds.
#[test]
fn values_and_second_derivatives_are_within_bounds() {
    let given = Parameters::new()
        .with("stiffness", Value::Number(50.0))
        .with("damping", Value::Number(3.0))
        .with("side", Value::Text("compression".to_owned()));
    let force = ForceLaw::new(
        &given.declared(crate::elements::point_spring::KIND.parameters),
        ["force", "damper_force"],
    )
    .unwrap();
    let law = LawOfDistance { law: &force, length: 4.0 };
    let velocity = [1.0, -0.5, 0.2];
    let start = [-2.0, 1.3, 0.4];
    let at =
        |share: f64| -> Vec<f64> { (0..3).map(|k| start[k] + share * velocity[k]).chain(velocity).collect() };
    let aside = 1e-3;
    for k in 0..40 {
        let (from, to) = (0.1 * f64::from(k), 0.1 * f64::from(k + 1));
        let line = |k: usize| {
            let ends = [from, to].map(|share| start[k] + share * velocity[k]);
            Enclosure::of_line(ends, velocity[k])
        };
        let constant = |k: usize| Enclosure::of_constant([velocity[k]; 2]);
        let enclosures = [line(0), line(1), line(2), constant(0), constant(1), constant(2)];
        let time = Enclosure::of_line([from, to], 1.0);
        let intervals = enclosures.map(|own| own.value);
        let [low, high] = law.bounds([from, to], &intervals).unwrap();
        let enclosure = law.enclosure(&time, &enclosures).unwrap();
        for share in [0.1, 0.5, 0.9].map(|part| from + part * (to - from)) {
            let [before, value, after] = [-aside, 0.0, aside].map(|shift| law.value(0.0, &at(share + shift)));
            assert!((low..=high).contains(&value), "{low} {value} {high}");
            let second = (before - 2.0 * value + after) / (aside * aside);
            let [low, high] = enclosure.second;
            assert!((low - 1e-4..=high + 1e-4).contains(&second), "{low} {second} {high}");
        }
    }
    // Nothing is known of derivatives where the points may meet.
    let line = Enclosure::of_line([-1.0, 1.0], 2.0);
    let none = Enclosure::of_constant([0.0; 2]);
    let rate = Enclosure::of_constant([2.0; 2]);
    let through = [line, none, none, rate, none, none];
    assert_eq!(law.enclosure(&Enclosure::of_line([0.0, 1.0], 1.0), &through), None);
}
