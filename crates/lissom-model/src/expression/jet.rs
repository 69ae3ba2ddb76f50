//! Second-order jets: a value with its first and second derivative, and the functions of an expression.
//!
//! Legend: u argument, f function; (f∘u)' = f' u', (f∘u)'' = f'' u'² + f' u''.

use super::number::{Number, Point};

/// A value and its first and second derivative with respect to the variable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jet {
    /// Value.
    pub value: f64,
    /// First derivative.
    pub first: f64,
    /// Second derivative.
    pub second: f64,
}

/// A product in which an absent factor wins over an infinite one.
fn product(a: f64, b: f64) -> f64 {
    if a == 0.0 || b == 0.0 { 0.0 } else { a * b }
}

impl Jet {
    /// A number.
    pub fn constant(value: f64) -> Self {
        Self { value, first: 0.0, second: 0.0 }
    }

    /// The variable itself.
    pub fn variable(value: f64) -> Self {
        Self { value, first: 1.0, second: 0.0 }
    }

    /// Where two functions meet: the mean of their derivatives, as `sign(0)` is 0 for `abs`. So those of `max(t-1, 0) + min(t, 1)` add
    /// up to 1 at t = 1 as well.
    fn halfway_to(self, other: Self) -> Self {
        let [first, second] = [self.first + other.first, self.second + other.second];
        Self { value: self.value, first: 0.5 * first, second: 0.5 * second }
    }

    /// The chain rule, given `[f, f', f'']` at the value.
    fn through(self, [f, f1, f2]: [f64; 3]) -> Self {
        Self {
            value: f,
            first: product(f1, self.first),
            second: product(f2, self.first * self.first) + product(f1, self.second),
        }
    }
}

/// A function an expression may call.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the variants are the functions' usual names")]
pub enum Function {
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Sinh,
    Cosh,
    Tanh,
    Asinh,
    Acosh,
    Atanh,
    Exp,
    Ln,
    Log10,
    Sqrt,
    Cbrt,
    Abs,
    Sign,
    Floor,
    Ceil,
    Round,
    Step,
    Smoothstep,
    Min,
    Max,
    Atan2,
    Hypot,
    Mod,
    Random,
    Normal,
    Clamp,
    If,
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
}

/// The functions by name.
pub(crate) const NAMES: &[(&str, Function)] = &[
    ("sin", Function::Sin),
    ("cos", Function::Cos),
    ("tan", Function::Tan),
    ("asin", Function::Asin),
    ("acos", Function::Acos),
    ("atan", Function::Atan),
    ("sinh", Function::Sinh),
    ("cosh", Function::Cosh),
    ("tanh", Function::Tanh),
    ("asinh", Function::Asinh),
    ("acosh", Function::Acosh),
    ("atanh", Function::Atanh),
    ("exp", Function::Exp),
    ("ln", Function::Ln),
    ("log10", Function::Log10),
    ("sqrt", Function::Sqrt),
    ("cbrt", Function::Cbrt),
    ("abs", Function::Abs),
    ("sign", Function::Sign),
    ("floor", Function::Floor),
    ("ceil", Function::Ceil),
    ("round", Function::Round),
    ("step", Function::Step),
    ("smoothstep", Function::Smoothstep),
    ("min", Function::Min),
    ("max", Function::Max),
    ("atan2", Function::Atan2),
    ("hypot", Function::Hypot),
    ("mod", Function::Mod),
    ("random", Function::Random),
    ("normal", Function::Normal),
    ("clamp", Function::Clamp),
    ("if", Function::If),
];

impl Function {
    /// The function called `name`.
    pub fn named(name: &str) -> Option<Self> {
        NAMES.iter().find(|(known, _)| *known == name).map(|(_, function)| *function)
    }

    pub(super) fn arguments(self) -> usize {
        match self {
            Self::Clamp | Self::If => 3,
            Self::Min
            | Self::Max
            | Self::Atan2
            | Self::Hypot
            | Self::Mod
            | Self::Random
            | Self::Normal
            | Self::Less
            | Self::LessOrEqual
            | Self::Greater
            | Self::GreaterOrEqual => 2,
            _ => 1,
        }
    }

    pub(super) fn takes_many(self) -> bool {
        matches!(self, Self::Min | Self::Max)
    }
}

impl Point for Jet {
    fn value(self) -> f64 {
        self.value
    }
}

impl Number for Jet {
    fn constant(value: f64) -> Self {
        Self::constant(value)
    }

    fn plus(self, other: Self) -> Self {
        Self {
            value: self.value + other.value,
            first: self.first + other.first,
            second: self.second + other.second,
        }
    }

    fn minus(self, other: Self) -> Self {
        self.plus(other.scaled(-1.0))
    }

    fn scaled(self, factor: f64) -> Self {
        Self { value: factor * self.value, first: factor * self.first, second: factor * self.second }
    }

    fn times(self, other: Self) -> Self {
        Self {
            value: self.value * other.value,
            first: product(self.first, other.value) + product(self.value, other.first),
            second: product(self.second, other.value)
                + 2.0 * product(self.first, other.first)
                + product(self.value, other.second),
        }
    }

    fn over(self, other: Self) -> Self {
        let u = other.value;
        let inverse = other.through([1.0 / u, -1.0 / (u * u), 2.0 / (u * u * u)]);
        Self { value: self.value / u, ..self.times(inverse) }
    }

    /// A constant exponent keeps negative and zero bases; a varying one is `exp(g ln f)`.
    fn to_the(self, exponent: Self) -> Self {
        let n = exponent.value;
        if exponent.first == 0.0 && exponent.second == 0.0 {
            let u = self.value;
            let first = if n == 0.0 { 0.0 } else { n * u.powf(n - 1.0) };
            let second = if n == 0.0 || n == 1.0 { 0.0 } else { n * (n - 1.0) * u.powf(n - 2.0) };
            return self.through([u.powf(n), first, second]);
        }
        // The value without derivatives is the same to the last bit.
        Self { value: self.value.powf(n), ..exponent.times(self.of(Function::Ln)).of(Function::Exp) }
    }

    fn of(self, function: Function) -> Self {
        self.through(function.derivatives(self.value))
    }

    fn of_two(self, function: Function, other: Self) -> Self {
        let value = self.value.of_two(function, other.value);
        match function {
            Function::Max | Function::Min if self.value == other.value => self.halfway_to(other),
            Function::Max | Function::Min if value == self.value => self,
            Function::Max | Function::Min => other,
            Function::Atan2 => {
                // d atan2(u, v) = (v du - u dv)/(u² + v²), and once more by the quotient rule.
                let (r, w) = (self.times(self).plus(other.times(other)), [self.value, other.value]);
                let n = product(w[1], self.first) - product(w[0], other.first);
                let n1 = product(w[1], self.second) - product(w[0], other.second);
                let first = n / r.value;
                Self { value, first, second: (n1 - product(first, r.first)) / r.value }
            }
            // u - v floor(u/v): the quotient jumps where it is whole, and is constant between.
            Function::Mod => {
                let whole = (self.value / other.value).floor();
                Self { value, ..self.plus(other.scaled(-whole)) }
            }
            Function::Hypot => Self { value, ..self.times(self).plus(other.times(other)).of(Function::Sqrt) },
            // Comparisons.
            _ => Self::constant(value),
        }
    }

    fn choose(self, one: Self, other: Self) -> Self {
        if self.value.is_nan() {
            Self::constant(f64::NAN)
        } else if self.value == 0.0 {
            other
        } else {
            one
        }
    }
}
