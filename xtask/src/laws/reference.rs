//! The motion of a case, by the fifth-order method of Dormand and Prince with steps that resolve the smallest length of the law;
//! jumps are resolved by short steps.

use super::model::{Case, END};

/// Local error of a step, relative to the largest values.
const TOLERANCE: f64 = 1e-11;
/// Shortest step [s]: a jump within it errs by as much.
const SHORTEST: f64 = 1e-12;
/// Maximum number of steps: beyond it the motion slides along a jump, and has no reference.
const MAX_STEPS: usize = 3_000_000;

const NODES: [f64; 7] = [0.0, 0.2, 0.3, 0.8, 8.0 / 9.0, 1.0, 1.0];
const STAGES: [[f64; 6]; 7] = [
    [0.0; 6],
    [0.2, 0.0, 0.0, 0.0, 0.0, 0.0],
    [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0, 0.0],
    [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0, 0.0, 0.0, 0.0],
    [19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0, 0.0, 0.0],
    [9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0, 0.0],
    [35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
];
/// Weights of the fifth order less those of the fourth.
const ERRORS: [f64; 7] =
    [71.0 / 57600.0, 0.0, -71.0 / 16695.0, 71.0 / 1920.0, -17253.0 / 339_200.0, 22.0 / 525.0, -1.0 / 40.0];

/// Position and velocity at the end, and the largest magnitude of each.
pub(super) struct Reference {
    pub(super) end: [f64; 2],
    pub(super) largest: [f64; 2],
}

/// The reference with an initial velocity that is changed by a factor; none if it would take too many steps.
pub(super) fn reference(case: &Case, factor: f64) -> Option<Reference> {
    let (mut time, mut state) = (0.0, [0.0, factor * case.velocity, 0.0]);
    let mut largest = [1e-3, case.velocity, 1e-3];
    let mut size = 1e-4;
    for _ in 0..MAX_STEPS {
        let fastest = state[1].abs().max(0.1) + 1.0;
        let h = f64::min(size, 0.25 * case.width / fastest).min(END - time);
        let mut rates = [[0.0; 3]; 7];
        let mut end = state;
        for stage in 0..7 {
            let mut at = state;
            for (k, value) in at.iter_mut().enumerate() {
                *value += h * (0..stage).map(|j| STAGES[stage][j] * rates[j][k]).sum::<f64>();
            }
            rates[stage] = case.rates(time + NODES[stage] * h, at);
            end = at;
        }
        let miss = |k: usize| (h * (0..7).map(|j| ERRORS[j] * rates[j][k]).sum::<f64>() / largest[k]).abs();
        let error = (0..3).map(miss).fold(0.0, f64::max) / TOLERANCE;
        let factor = (0.9 * error.max(1e-10).powf(-0.2)).clamp(0.1, 5.0);
        if error <= 1.0 || h <= SHORTEST {
            time += h;
            state = end;
            for (most, value) in largest.iter_mut().zip(state) {
                *most = most.max(value.abs());
            }
            if time >= END {
                return Some(Reference { end: [state[0], state[1]], largest: [largest[0], largest[1]] });
            }
        }
        size = (h * factor).max(SHORTEST);
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn most_cases_have_a_reference() {
        let found = (0..20).filter_map(|index| reference(&Case::new(3, index), 1.0)).count();
        assert!(found >= 18, "{found}");
    }
}
