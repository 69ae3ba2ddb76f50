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
        // Beyond its end a continued law may have no value, as a root of the elongation: it has that of the end.
        let is_continued = is_above && above < 0.0 || is_below && below > 0.0;
        let [elastic, damper] =
            [(&self.elastic, [past, rate], [0.0, rate]), (&self.damper, [rate, past], [rate, 0.0])].map(
                |(law, [one, other], end)| {
                    let Some(law) = law else { return [0.0; 3] };
                    let begin = next;
                    let own = sides.get(begin..begin + law.switch_count()).unwrap_or_default();
                    law.switches(one, other, own, &mut |switch| _ = passes(&mut next, switch));
                    let found = law.continued(one, other, own);
                    let is_lost = is_continued && found.iter().any(|value| value.is_nan());
                    if is_lost { law.continued(end[0], end[1], own) } else { found }
                },
            );
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
#[path = "../../tests/unit/elements/force_law.rs"]
mod tests;
