//! Random numbers by position: SplitMix64 [Steele, Lea and Flood 2014], so that number k of a stream needs no number before.

const STEP: u64 = 0x9e37_79b9_7f4a_7c15;

fn mixed(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// Number `index` of the stream `stream` of `seed`.
pub(super) fn bits(seed: u64, stream: u64, index: u64) -> u64 {
    let start = mixed(mixed(seed.wrapping_add(STEP)).wrapping_add(stream.wrapping_add(1).wrapping_mul(STEP)));
    mixed(start.wrapping_add(index.wrapping_add(1).wrapping_mul(STEP)))
}

/// Number `index` of the stream `stream` of `seed`, between 0 and 1, both excluded.
pub(super) fn fraction(seed: u64, stream: u64, index: u64) -> f64 {
    ((bits(seed, stream, index) >> 12) as f64 + 0.5) / (1_u64 << 52) as f64
}

/// The numbers below `count`, shuffled [Fisher and Yates, by Durstenfeld 1964].
pub(super) fn permutation(count: usize, seed: u64, stream: u64) -> Vec<usize> {
    let mut order: Vec<usize> = (0..count).collect();
    for last in (1..count).rev() {
        // The product's upper half is even to within 2^-40 for as many members as there may be.
        let choice = (u128::from(bits(seed, stream, last as u64)) * (last as u128 + 1)) >> 64;
        order.swap(last, choice as usize);
    }
    order
}

#[cfg(test)]
#[path = "../../../tests/unit/sweep/sampling/random.rs"]
mod tests;
