//! Generic joint: locks chosen translations and rotations of the tip in the joint frame's axes.
//!
//! ```text
//! locked translation     x_i = 0, in the base's axes
//! locked rotations       three: R_32 = R_13 = R_21 = 0;   all but that about c: the base's other axes are perpendicular
//!                        to the tip's axis c;   about c alone: the base's axis c+1 is perpendicular to the tip's c+2
//! ```
//!
//! Every rotational equation is an entry of R, with the sign for which it approximates the angle for small rotations.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{Real, Screw, Triple};

use super::base_axes::{force_wrench, row};
use super::kind::{Build, JointKind};
use super::relative_increment::{CoordinateIncrement, RelativeIncrement};
use super::{AnyJoint, EquationCount, Joint, MAX_CONSTANTS, MAX_COORDINATES, MAX_EQUATIONS};
use crate::ports::Ports;
use crate::registry::{ParameterError, ParameterType, required};

/// What may be locked: translations along the joint frame's axes, and rotations about them.
const WORDS: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "generic",
    summary: "Locks chosen translations and rotations of the tip in the axes of the base.",
    sample: "locked = [\"x\", \"y\", \"rz\"]",
    parameters: &[required(
        "locked",
        ParameterType::Choices(&WORDS),
        "",
        "Locked motions: x along `axis`, y along `second_axis`, z perpendicular to both; rx, ry, rz about them.",
    )],
    ports: Ports::AXES_OF_MODEL,
    build: Build::Relative(|parameters, _| {
        let words = parameters.words("locked")?;
        if words.is_empty() {
            return Err(ParameterError::new("locked", "is empty: the joint would have no effect"));
        }
        Ok(locking(WORDS.map(|word| words.iter().any(|given| given == word))))
    }),
};

/// The joint that locks these of [`WORDS`].
pub(super) fn locking(locked: [bool; 6]) -> Box<dyn AnyJoint> {
    match locked[..3].iter().filter(|&&locked| locked).count() {
        0 => Box::new(Generic::<0>::new(locked)),
        1 => Box::new(Generic::<1>::new(locked)),
        2 => Box::new(Generic::<2>::new(locked)),
        _ => Box::new(Generic::<3>::new(locked)),
    }
}

/// Locks some of the six relative degrees of freedom, `LENGTHS` of them translations.
#[derive(Clone, Copy, Debug)]
pub struct Generic<const LENGTHS: usize> {
    locked: [bool; 6],
}

impl<const LENGTHS: usize> Generic<LENGTHS> {
    fn new(locked: [bool; 6]) -> Self {
        Self { locked }
    }

    /// The only rotation that is locked, or the only one that is not, with the number of locked ones.
    fn rotations(self) -> (usize, Option<usize>) {
        let locked = &self.locked[3..];
        let count = locked.iter().filter(|&&locked| locked).count();
        let single = match count {
            1 => locked.iter().position(|&locked| locked),
            2 => locked.iter().position(|&locked| !locked),
            _ => None,
        };
        (count, single)
    }
}

const fn names() -> [[&'static str; 6]; 64] {
    let of = ["position x", "position y", "position z", "rotation x", "rotation y", "rotation z"];
    let mut all = [[""; 6]; 64];
    let mut mask = 0;
    while mask < 64 {
        let (mut axis, mut count) = (0, 0);
        while axis < 6 {
            if mask >> axis & 1 == 1 {
                all[mask][count] = of[axis];
                count += 1;
            }
            axis += 1;
        }
        mask += 1;
    }
    all
}

/// Names of the equations by the locked directions, as a binary number.
static EQUATIONS: [[&str; 6]; 64] = names();

impl<const LENGTHS: usize> Joint for Generic<LENGTHS> {
    const EQUATIONS: EquationCount = EquationCount { lengths: LENGTHS, angles: 3 };

    fn equations(&self) -> &'static [&'static str] {
        let mask: usize = self.locked.iter().enumerate().map(|(k, &locked)| usize::from(locked) << k).sum();
        &EQUATIONS[mask][..mask.count_ones() as usize]
    }

    /// 1 at the only locked translation, or at the only free one if two are locked; likewise 1 at the only free
    /// rotation, at the only locked one, and for each if all are locked.
    fn constants(&self) -> [f64; MAX_CONSTANTS] {
        let mut constants = [0.0; MAX_CONSTANTS];
        for axis in 0..3 {
            let is_single = self.locked[axis] == (LENGTHS == 1);
            constants[axis] = f64::from(is_single);
        }
        match self.rotations() {
            (2, Some(free)) => constants[3 + free] = 1.0,
            (1, Some(locked)) => constants[6 + locked] = 1.0,
            (3, _) => constants[9] = 1.0,
            _ => {}
        }
        constants
    }

    #[inline(always)]
    fn violation_change<R: Real>(
        increment: &RelativeIncrement<R>,
        _: &CoordinateIncrement<R>,
        constants: &[R; MAX_CONSTANTS],
    ) -> [R; MAX_EQUATIONS] {
        let Triple { x, y, z } = increment.position_change;
        let [a, b, c, free_x, free_y, free_z, x_alone, y_alone, z_alone, all] = *constants;
        let zero = x.like(0.0);
        let mut out = [zero; MAX_EQUATIONS];
        match LENGTHS {
            0 => {}
            1 => out[0] = x * a + y * b + z * c,
            2 => (out[0], out[1]) = (x * (b + c) + y * a, y * c + z * (a + b)),
            _ => (out[0], out[1], out[2]) = (x, y, z),
        }
        let change = &increment.rotation_change;
        let (first, second, third) = (row(change, 0), row(change, 1), row(change, 2));
        out[LENGTHS] = third.y * (all + free_y)
            - second.z * (free_z + x_alone)
            - third.x * (free_x + y_alone)
            - first.y * z_alone;
        out[LENGTHS + 1] = first.z * (all + free_z) + second.x * free_x - first.y * free_y;
        out[LENGTHS + 2] = second.x * all;
        out
    }

    #[inline(always)]
    fn wrench<R: Real>(
        increment: &RelativeIncrement<R>,
        _: &CoordinateIncrement<R>,
        constants: &[R; MAX_CONSTANTS],
        mu: &[R; MAX_EQUATIONS],
    ) -> (Screw<R>, [R; MAX_COORDINATES]) {
        let [a, b, c, free_x, free_y, free_z, x_alone, y_alone, z_alone, all] = *constants;
        let zero = mu[0].like(0.0);
        let force = match LENGTHS {
            0 => Triple::new(zero, zero, zero),
            1 => Triple::new(mu[0] * a, mu[0] * b, mu[0] * c),
            2 => Triple::new(mu[0] * (b + c), mu[0] * a + mu[1] * c, mu[1] * (a + b)),
            _ => Triple::new(mu[0], mu[1], mu[2]),
        };
        let [p, q, r] = [mu[LENGTHS], mu[LENGTHS + 1], mu[LENGTHS + 2]];
        // By rows a of R: the factors of e_b in Σ q_ab e_b × Rᵀ e_a.
        let rotation = increment.rotation();
        let first = Triple::new(zero, -(q * free_y + p * z_alone), q * (all + free_z));
        let second = Triple::new(r * all + q * free_x, zero, -(p * (free_z + x_alone)));
        let third = Triple::new(-(p * (free_x + y_alone)), p * (all + free_y), zero);
        let mut wrench = force_wrench(increment, force);
        wrench.rotation = first
            .cross(row(&rotation, 0))
            .plus_cross(second, row(&rotation, 1))
            .plus_cross(third, row(&rotation, 2));
        (wrench, [zero; MAX_COORDINATES])
    }
}
