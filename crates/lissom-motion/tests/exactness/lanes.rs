//! Numbers side by side against one at a time, on every kind of vector that this processor has.

use std::f64::consts::TAU;

use lissom_motion::{
    Block, CurvedTangent, DualMatrix, Lanes, Motion, Pose, Real, Screw, TangentOperator, Vector6, WIDTH,
    rotation_part, translation_part,
};
use proptest::prelude::*;
use pulp::{Simd, WithSimd};

use crate::arguments::{any_twist, plain_vector};

/// Every level of vector instructions this processor has, and none.
fn processors() -> Vec<pulp::Arch> {
    let mut processors = vec![pulp::Arch::Scalar, pulp::Arch::new()];
    #[cfg(target_arch = "x86_64")]
    processors.extend(pulp::x86::V3::try_new().map(pulp::Arch::V3));
    processors
}

/// So many of the last results of [`everything`] grow without bounds towards a whole turn.
const INVERSE: usize = 5;

/// What the crate makes of a twist `d`, a vector `a`, a wrench `w` and a motion, six numbers each.
fn everything<R: Real>([d, a, w]: [Screw<R>; 3], motion: Pose<R>) -> Vec<[R; 6]> {
    let exponential = Pose::exponential(d);
    let tangent = TangentOperator::new(d);
    let curved = CurvedTangent::new(d);
    let inverse = TangentOperator::inverse(d);
    let (logarithm, inverse_there) = motion.logarithm_and_inverse_tangent();
    let quaternion = |pose: Pose<R>| {
        let [w, x, y, z, ..] = pose.components();
        Screw::from_components([w, x, y, z, w, x])
    };
    let place = |pose: Pose<R>| Screw::new(pose.position, pose.position);
    let screws = [
        quaternion(exponential),
        place(exponential),
        motion.logarithm(),
        logarithm,
        inverse_there.times(a),
        inverse_there.transpose_times(w),
        quaternion(motion.relative_to(exponential)),
        place(motion.relative_to(exponential)),
        quaternion(motion * exponential),
        place(motion * exponential),
        place(motion.inverse()),
        exponential.adjoint_times(a),
        exponential.adjoint_inverse_times(a),
        exponential.adjoint_transpose_times(w),
        exponential.adjoint_inverse_transpose_times(w),
        d.tangent_times(a),
        d.tangent_transpose_times(w),
        d.lie_bracket(a),
        d.coadjoint_times(w),
        tangent.times(a),
        tangent.transpose_times(w),
        tangent.derivative_transpose_times(a, w),
        tangent.rate_times(w, a),
        d.inverse_tangent_times(a),
        d.inverse_tangent_transpose_times(w),
        inverse.times(a),
        inverse.transpose_times(w),
        inverse.derivative_transpose_times(a, w),
    ];
    let mut rows = [a, w, d, a + w, a - w, w + d];
    curved.operator.derivative(a).transposed().add_to(&mut rows);
    tangent.transpose_derivative(w).add_to(&mut rows);
    curved.hessian(a, w).add_to(&mut rows);
    DualMatrix::coadjoint(w).add_to(&mut rows);
    let rows = tangent.matrix().transpose_times_rows(&rows);
    let rows = motion.adjoint_inverse().times_from_right(&rows);
    rows.into_iter().chain(screws).map(Screw::components).collect()
}

struct SideBySide<'a> {
    arguments: &'a [[Vector6; 3]; WIDTH],
    motions: &'a [Motion; WIDTH],
}

impl WithSimd for SideBySide<'_> {
    /// By result, lane after lane.
    type Output = Vec<[Block; 6]>;

    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let mut results = Vec::new();
        for part in 0..Lanes::<S>::PARTS {
            let gather = |value: &dyn Fn(usize) -> f64| Lanes::load(simd, &std::array::from_fn(value), part);
            let arguments = std::array::from_fn(|n| {
                Screw::from_components(std::array::from_fn(|i| gather(&|k| self.arguments[k][n][i])))
            });
            let motion = Pose::from_components(std::array::from_fn(|i| {
                gather(&|k| Pose::from(&self.motions[k]).components()[i])
            }));
            for (n, lanes) in everything(arguments, motion).into_iter().enumerate() {
                results.resize(results.len().max(n + 1), [[0.0; WIDTH]; 6]);
                for i in 0..6 {
                    lanes[i].store(&mut results[n][i], part);
                }
            }
        }
        results
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(1000) })]

    #[test]
    fn lanes_agree_with_single_numbers(
        twists in proptest::array::uniform8(any_twist()),
        others in proptest::array::uniform8((plain_vector(), plain_vector(), any_twist())),
        scale in prop_oneof![Just(1.0), Just(0.1), Just(0.02), Just(1e-6), Just(0.0)],
    ) {
        // Scaled down as well, because eight angles of any size are rarely all small.
        let arguments = std::array::from_fn(|k| [twists[k] * scale, others[k].0, others[k].1]);
        let motions = std::array::from_fn(|k| Motion::exponential(&(others[k].2 * scale)));
        for processor in processors() {
            let results = processor.dispatch(SideBySide { arguments: &arguments, motions: &motions });
            for lane in 0..WIDTH {
                let single = everything(arguments[lane].map(|v| Screw::from(&v)), Pose::from(&motions[lane]));
                let size = (1.0 + translation_part(&arguments[lane][0]).norm()).powi(2)
                    * (1.0 + motions[lane].position.norm());
                let to_whole_turn = 1.0 - rotation_part(&arguments[lane][0]).norm_squared() / TAU.powi(2);
                prop_assert_eq!(results.len(), single.len());
                for (n, (lanes, single)) in results.iter().zip(&single).enumerate() {
                    let largest = single.iter().fold(size, |largest, value| largest.max(value.abs()));
                    for i in 0..6 {
                        let amplified = if n + INVERSE < single.len() { 1.0 } else { 1.0 / to_whole_turn };
                        let error = (lanes[i][lane] - single[i]).abs();
                        prop_assert!(
                            error <= 4e-15 * largest * amplified,
                            "{:?}, result {}, component {}: {:e} of {:e}", processor, n, i, error, largest
                        );
                    }
                }
            }
        }
    }
}

#[test]
fn a_lane_that_is_no_number_is_below_nothing() {
    struct Below(f64);
    impl WithSimd for Below {
        type Output = [bool; 2];
        fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
            let mut block = [1.0; WIDTH];
            block[WIDTH - 1] = self.0;
            let last = Lanes::load(simd, &block, Lanes::<S>::PARTS - 1);
            [last.all_below(2.0), (-last).all_below(0.0)]
        }
    }
    for processor in processors() {
        assert_eq!(processor.dispatch(Below(1.5)), [true, true], "{processor:?}");
        assert_eq!(processor.dispatch(Below(2.0)), [false, true], "{processor:?}");
        assert_eq!(processor.dispatch(Below(-1.0)), [true, false], "{processor:?}");
        assert_eq!(processor.dispatch(Below(f64::NAN)), [false, false], "{processor:?}");
    }
}
