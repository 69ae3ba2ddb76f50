//! Enclosures: bounds of a function and of its first and second derivative over an interval of a parameter [Moore 1966].

use lissom_mechanics::law::{EVERYTHING, Enclosure, Interval};

use super::jet::Function;
use super::noise;
use super::number::Number;

/// What has a kink or a jump somewhere in its interval.
fn unknown(value: Interval) -> Enclosure {
    Enclosure { value, first: EVERYTHING, second: EVERYTHING }
}

/// Whether a function of one number has a kink or a jump within an interval.
fn switches(function: Function, u: Interval) -> bool {
    let level = |shift: f64| u.map(|value| (value + shift).floor());
    let has_levels = |[one, other]: Interval| one != other;
    match function {
        Function::Abs | Function::Sign | Function::Step => u[0] <= 0.0 && u[1] >= 0.0,
        Function::Floor => has_levels(level(0.0)),
        Function::Ceil => has_levels(u.map(f64::ceil)),
        Function::Round => has_levels(level(0.5)),
        Function::Tan => u.of(Function::Tan) == EVERYTHING,
        _ => false,
    }
}

impl Number for Enclosure {
    fn constant(value: f64) -> Self {
        Self::of_constant([value; 2])
    }

    fn plus(self, other: Self) -> Self {
        Self {
            value: self.value.plus(other.value),
            first: self.first.plus(other.first),
            second: self.second.plus(other.second),
        }
    }

    fn minus(self, other: Self) -> Self {
        Self {
            value: self.value.minus(other.value),
            first: self.first.minus(other.first),
            second: self.second.minus(other.second),
        }
    }

    fn times(self, other: Self) -> Self {
        Self::times(&self, &other)
    }

    fn over(self, other: Self) -> Self {
        let inverse = Interval::constant(1.0).over(other.value);
        if other.is_constant() {
            return Self::times(&self, &Self::of_constant(inverse));
        }
        let square = inverse.square();
        let cube = square.times(inverse);
        let value = self.value.over(other.value);
        Self { value, ..Self::times(&self, &other.through([inverse, square.scaled(-1.0), cube.scaled(2.0)])) }
    }

    fn to_the(self, exponent: Self) -> Self {
        let value = self.value.to_the(exponent.value);
        if self.is_constant() && exponent.is_constant() {
            return Self::of_constant(value);
        }
        let [n, other] = exponent.value;
        if exponent.is_constant() && n == other {
            let power = |by: f64| self.value.to_the([n - by; 2]);
            return self.through([value, power(1.0).scaled(n), power(2.0).scaled(n * (n - 1.0))]);
        }
        Self { value, ..Self::times(&exponent, &self.of(Function::Ln)).of(Function::Exp) }
    }

    fn of(self, function: Function) -> Self {
        let value = self.value.of(function);
        if self.is_constant() {
            return Self::of_constant(value);
        }
        if switches(function, self.value) {
            return unknown(value);
        }
        self.through(function.derivatives(self.value))
    }

    fn of_two(self, function: Function, other: Self) -> Self {
        let (u, v) = (self.value, other.value);
        let value = u.of_two(function, v);
        if self.is_constant() && other.is_constant() {
            return Self::of_constant(value);
        }
        let is_above = u[0] > v[1];
        let is_below = u[1] < v[0];
        match function {
            Function::Max if is_above => self,
            Function::Max if is_below => other,
            Function::Min if is_above => other,
            Function::Min if is_below => self,
            // d atan2(u, v) = (v du - u dv)/(u² + v²), and once more by the quotient rule.
            Function::Atan2 if v[0] > 0.0 || u[0] > 0.0 || u[1] < 0.0 => {
                let square = u.square().plus(v.square());
                let slope = v.times(self.first).minus(u.times(other.first)).over(square);
                let bend = v.times(self.second).minus(u.times(other.second));
                let growth = u.times(self.first).plus(v.times(other.first)).scaled(2.0);
                Self { value, first: slope, second: bend.minus(slope.times(growth)).over(square) }
            }
            // √(u² + v²)
            Function::Hypot => {
                let first = u.times(self.first).plus(v.times(other.first)).over(value);
                let squares = self.first.square().plus(other.first.square());
                let bend = u.times(self.second).plus(v.times(other.second));
                Self { value, first, second: squares.minus(first.square()).plus(bend).over(value) }
            }
            Function::Mod if other.is_constant() && v[0] == v[1] => {
                let [low, high] = u.map(|value| (value / v[0]).floor());
                if low == high { Self { value, ..self } } else { unknown(value) }
            }
            Function::Random | Function::Normal => {
                let is_one = u[0] == u[1] && noise::is_one(v);
                if is_one { Self::of_constant(value) } else { unknown(value) }
            }
            Function::Less | Function::LessOrEqual | Function::Greater | Function::GreaterOrEqual
                if value[0] == value[1] =>
            {
                Self::of_constant(value)
            }
            _ => unknown(value),
        }
    }

    fn choose(self, one: Self, other: Self) -> Self {
        match self.value {
            [0.0, 0.0] => other,
            [low, high] if low > 0.0 || high < 0.0 => one,
            _ => unknown(self.value.choose(one.value, other.value)),
        }
    }
}

#[cfg(test)]
#[path = "../../tests/unit/expression/enclosure.rs"]
mod tests;
