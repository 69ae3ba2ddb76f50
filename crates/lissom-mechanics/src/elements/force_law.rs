//! The force of a spring and damper over its elongation x and rate v; positive if it pulls.
//!
//! Legend: u elongation past the free play b, k stiffness, c damping, F and D functions given by expression or table,
//! P(u) potential energy.
//!
//! ```text
//! f = clamp(k u + c v + F(u, v) + D(v, u)),      u = x - clamp(x, -b/2, b/2),      P(u) = ∫₀ᵘ clamp(k ξ + F(ξ, 0)) dξ
//! ```
//!
//! It is zero within the free play and, if it is one-sided, on the other side; there it does not change sign either. The
//! difference between f and P' dissipates energy as long as it has the sign of v, because clamping is monotone. A law
//! that violates this has no potential energy, and its work is treated as that of a load.

use super::over_measure::MeasuredLaw;
use crate::evaluation::switch_states::is_on_upper_branch;
use crate::kinematics::Switch;
use crate::law::{Enclosure, Interval, NARROW_BOUNDS, ScalarLaw, hull, scaled, sum};
use crate::registry::ParameterType::Number;
use crate::registry::{Force, Parameter, ParameterError, ParameterType, Parameters, optional, unitless};
use crate::round_off;
use crate::signals::measurement::Gradient;

/// The force at the start, for lengths.
pub(crate) const PRELOAD_FORCE: Parameter = optional(
    "preload",
    Number,
    "N",
    "Force at the start, positive if it pulls, instead of the position without force.",
);

/// The moment at the start, for angles.
pub(crate) const PRELOAD_MOMENT: Parameter = optional(
    "preload",
    Number,
    "N m",
    "Moment at the start, positive if it resists a positive rotation, instead of the rotation without moment.",
);

/// On which side of the free length it acts, for lengths.
pub(crate) const SIDE_OF_LENGTH: Parameter = unitless(
    "side",
    ParameterType::Choice(&["both", "tension", "compression"]),
    "Where it acts: beyond its free length (\"tension\"), below it (\"compression\"), or both.",
)
.or_word("both");

/// On which side of the free angle it acts, for angles.
pub(crate) const SIDE_OF_ANGLE: Parameter = unitless(
    "side",
    ParameterType::Choice(&["both", "positive", "negative"]),
    "Where it acts: above its free rotation (\"positive\"), below it (\"negative\"), or both.",
)
.or_word("both");

/// The side on which it acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    Both,
    Positive,
    Negative,
}

/// A force and its derivatives.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Response {
    /// The force [N, N m], positive if it pulls.
    pub force: f64,
    /// Derivative with respect to the elongation [N/m, N m/rad].
    pub stiffness: f64,
    /// Derivative with respect to the rate [N s/m, N m s/rad].
    pub damping: f64,
}

impl Response {
    /// Gradients of the elongation, its rate and the force, from those of the first two.
    pub fn gradients(&self, [elongation, rate]: [Gradient; 2]) -> [Gradient; 3] {
        let force = Gradient::zero().plus(self.stiffness, &elongation).plus(self.damping, &rate);
        [elongation, rate, force]
    }
}

/// The law of a spring and damper.
#[derive(Clone, Debug)]
pub(crate) struct ForceLaw {
    stiffness: f64,
    damping: f64,
    elastic: Option<Force>,
    damper: Option<Force>,
    side: Side,
    limits: [f64; 2],
    /// Half of the free play.
    play: f64,
    is_active: bool,
}

