//! Relative motion of a joint's frames as a function of time, by its first two derivatives.
//!
//! Legend: H = (R, x) relative motion, P = Rᵀx, ξ_A and ξ_B twists of base and tip joint frame, η the relative twist in the tip's
//! axes with translation u and rotation ω.
//!
//! ```text
//! η = ξ_B - Ad(H⁻¹) ξ_A,      η' = ad(η) ξ_B + ξ_B' - Ad(H⁻¹) ξ_A'
//! R' = R ω̃,   R'' = R (ω̃ω̃ + ω'~),     P' = u + P × ω,   P'' = u' + P' × ω + P × ω',     x' = R u,   x'' = R (u' + ω × u)
//! ```
//!
//! The equations of joints, evaluated for such motions, yield the rates and accelerations of their violations.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{Jet, Real, Screw, Triple};

use super::relative_increment::{Angle, Axes, RelativeIncrement};

/// Twist of a joint frame and its rate, in its own axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FrameMotion<R> {
    /// ξ.
    pub twist: Screw<R>,
    /// ξ'.
    pub rate: Screw<R>,
}

/// The relative motion at (R, P), with the motions of base and tip: its changes are zero, and their derivatives are not.
#[inline(always)]
pub(crate) fn relative_motion<R: Real>(
    (rotation, place): (Axes<R>, Triple<R>),
    base: FrameMotion<R>,
    tip: FrameMotion<R>,
) -> RelativeIncrement<Jet<R>> {
    let zero = place.x.like(0.0);
    let nothing = Triple::new(zero, zero, zero);
    let twist = difference(rotation, place, base.twist, tip.twist);
    let mut rate = difference(rotation, place, base.rate, tip.rate);
    let (u, turn) = (twist.translation, twist.rotation);
    rate.translation =
        rate.translation.plus_cross(turn, tip.twist.translation).plus_cross(u, tip.twist.rotation);
    rate.rotation = rate.rotation.plus_cross(turn, tip.twist.rotation);
    let place_rate = u.plus_cross(place, turn);
    let place_acceleration = rate.translation.plus_cross(place_rate, turn).plus_cross(place, rate.rotation);
    let position_rate = rotation.times(u);
    let position_acceleration = rotation.times(rate.translation.plus_cross(turn, u));
    let one = place.x.like(1.0);
    let units = [Triple::new(one, zero, zero), Triple::new(zero, one, zero), Triple::new(zero, zero, one)];
    let mut turned = Axes([jet(nothing, nothing, nothing); 3]);
    for k in 0..3 {
        let across = turn.cross(units[k]);
        let second = rate.rotation.cross(units[k]).plus_cross(turn, across);
        turned.0[k] = jet(nothing, rotation.times(across), rotation.times(second));
    }
    let [a, b, c] = rotation.0;
    RelativeIncrement {
        start_rotation: Axes([jet(a, nothing, nothing), jet(b, nothing, nothing), jet(c, nothing, nothing)]),
        rotation_change: turned,
        place: jet(place, place_rate, place_acceleration),
        place_change: jet(nothing, place_rate, place_acceleration),
        position_change: jet(nothing, position_rate, position_acceleration),
    }
}

/// ξ_B - Ad(H⁻¹) ξ_A.
#[inline(always)]
fn difference<R: Real>(rotation: Axes<R>, place: Triple<R>, base: Screw<R>, tip: Screw<R>) -> Screw<R> {
    let turn = rotation.transpose_times(base.rotation);
    let shift = rotation.transpose_times(base.translation).plus_cross(turn, place);
    Screw::new(tip.translation - shift, tip.rotation - turn)
}

/// An angle with this sine and cosine, rate and acceleration.
#[inline(always)]
pub(crate) fn angle<R: Real>([sine, cosine]: [R; 2], rate: R, acceleration: R) -> Angle<Jet<R>> {
    let zero = sine.like(0.0);
    let square = rate * rate;
    let sine_jet = Jet {
        value: sine,
        first: cosine * rate,
        second: (cosine * acceleration).minus_product(sine, square),
    };
    let cosine_jet = Jet {
        value: cosine,
        first: -(sine * rate),
        second: -(sine * acceleration).plus_product(cosine, square),
    };
    Angle {
        sine: sine_jet,
        cosine: cosine_jet,
        sine_change: Jet { value: zero, ..sine_jet },
        cosine_change: Jet { value: zero, ..cosine_jet },
    }
}

#[inline(always)]
fn jet<R: Real>(value: Triple<R>, first: Triple<R>, second: Triple<R>) -> Triple<Jet<R>> {
    Triple::new(
        Jet { value: value.x, first: first.x, second: second.x },
        Jet { value: value.y, first: first.y, second: second.y },
        Jet { value: value.z, first: first.z, second: second.z },
    )
}
