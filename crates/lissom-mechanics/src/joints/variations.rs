//! A relative motion and the coordinates of a joint as functions of their variations η = (u, θ) and φ, by first derivatives.
//!
//! ```text
//! δR = R θ̃,      δP = u + P × θ,      δx = R u
//! ```
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{Real, Slopes, Triple};

use super::relative_increment::{Angle, Axes, CoordinateIncrement, RelativeIncrement};

/// A number with its derivatives with respect to u, θ and φ, in this order.
type Varied<R> = Slopes<R, 8>;

/// Both at the present values, with their derivatives.
#[inline(always)]
pub(crate) fn variations<R: Real>(
    increment: &RelativeIncrement<R>,
    own: &CoordinateIncrement<R>,
) -> (RelativeIncrement<Varied<R>>, CoordinateIncrement<Varied<R>>) {
    let (rotation, place) = (increment.rotation(), increment.place);
    let (zero, one) = (place.x.like(0.0), place.x.like(1.0));
    let nothing = Triple::new(zero, zero, zero);
    let units = [Triple::new(one, zero, zero), Triple::new(zero, one, zero), Triple::new(zero, zero, one)];
    // By u, then by θ.
    let vary = |value: Triple<R>, by: [[Triple<R>; 3]; 2]| {
        let column = |component: fn(&Triple<R>) -> R| {
            let mut slopes = Slopes::constant(component(&value));
            by.as_flattened().iter().zip(&mut slopes.by).for_each(|(by, out)| *out = component(by));
            slopes
        };
        Triple::new(column(|own| own.x), column(|own| own.y), column(|own| own.z))
    };
    let fixed = |axes: Axes<R>| Axes(axes.0.map(|axis| vary(axis, [[nothing; 3]; 2])));
    let turned = std::array::from_fn(|k| {
        let by = units.map(|unit| rotation.times(unit.cross(units[k])));
        vary(increment.rotation_change.0[k], [[nothing; 3], by])
    });
    let by_place = [units, units.map(|unit| place.cross(unit))];
    let relative = RelativeIncrement {
        start_rotation: fixed(increment.start_rotation),
        rotation_change: Axes(turned),
        place: vary(place, by_place),
        place_change: vary(increment.place_change, by_place),
        position_change: vary(increment.position_change, [rotation.0, [nothing; 3]]),
    };
    let along = |value: R, coordinate: usize, slope: R| {
        let mut slopes = Slopes::constant(value);
        slopes.by[6 + coordinate] = slope;
        slopes
    };
    let angle = |k: usize| {
        let Angle { sine, cosine, sine_change, cosine_change } = own.angles[k];
        Angle {
            sine: along(sine, k, cosine),
            cosine: along(cosine, k, -sine),
            sine_change: along(sine_change, k, cosine),
            cosine_change: along(cosine_change, k, -sine),
        }
    };
    let own = CoordinateIncrement {
        change: [along(own.change[0], 0, one), along(own.change[1], 1, one)],
        angles: [angle(0), angle(1)],
    };
    (relative, own)
}