impl ForceLaw {
    /// From the parameters `stiffness`, `damping`, `side`, `limits` and `backlash`, and from the two named parameters
    /// for forces over elongation and over rate.
    ///
    /// # Errors
    /// If a parameter is of the wrong kind.
    pub(crate) fn new(parameters: &Parameters, [elastic, damper]: [&str; 2]) -> Result<Self, ParameterError> {
        let side = match parameters.word("side")? {
            "tension" | "positive" => Side::Positive,
            "compression" | "negative" => Side::Negative,
            _ => Side::Both,
        };
        let [low, high] = parameters.range("limits")?.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
        let limits = match side {
            Side::Both => [low, high],
            Side::Positive => [low.max(0.0), high.max(0.0)],
            Side::Negative => [low.min(0.0), high.min(0.0)],
        };
        let mut law = Self {
            stiffness: parameters.number("stiffness")?,
            damping: parameters.number("damping")?,
            elastic: parameters.force(elastic)?,
            damper: parameters.force(damper)?,
            side,
            limits,
            play: 0.5 * parameters.number_or("backlash", 0.0)?,
            is_active: false,
        };
        // The potential energy is zero at the free length; a law that is infinite there has none.
        let has_potential = law
            .elastic
            .as_ref()
            .is_none_or(|law| law.evaluate(0.0, 0.0)[0].is_finite() && law.is_integrable());
        law.is_active = !(has_potential && law.seems_passive());
        Ok(law)
    }

    /// The length or coordinate without force: the parameter `key`, or `default`; with the parameter `preload` the one from which
    /// `at_start` causes this force.
    ///
    /// # Errors
    /// If both are given, or the law is not equal to the preload there.
    pub(crate) fn rest(
        &self,
        parameters: &Parameters,
        key: &str,
        [at_start, default]: [f64; 2],
    ) -> Result<f64, ParameterError> {
        if !parameters.has("preload") {
            return parameters.number_or(key, default);
        }
        if parameters.has(key) {
            let problem = format!("determines what `{key}` gives too: remove one of them");
            return Err(ParameterError::new("preload", problem));
        }
        let preload = parameters.number("preload")?;
        let elongation = preload / self.stiffness;
        // Without stiffness it is not a number.
        let force = self.evaluate(elongation, 0.0, &[]).force;
        if (force - preload).abs() <= round_off::FORCE * preload.abs() {
            return Ok(at_start - elongation);
        }
        let problem = if self.stiffness == 0.0 {
            format!("needs a `stiffness`: give `{key}` instead")
        } else {
            format!(
                "cannot be reached by `stiffness` alone: at its deformation of {elongation} the spring exerts {force}, because of its \
                 other parameters; give `{key}` instead"
            )
        };
        Err(ParameterError::new("preload", problem))
    }

    /// Whether the force depends on the rate.
    pub(crate) fn depends_on_rate(&self) -> bool {
        let is_damped = |law: &Force| law.depends_on_second();
        self.damping != 0.0 || self.damper.is_some() || self.elastic.as_ref().is_some_and(is_damped)
    }

    /// Elongation past the free play.
    fn past(&self, elongation: f64) -> f64 {
        let past = elongation - elongation.clamp(-self.play, self.play);
        match self.side {
            Side::Both => past,
            Side::Positive => (elongation - self.play).max(0.0),
            Side::Negative => (elongation + self.play).min(0.0),
        }
    }

    /// Whether it is zero below an elongation, and above one.
    fn has_ends(&self) -> [bool; 2] {
        let has_play = self.side == Side::Both && self.play > 0.0;
        [has_play || self.side == Side::Positive, has_play || self.side == Side::Negative]
    }

    /// The force at an elongation and its rate, continued from known `sides` of its switches.
    pub(crate) fn evaluate(&self, elongation: f64, rate: f64, sides: &[f64]) -> Response {
        self.walk(elongation, rate, sides, |_| ())
    }

