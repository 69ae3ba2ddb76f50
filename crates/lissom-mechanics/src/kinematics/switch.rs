//! Switching functions: numbers that change their sign where a law has a kink or a jump, at a configuration.
//!
//! Most laws have two sides, 1 above zero and -1 below. A law with levels, such as `floor`, is continued from the level k on which
//! a step began, which is written as the side 2k + 1: it is never zero, which stands for not known.

/// A switching function at a configuration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Switch {
    /// It has the sign of the known side until the law switches.
    pub number: f64,
    /// Side at the configuration, and that beyond the nearer end of the known level, of a law with levels.
    pub levels: Option<[f64; 2]>,
}

impl From<f64> for Switch {
    fn from(number: f64) -> Self {
        Self { number, levels: None }
    }
}

impl Switch {
    /// Switch of a law that has its level at the integer part of `argument`, continued from `side`; 0 for not known.
    pub fn of_level(argument: f64, side: f64) -> Self {
        let own = side_of_level(argument.floor());
        let known = if side == 0.0 { own } else { side };
        let level = level_of_side(known);
        let (above, below) = (argument - level, level + 1.0 - argument);
        let beyond = side_of_level(if above < below { level - 1.0 } else { level + 1.0 });
        Self { number: known.signum() * above.min(below), levels: Some([own, beyond]) }
    }

    /// The side at the configuration.
    pub fn side(&self) -> f64 {
        self.levels.map_or(if self.number > 0.0 { 1.0 } else { -1.0 }, |[own, _]| own)
    }

    /// The side on the other side of the zero from a known one.
    pub fn beyond(&self, known: f64) -> f64 {
        self.levels.map_or(-known, |[_, beyond]| beyond)
    }
}

/// The side that represents a level.
fn side_of_level(level: f64) -> f64 {
    2.0 * level + 1.0
}

/// The level that a side represents.
pub fn level_of_side(side: f64) -> f64 {
    0.5 * (side - 1.0)
}

#[cfg(test)]
#[path = "../../tests/unit/kinematics/switch.rs"]
mod tests;
