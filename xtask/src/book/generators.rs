//! Table of the results of `cargo xtask figures`: a name, as in a chapter's marker, and the function that makes the text.

use super::fragment::Fragment;
use super::{
    BookError, Studio, claims, comparison, conditioning, convergence, efficiency, factorization, roundoff,
    simulation, work,
};

/// Makes the text between the markers of one name.
pub(super) struct Generator {
    /// As in the marker.
    pub(super) name: &'static str,
    /// Whether it takes minutes and must be requested.
    pub(super) is_long: bool,
    /// Makes it.
    pub(super) make: fn(&Studio) -> Result<Fragment, BookError>,
}

const fn quick(name: &'static str, make: fn(&Studio) -> Result<Fragment, BookError>) -> Generator {
    Generator { name, is_long: false, make }
}

/// All of them.
pub(super) const GENERATORS: &[Generator] = &[
    quick("claims", claims::claims),
    quick("claims-penalty", claims::penalties),
    quick("tip-crank", simulation::tip_crank),
    quick("conditioning-steps", conditioning::steps),
    quick("conditioning-mass", conditioning::mass),
    quick("conditioning-contradiction", conditioning::contradiction),
    quick("conditioning-tip-crank", conditioning::tip_crank),
    quick("conditioning-limits", conditioning::limits),
    quick("factorization-tip-crank", factorization::tip_crank),
    quick("factorization-steps", factorization::steps),
    quick("any-step", factorization::any_step),
    quick("roundoff-pendulum", roundoff::pendulum),
    quick("roundoff-energy", roundoff::energy),
    quick("convergence-tip-crank", convergence::tip_crank),
    quick("convergence-components", convergence::components),
    quick("convergence-smooth-start", convergence::smooth_start),
    quick("convergence-tip-crank-smooth", convergence::tip_crank_smooth),
    quick("comparison-oscillator", comparison::oscillator),
    quick("comparison-orders", comparison::orders),
    quick("comparison-energy", comparison::energy),
    Generator { name: "efficiency", is_long: true, make: efficiency::table },
    Generator { name: "work-against-error", is_long: true, make: work::table },
    Generator { name: "convergence-tip-crank-long", is_long: true, make: convergence::tip_crank_long },
];