    /// The force; `hand` is given all switches in their order.
    fn walk(&self, elongation: f64, rate: f64, sides: &[f64], mut hand: impl FnMut(Switch)) -> Response {
        let mut next = 0;
        let mut passes = |next: &mut usize, switch: Switch| {
            hand(switch);
            *next += 1;
            is_on_upper_branch(sides.get(*next - 1), switch.number)
        };
        let [has_upper, has_lower] = self.has_ends();
        let (above, below) = (elongation - self.play, elongation + self.play);
        let is_above = has_upper && passes(&mut next, above.into());
        let is_below = has_lower && passes(&mut next, (-below).into());
        let past = match (is_above, is_below) {
            (true, _) => above,
            (_, true) => below,
            // Limits are those of the force where it begins.
            _ if has_upper || has_lower => 0.0,
            _ => elongation - elongation.clamp(-self.play, self.play),
        };
        let [elastic, damper] =
            [(&self.elastic, past, rate), (&self.damper, rate, past)].map(|(law, one, other)| {
                let Some(law) = law else { return [0.0; 3] };
                let begin = next;
                let own = sides.get(begin..begin + law.switch_count()).unwrap_or_default();
                law.switches(one, other, own, &mut |switch| _ = passes(&mut next, switch));
                law.continued(one, other, own)
            });
        let response = Response {
            force: self.stiffness * past + self.damping * rate + elastic[0] + damper[0],
            stiffness: self.stiffness + elastic[1] + damper[2],
            damping: self.damping + elastic[2] + damper[1],
        };
        let [low, high] = self.limits;
        let mut is_beyond = |limit: f64, value: f64| {
            if is_passed(limit) { passes(&mut next, value.into()) } else { value > 0.0 }
        };
        let is_high = is_beyond(high, response.force - high);
        let is_low = is_beyond(low, low - response.force);
        if (has_upper || has_lower) && !(is_above || is_below) {
            Response::default()
        } else if is_low {
            Response { force: low, ..Response::default() }
        } else if is_high {
            Response { force: high, ..Response::default() }
        } else {
            response
        }
    }

    /// Potential energy [J]; zero at the free length.
    fn potential(&self, elongation: f64) -> f64 {
        let past = self.past(elongation);
        if self.is_active || past == 0.0 {
            return 0.0;
        }
        let elastic = |past: f64| {
            self.stiffness * past + self.elastic.as_ref().map_or(0.0, |law| law.evaluate(past, 0.0)[0])
        };
        let [low, high] = self.limits;
        let is_linear = self.elastic.is_none() && (low..=high).contains(&(self.stiffness * past));
        if is_linear {
            return 0.5 * self.stiffness * past * past;
        }
        let breakpoints = self.elastic.as_ref().map_or_else(Vec::new, |law| law.breakpoints());
        let bounds =
            |interval: Interval| self.elastic.as_ref().and_then(|law| law.bounds(interval, [0.0; 2]));
        let integrand = Integrand { value: &|past| elastic(past).max(low).min(high), bounds: &bounds };
        integral(&integrand, past, &breakpoints)
    }

    /// Whether the rate-dependent part dissipates energy, as far as rates of all magnitudes show. A law that supplies
    /// energy elsewhere is detected by the energy balance of the simulation.
    fn seems_passive(&self) -> bool {
        let of_rate = |law: &Force| law.depends_on_second();
        let elastic = self.elastic.as_ref().filter(|law| of_rate(law));
        let sizes = || (-24..=24).map(|k| 10_f64.powf(f64::from(k) / 4.0)).flat_map(|size| [-size, size]);
        let deformations: Vec<f64> =
            (-12..=12).map(|k| 10_f64.powf(f64::from(k) / 2.0)).flat_map(|size| [-size, size]).collect();
        let takes_away = |force: f64, rate: f64, scale: f64| {
            !force.is_finite() || force * rate >= -1e-12 * scale.abs() * rate.abs()
        };
        let elastic_is = elastic.is_none_or(|law| {
            deformations.iter().all(|&x| {
                let [still, ..] = law.evaluate(x, 0.0);
                sizes().all(|rate| takes_away(law.evaluate(x, rate)[0] - still, rate, still))
            })
        });
        let damper_is = self.damper.as_ref().is_none_or(|law| {
            let at = if of_rate(law) { &deformations[..] } else { &[0.0] };
            at.iter().all(|&x| {
                law.evaluate(0.0, x)[0] == 0.0
                    && sizes().all(|rate| takes_away(law.evaluate(rate, x)[0], rate, 0.0))
            })
        });
        elastic_is && damper_is
    }
}

