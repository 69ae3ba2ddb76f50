//! Pressures on faces of shells and solids, over time and place.

use std::sync::Arc;

use lissom_flexible::pressure::{Pressure, PressureField};
use lissom_motion::{Motion, Vector3};

use super::shells::of_load;
use crate::document::Document;
use crate::expression::Formula;

/// Names of the place in expressions.
pub(crate) const PLACE: [&str; 3] = ["x", "y", "z"];

/// A pressure over the place, in the axes in which it is written.
#[derive(Clone, Debug)]
struct OverPlace {
    formula: Formula,
    /// Each argument: the number that it is, or the coordinate of the place.
    arguments: Vec<Result<f64, usize>>,
    axes: Motion,
    /// From when to when it grows from nothing [s], if it is constant.
    ramp: Option<(f64, f64)>,
    breakpoints: Vec<f64>,
}

impl OverPlace {
    fn factor(&self, time: f64) -> f64 {
        self.ramp.map_or(1.0, |(start, end)| (time - start) / (end - start))
    }

    fn jet(&self, time: f64, place: &Vector3, along: Option<usize>) -> [f64; 3] {
        self.formula.jet((time, 0.0), |index| match self.arguments[index] {
            Ok(number) => (number, 0.0),
            Err(k) => (place[k], f64::from(u8::from(along == Some(k)))),
        })
    }
}

impl PressureField for OverPlace {
    fn value(&self, time: f64, place: &Vector3) -> f64 {
        self.factor(time) * self.jet(time, &self.axes.inverse_transform_point(place), None)[0]
    }

    fn slope(&self, time: f64, place: &Vector3) -> Vector3 {
        let place = self.axes.inverse_transform_point(place);
        let slope = Vector3::from_fn(|k, _| self.jet(time, &place, Some(k))[1]);
        self.factor(time) * self.axes.rotation.apply(&slope)
    }

    fn breakpoints(&self) -> Vec<f64> {
        self.breakpoints.clone()
    }
}

/// The pressure of an expression on a face at a place [m], with the numbers of its other arguments. It must be finite there during the
/// analysis: otherwise an instant at which it is not.
pub(super) fn pressure(
    document: &Document,
    (formula, axes): (&Formula, &Motion),
    place: &Vector3,
    number: impl Fn(&str) -> f64,
) -> Result<Pressure, f64> {
    let of = |name: &str| PLACE.iter().position(|own| *own == name).map_or_else(|| Ok(number(name)), Err);
    let arguments: Vec<Result<f64, usize>> = formula.arguments().iter().map(|own| of(&own.text)).collect();
    let place = axes.inverse_transform_point(place);
    let here: Vec<f64> = arguments.iter().map(|own| own.unwrap_or_else(|k| place[k])).collect();
    let function = of_load(document, formula.with_arguments(&here))?;
    if arguments.iter().all(Result::is_ok) {
        return Ok(Pressure::Uniform(function));
    }
    let span = (document.analysis.start, document.analysis.end);
    let grows = document.analysis.ramp && !formula.depends_on_time();
    Ok(Pressure::Field(Arc::new(OverPlace {
        formula: formula.clone(),
        arguments,
        axes: *axes,
        ramp: grows.then_some(span),
        breakpoints: if grows { Vec::new() } else { function.breakpoints() },
    })))
}
