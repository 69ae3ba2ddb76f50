//! Sobol's sequence with the direction numbers of Joe and Kuo 2008 (new-joe-kuo-6.21201), in the order of Gray codes, each
//! path shifted digit by digit by a random number of the seed: that keeps what makes the sequence even, and its first
//! point away from the corner.

use super::random::bits;
use super::{Draw, SamplingKind};

pub(super) const KIND: SamplingKind = SamplingKind {
    name: "sobol",
    summary: "Sobol sequence, shifted by the seed; most uniform if the number of members is a power of two.",
    draw: Draw::Fractions(fractions),
};

/// Binary digits of a point.
const DIGITS: usize = 32;

/// Degree, inner coefficients and first direction numbers of the primitive polynomials from the second dimension on.
const POLYNOMIALS: [(u32, u32, &[u32]); 20] = [
    (1, 0, &[1]),
    (2, 1, &[1, 3]),
    (3, 1, &[1, 3, 1]),
    (3, 2, &[1, 1, 1]),
    (4, 1, &[1, 1, 3, 3]),
    (4, 4, &[1, 3, 5, 13]),
    (5, 2, &[1, 1, 5, 5, 17]),
    (5, 4, &[1, 1, 5, 5, 5]),
    (5, 7, &[1, 1, 7, 11, 19]),
    (5, 11, &[1, 1, 5, 1, 1]),
    (5, 13, &[1, 1, 1, 3, 11]),
    (5, 14, &[1, 3, 5, 5, 31]),
    (6, 1, &[1, 3, 3, 9, 7, 49]),
    (6, 13, &[1, 1, 1, 15, 21, 21]),
    (6, 16, &[1, 3, 1, 13, 27, 49]),
    (6, 19, &[1, 1, 1, 15, 7, 5]),
    (6, 22, &[1, 3, 1, 15, 13, 25]),
    (6, 25, &[1, 1, 5, 5, 19, 61]),
    (7, 1, &[1, 3, 7, 11, 23, 15, 103]),
    (7, 4, &[1, 3, 7, 13, 13, 15, 69]),
];

/// Direction numbers of a dimension.
fn directions(dimension: usize) -> [u32; DIGITS] {
    let mut v = [0_u32; DIGITS];
    let Some(index) = dimension.checked_sub(1) else {
        for (i, v) in v.iter_mut().enumerate() {
            *v = 1 << (DIGITS - 1 - i);
        }
        return v;
    };
    let (degree, inner, first) = POLYNOMIALS[index];
    let s = degree as usize;
    for i in 0..s {
        v[i] = first[i] << (DIGITS - 1 - i);
    }
    // v_i = a_1 v_{i-1} + … + a_{s-1} v_{i-s+1} + v_{i-s} + v_{i-s} / 2^s, all sums modulo 2.
    for i in s..DIGITS {
        let mut next = v[i - s] ^ (v[i - s] >> s);
        for k in 1..s {
            if (inner >> (s - 1 - k)) & 1 == 1 {
                next ^= v[i - k];
            }
        }
        v[i] = next;
    }
    v
}

/// The points as whole numbers of 2^-32, without a shift.
fn points(dimension: usize, count: usize) -> impl Iterator<Item = u32> {
    let v = directions(dimension);
    let mut point = 0;
    (0..count).map(move |index| {
        let now = point;
        // The next Gray code differs in the place of the lowest zero of the index.
        point ^= v[(index as u32).trailing_ones().min(DIGITS as u32 - 1) as usize];
        now
    })
}

fn fractions(paths: usize, members: usize, seed: u64) -> Result<Vec<f64>, String> {
    let most = POLYNOMIALS.len() + 1;
    if paths > most {
        return Err(format!("Sobol's sequence is there for at most {most} varied paths, not {paths}"));
    }
    let mut all = vec![0.0; paths * members];
    for path in 0..paths {
        let shift = (bits(seed, path as u64, 0) >> 32) as u32;
        for (member, point) in points(path, members).enumerate() {
            all[member * paths + path] = (f64::from(point ^ shift) + 0.5) / (1_u64 << DIGITS) as f64;
        }
    }
    Ok(all)
}

#[cfg(test)]
#[path = "../../../tests/unit/sweep/sampling/sobol.rs"]
mod tests;