impl MeasuredLaw for ForceLaw {
    const SUPPLIES: bool = true;

    fn is_active(&self) -> bool {
        self.is_active
    }

    fn response(&self, [elongation, rate]: [f64; 2], sides: &[f64]) -> Response {
        self.evaluate(elongation, rate, sides)
    }

    fn energy(&self, elongation: f64, _: &[f64]) -> f64 {
        self.potential(elongation)
    }

    fn dissipates(&self) -> bool {
        self.depends_on_rate()
    }

    fn switch_count(&self) -> usize {
        let laws = [&self.elastic, &self.damper].into_iter().flatten();
        let breakpoints: usize = laws.map(|law| law.switch_count()).sum();
        let limits = self.limits.iter().filter(|limit| is_passed(**limit)).count();
        self.has_ends().iter().filter(|has| **has).count() + breakpoints + limits
    }

    fn add_switches(&self, [elongation, rate]: [f64; 2], sides: &[f64], out: &mut Vec<Switch>) {
        self.walk(elongation, rate, sides, |switch| out.push(switch));
    }

    fn examined(&self) -> Option<&ForceLaw> {
        let has_kinks =
            self.side != Side::Both || self.play > 0.0 || self.limits.iter().any(|limit| is_passed(*limit));
        (has_kinks || self.elastic.is_some() || self.damper.is_some()).then_some(self)
    }
}

impl ScalarLaw for ForceLaw {
    fn value(&self, _: f64, arguments: &[f64]) -> f64 {
        self.evaluate(arguments[0], arguments[1], &[]).force
    }

    fn is_smooth(&self) -> bool {
        self.switch_count() == 0
    }

    fn bounds(&self, _: Interval, arguments: &[Interval]) -> Option<Interval> {
        let (past, rate) = (arguments[0].map(|elongation| self.past(elongation)), arguments[1]);
        let has_ends = self.has_ends().contains(&true);
        if has_ends && past == [0.0; 2] {
            return Some([0.0; 2]);
        }
        let of = |law: &Option<Force>, one: Interval, other: Interval| match law {
            Some(law) => law.bounds(one, other),
            None => Some([0.0; 2]),
        };
        let functions = sum(of(&self.elastic, past, rate)?, of(&self.damper, rate, past)?);
        let linear = sum(scaled(self.stiffness, past), scaled(self.damping, rate));
        let [low, high] = sum(linear, functions).map(|force| force.clamp(self.limits[0], self.limits[1]));
        // It is zero within the free play and on the other side.
        let is_partly_free = has_ends && past[0] <= 0.0 && past[1] >= 0.0;
        Some(if is_partly_free { hull(&[low, 0.0, high]) } else { hull(&[low, high]) })
    }

    fn enclosure(&self, _: &Enclosure, arguments: &[Enclosure]) -> Option<Enclosure> {
        let (elongation, rate) = (arguments[0], arguments[1]);
        let ends = elongation.value.map(|elongation| self.past(elongation));
        if self.has_ends().contains(&true) {
            if ends == [0.0; 2] {
                return Some(Enclosure::of_constant([0.0; 2]));
            }
            // It begins to act within the interval, or is within its play at one end.
            if ends[0] <= 0.0 && ends[1] >= 0.0 {
                return None;
            }
        }
        let past = Enclosure { value: ends, ..elongation };
        let of = |law: &Option<Force>, one: &Enclosure, other: &Enclosure| match law {
            Some(law) => law.enclosure(one, other),
            None => Some(Enclosure::of_constant([0.0; 2])),
        };
        let functions = of(&self.elastic, &past, &rate)?.plus(&of(&self.damper, &rate, &past)?);
        let force = past.scaled(self.stiffness).plus(&rate.scaled(self.damping)).plus(&functions);
        // Beyond its limits it is constant.
        let is_within = self.limits[0] < force.value[0] && force.value[1] < self.limits[1];
        is_within.then_some(force)
    }
}

