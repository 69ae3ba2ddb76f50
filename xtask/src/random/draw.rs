//! Random numbers of a case: SplitMix64 [Steele, Lea and Flood 2014], so that a seed determines the case on every machine.

/// A stream of random numbers.
pub(crate) struct Draw(u64);

impl Draw {
    /// The stream of case `index` of `seed`.
    pub(crate) fn new(seed: u64, index: u64) -> Self {
        let mut draw =
            Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ index.wrapping_mul(0xd1b5_4a32_d192_ed03));
        draw.bits();
        draw
    }

    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// From 0 to 1, the latter excluded.
    pub(crate) fn fraction(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Between two numbers, in thousandths of their distance: models are to be read.
    pub(crate) fn between(&mut self, least: f64, most: f64) -> f64 {
        let value = least + (most - least) * (self.fraction() * 1000.0).floor() / 1000.0;
        (value * 1e6).round() / 1e6
    }

    /// Between two positive numbers, evenly over their logarithms.
    pub(crate) fn size(&mut self, least: f64, most: f64) -> f64 {
        let value = least * (most / least).powf(self.fraction());
        let digits = 10.0_f64.powi(2 - value.log10().floor() as i32);
        (value * digits).round() / digits
    }

    /// One of the numbers below `count`.
    pub(crate) fn below(&mut self, count: usize) -> usize {
        ((self.fraction() * count as f64) as usize).min(count.saturating_sub(1))
    }

    /// One of several.
    pub(crate) fn of<T: Clone>(&mut self, several: &[T]) -> T {
        several[self.below(several.len())].clone()
    }

    /// Whether something of this probability happens.
    pub(crate) fn chance(&mut self, probability: f64) -> bool {
        self.fraction() < probability
    }

    /// A direction, not of length one.
    pub(crate) fn direction(&mut self) -> [f64; 3] {
        if self.chance(0.4) {
            let mut axis = [0.0; 3];
            axis[self.below(3)] = if self.chance(0.5) { 1.0 } else { -1.0 };
            return axis;
        }
        loop {
            let axis = [0, 1, 2].map(|_| self.between(-1.0, 1.0));
            let length = axis.iter().map(|part| part * part).sum::<f64>();
            if (0.1..1.0).contains(&length) {
                return axis;
            }
        }
    }

    /// A direction perpendicular to another.
    pub(crate) fn perpendicular(&mut self, axis: [f64; 3]) -> [f64; 3] {
        loop {
            let other = self.direction();
            let cross = [
                axis[1] * other[2] - axis[2] * other[1],
                axis[2] * other[0] - axis[0] * other[2],
                axis[0] * other[1] - axis[1] * other[0],
            ];
            if cross.iter().map(|part| part * part).sum::<f64>() > 0.01 {
                return cross;
            }
        }
    }
}
