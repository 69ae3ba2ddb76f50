//! Tests of `superelement::load_stiffness`, a module of it.

use super::*;
use crate::superelement::{Damping, ReducedMatrices};
use lissom_mechanics::elements::inertia::Gravity;
use lissom_mechanics::kinematics::NodeId;

const LENGTH: f64 = 2.0;
/// E A and E I of the bar.
const STIFFNESS: [f64; 2] = [3e6, 40.0];

/// A bar along y from the floating frame, as one cubic beam element.
fn bar() -> Part {
    let [axial, bending] = STIFFNESS.map(|own| own / LENGTH);
    let mut stiffness = DMatrix::zeros(12, 12);
    stiffness[(7, 7)] = axial;
    stiffness[(10, 10)] = bending;
    // A slope in +x is a rotation about -z, one in +z a rotation about +x.
    for (shift, turn, sign) in [(6, 11, -1.0), (8, 9, 1.0)] {
        let coupling = -6.0 * sign * bending / LENGTH;
        stiffness[(shift, shift)] = 12.0 * bending / (LENGTH * LENGTH);
        stiffness[(turn, turn)] = 4.0 * bending;
        (stiffness[(shift, turn)], stiffness[(turn, shift)]) = (coupling, coupling);
    }
    let mass = DMatrix::from_fn(12, 12, |i, j| if i == j { 1.0 } else { 0.1 / (1.0 + (i + j) as f64) });
    let matrices =
        ReducedMatrices { mass, stiffness, damping: Damping::None, preload: Vec::new(), geometric: None };
    let places = [Vector3::zeros(), Vector3::new(0.0, LENGTH, 0.0)];
    let gravity = Gravity::constant(Vector3::zeros());
    Part::new((vec![NodeId::new(1), NodeId::new(2)], Vec::new()), (0, &places), matrices, gravity)
}

/// ∫ w'² dy of the cubic that starts with zero displacement and slope and ends with these, by Simpson's rule.
fn shortening(displacement: f64, slope: f64) -> f64 {
    let parts = 400_usize;
    let square = |part: f64| {
        let x = part / parts as f64;
        let own = displacement / LENGTH * 6.0 * (x - x * x) + slope * (3.0 * x * x - 2.0 * x);
        own * own
    };
    let whole = (0..parts).map(|k| {
        let k = k as f64;
        square(k) + 4.0 * square(k + 0.5) + square(k + 1.0)
    });
    whole.sum::<f64>() * LENGTH / parts as f64 / 6.0
}

/// Work of an axial force on the shortening over the energy of bending, and that of centrifugal forces in
/// addition.
#[test]
fn the_share_is_that_of_a_cubic_under_an_axial_force() {
    let element = bar();
    let estimate = LoadStiffness::of(&element);
    for (displacement, slope) in [(0.02, 0.0), (0.0, 0.03), (0.02, 0.03), (0.02, -0.03), (-0.01, 0.04)] {
        for (shift, turn, sign) in [(6, 11, -1.0), (8, 9, 1.0)] {
            for stretch in [1e-5, -1e-5] {
                let mut deformed = DVector::zeros(12);
                (deformed[shift], deformed[turn]) = (displacement, sign * slope);
                let stored = (&element.stiffness * &deformed).dot(&deformed);
                let moved = (&element.mass * &deformed).dot(&deformed)
                    + (&element.carried * &deformed).norm_squared() / element.total;
                deformed[7] = stretch;
                let force = &element.stiffness * &deformed;
                let share = |spin: Vector3| {
                    let all = (deformed.as_slice(), force.as_slice(), &spin);
                    estimate.share(&element, all).expect("it bends")
                };
                let pull = STIFFNESS[0] / LENGTH * stretch.abs();
                let wanted = pull * shortening(displacement, slope) / stored;
                let found = share(Vector3::zeros());
                assert!((found / wanted - 1.0).abs() < 1e-6, "{displacement} {slope}: {found}, {wanted}");
                let (found, wanted) = (share(Vector3::new(0.3, 0.0, 0.4)), wanted + 0.25 * moved / stored);
                assert!((found / wanted - 1.0).abs() < 1e-6, "spins: {found}, {wanted}");
            }
        }
    }
}

/// An element that bends no more than it is stretched has no estimate.
#[test]
fn a_bar_that_is_only_stretched_has_no_share() {
    let element = bar();
    let estimate = LoadStiffness::of(&element);
    for bent in [0.0, 0.9e-3, 1.1e-3] {
        let mut deformed = DVector::zeros(12);
        (deformed[6], deformed[7]) = (bent, 1e-3);
        let force = &element.stiffness * &deformed;
        let share = estimate.share(&element, (deformed.as_slice(), force.as_slice(), &Vector3::zeros()));
        assert_eq!(share.is_some(), bent > 1e-3, "{bent}: {share:?}");
    }
}