/// Whether a limit is reached while the force acts: a limit of zero is where it begins.
fn is_passed(limit: f64) -> bool {
    limit.is_finite() && limit != 0.0
}

/// Depth of bisection of an integral.
const DEPTH: usize = 20;
/// Error of an integral, relative to its size.
const ACCURACY: f64 = 1e-11;

/// A law that is integrated, with bounds of what is not linear in it; none if none are known.
struct Integrand<'f> {
    value: &'f dyn Fn(f64) -> f64,
    bounds: &'f dyn Fn(Interval) -> Option<Interval>,
}

impl Integrand<'_> {
    /// Width of the bounds between two points in any order.
    fn width(&self, ends: [f64; 2]) -> f64 {
        let width = (self.bounds)(hull(&ends)).map_or(0.0, |[low, high]| high - low);
        if width.is_finite() { width } else { 0.0 }
    }
}

/// ∫₀ᵉⁿᵈ f dx by Simpson's rule with bisection, in pieces between `breakpoints`.
fn integral(law: &Integrand<'_>, end: f64, breakpoints: &[f64]) -> f64 {
    let mut places: Vec<f64> =
        breakpoints.iter().copied().filter(|kink| kink * end > 0.0 && kink.abs() < end.abs()).collect();
    places.extend([0.0, end]);
    places.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
    let mut sum = 0.0;
    for pair in places.windows(2) {
        let (a, b) = (pair[0], pair[1]);
        let values = [a, 0.5 * (a + b), b].map(law.value);
        let whole = simpson(b - a, values);
        let size = (b - a).abs() * values.iter().fold(law.width([a, b]), |most, value| most.max(value.abs()));
        let narrow = NARROW_BOUNDS * law.width([a, b]);
        sum += bisected(law, (a, b), values, whole, (ACCURACY * size, narrow, DEPTH));
    }
    sum
}

fn simpson(width: f64, [first, middle, last]: [f64; 3]) -> f64 {
    width / 6.0 * (first + 4.0 * middle + last)
}

fn bisected(
    law: &Integrand<'_>,
    (a, b): (f64, f64),
    [first, middle, last]: [f64; 3],
    whole: f64,
    (allowed, narrow, depth): (f64, f64, usize),
) -> f64 {
    let centre = 0.5 * (a + b);
    let left = [first, (law.value)(0.5 * (a + centre)), middle];
    let right = [middle, (law.value)(0.5 * (centre + b)), last];
    let halves = [simpson(centre - a, left), simpson(b - centre, right)];
    let error = (halves[0] + halves[1] - whole) / 15.0;
    let is_hidden = || {
        let [low, high] = hull(&[left[0], left[1], left[2], right[1], right[2]]);
        law.width([a, b]) > high - low + narrow
    };
    if depth == 0 || !error.is_finite() || (error.abs() <= allowed && !is_hidden()) {
        return halves[0] + halves[1] + error;
    }
    let next = (0.5 * allowed, narrow, depth - 1);
    bisected(law, (a, centre), left, halves[0], next) + bisected(law, (centre, b), right, halves[1], next)
}

#[cfg(test)]
mod tests {
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
        for (name, by_rate, active) in [
            ("force", 2.0, false),
            ("force", -2.0, true),
            ("force", 0.0, false),
            ("damper_force", 0.0, false),
        ] {
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
            (
                "force",
                formula(|x, _| (6.0 * x).exp() - 1.0 + 2.0 / (1.0 + 900.0 * (x - 0.4) * (x - 0.4)), false),
            ),
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
}
