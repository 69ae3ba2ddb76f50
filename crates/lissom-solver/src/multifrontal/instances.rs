//! The kernels, compiled here once for each field of numbers and level of vector instructions. If solvers consisted of
//! generic code only, every crate that names one would compile it again.

use num_complex::Complex64;
use pulp::{Arch, Simd, WithSimd};

use super::factorisation::FactorPart;
use super::small;
use super::sweeps::{Backward, Forward};
use crate::entries::largest_magnitude;
use crate::report::{FactorError, Monitor};
use crate::scalar::Scalar;

/// The operations that take most of the time of factorisations and solves. Implemented for every [`Scalar`].
pub trait Kernels: Scalar {
    /// Whether small fronts have an elimination of their own.
    fn eliminates_small(processor: Arch) -> bool;

    /// Factorises a subtree, or the top; returns the monitor and the largest magnitude in U.
    ///
    /// # Errors
    /// As of [`factor`](crate::LinearSolver::factor).
    fn factor_part(processor: Arch, part: FactorPart<'_, Self>) -> Result<(Monitor, f64), FactorError>;

    /// Forward substitution in some parts.
    fn forward(processor: Arch, forward: Forward<'_, Self>);

    /// Backward substitution in some parts.
    fn backward(processor: Arch, backward: Backward<'_, Self>);

    /// Largest magnitude, if all values are finite.
    fn largest(processor: Arch, values: Largest<'_, Self>) -> Option<f64>;
}

/// Largest magnitude, if all values are finite.
pub struct Largest<'a, S> {
    pub(super) values: &'a [S],
}

impl<S: Scalar> pulp::WithSimd for Largest<'_, S> {
    type Output = Option<f64>;

    #[expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]
    #[inline(always)]
    fn with_simd<V: pulp::Simd>(self, _: V) -> Self::Output {
        largest_magnitude(self.values)
    }
}

/// With the widest vectors of the processor.
fn widest<Op: WithSimd>(processor: Arch, op: Op) -> Op::Output {
    processor.dispatch(op)
}

/// With vectors of at most four numbers: complex kernels gain little from wider ones, and take long to compile.
fn of_four<Op: WithSimd>(processor: Arch, op: Op) -> Op::Output {
    #[cfg(target_arch = "x86_64")]
    match processor {
        Arch::V4(simd) => Simd::vectorize(*simd, op),
        Arch::V3(simd) => Simd::vectorize(simd, op),
        _ => Simd::vectorize(pulp::Scalar, op),
    }
    #[cfg(not(target_arch = "x86_64"))]
    processor.dispatch(op)
}

macro_rules! compile {
    ($field:ty, $dispatch:ident) => {
        impl Kernels for $field {
            fn eliminates_small(processor: Arch) -> bool {
                small::is_for::<$field>(!matches!(processor, Arch::Scalar))
            }

            #[inline(never)]
            fn factor_part(
                processor: Arch,
                part: FactorPart<'_, Self>,
            ) -> Result<(Monitor, f64), FactorError> {
                $dispatch(processor, part)
            }

            #[inline(never)]
            fn forward(processor: Arch, forward: Forward<'_, Self>) {
                $dispatch(processor, forward);
            }

            #[inline(never)]
            fn backward(processor: Arch, backward: Backward<'_, Self>) {
                $dispatch(processor, backward);
            }

            #[inline(never)]
            fn largest(processor: Arch, values: Largest<'_, Self>) -> Option<f64> {
                $dispatch(processor, values)
            }
        }
    };
}

compile!(f64, widest);
compile!(Complex64, of_four);
