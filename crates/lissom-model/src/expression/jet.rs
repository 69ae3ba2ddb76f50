//! Second-order jets: a value with its first and second derivative, and the functions of an expression.
//!
//! Legend: u argument, f function; (f∘u)' = f' u', (f∘u)'' = f'' u'² + f' u''.

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

    pub(super) fn plus(self, other: Self) -> Self {
        Self {
            value: self.value + other.value,
            first: self.first + other.first,
            second: self.second + other.second,
        }
    }

    pub(super) fn scaled(self, factor: f64) -> Self {
        Self { value: factor * self.value, first: factor * self.first, second: factor * self.second }
    }

    pub(super) fn times(self, other: Self) -> Self {
        Self {
            value: self.value * other.value,
            first: product(self.first, other.value) + product(self.value, other.first),
            second: product(self.second, other.value)
                + 2.0 * product(self.first, other.first)
                + product(self.value, other.second),
        }
    }

    pub(super) fn over(self, other: Self) -> Self {
        let u = other.value;
        let inverse = other.through([1.0 / u, -1.0 / (u * u), 2.0 / (u * u * u)]);
        Self { value: self.value / u, ..self.times(inverse) }
    }

    /// A constant exponent keeps negative and zero bases; a varying one is `exp(g ln f)`.
    pub(super) fn to_the(self, exponent: Self) -> Self {
        let n = exponent.value;
        if exponent.first == 0.0 && exponent.second == 0.0 {
            let u = self.value;
            let first = if n == 0.0 { 0.0 } else { n * u.powf(n - 1.0) };
            let second = if n == 0.0 || n == 1.0 { 0.0 } else { n * (n - 1.0) * u.powf(n - 2.0) };
            return self.through([u.powf(n), first, second]);
        }
        Function::Exp.of(exponent.times(Function::Ln.of(self)))
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

    /// The function of one jet.
    pub(super) fn of(self, u: Jet) -> Jet {
        u.through(self.derivatives(u.value))
    }

    /// The function of two jets.
    pub(super) fn of_two(self, u: Jet, v: Jet) -> Jet {
        match self {
            Self::Max | Self::Min if u.value == v.value => u.halfway_to(v),
            Self::Max => {
                if u.value >= v.value {
                    u
                } else {
                    v
                }
            }
            Self::Atan2 => {
                // d atan2(u, v) = (v du - u dv)/(u² + v²), and once more by the quotient rule.
                let (r, w) = (u.times(u).plus(v.times(v)), [u.value, v.value]);
                let n = product(w[1], u.first) - product(w[0], v.first);
                let n1 = product(w[1], u.second) - product(w[0], v.second);
                let first = n / r.value;
                Jet { value: w[0].atan2(w[1]), first, second: (n1 - product(first, r.first)) / r.value }
            }
            // u - v floor(u/v): the quotient jumps where it is whole, and is constant between.
            Self::Mod => {
                let whole = (u.value / v.value).floor();
                Jet { value: u.value.rem_euclid(v.value), ..u.plus(v.scaled(-whole)) }
            }
            Self::Less => truth(u.value < v.value),
            Self::LessOrEqual => truth(u.value <= v.value),
            Self::Greater => truth(u.value > v.value),
            Self::GreaterOrEqual => truth(u.value >= v.value),
            Self::Hypot => {
                Jet { value: u.value.hypot(v.value), ..Self::Sqrt.of(u.times(u).plus(v.times(v))) }
            }
            // Min; the compiler sends nothing else here.
            _ => {
                if u.value <= v.value {
                    u
                } else {
                    v
                }
            }
        }
    }

    /// The function of three jets.
    pub(super) fn of_three(self, u: Jet, v: Jet, w: Jet) -> Jet {
        match self {
            // What is chosen by nothing known is not known.
            Self::If if u.value.is_nan() => Jet::constant(f64::NAN),
            Self::If => {
                if u.value == 0.0 {
                    w
                } else {
                    v
                }
            }
            // Clamp; the compiler sends nothing else here.
            _ => Self::Min.of_two(Self::Max.of_two(u, v), w),
        }
    }

    /// `[f, f', f'']` at `x`. Kinks and jumps have the derivative of one side.
    fn derivatives(self, x: f64) -> [f64; 3] {
        match self {
            Self::Sin => [x.sin(), x.cos(), -x.sin()],
            Self::Cos => [x.cos(), -x.sin(), -x.cos()],
            Self::Tan => {
                let (t, d) = (x.tan(), 1.0 + x.tan().powi(2));
                [t, d, 2.0 * t * d]
            }
            Self::Asin => inverse_sine(x.asin(), x, 1.0),
            Self::Acos => inverse_sine(x.acos(), x, -1.0),
            Self::Atan => {
                let d = 1.0 / (1.0 + x * x);
                [x.atan(), d, -2.0 * x * d * d]
            }
            Self::Sinh => [x.sinh(), x.cosh(), x.sinh()],
            Self::Cosh => [x.cosh(), x.sinh(), x.cosh()],
            Self::Tanh => {
                let (t, d) = (x.tanh(), 1.0 - x.tanh().powi(2));
                [t, d, -2.0 * t * d]
            }
            Self::Asinh => {
                let d = 1.0 / (1.0 + x * x).sqrt();
                [x.asinh(), d, -x * d * d * d]
            }
            Self::Acosh => {
                let d = 1.0 / (x * x - 1.0).sqrt();
                [x.acosh(), d, -x * d * d * d]
            }
            Self::Atanh => {
                let d = 1.0 / (1.0 - x * x);
                [x.atanh(), d, 2.0 * x * d * d]
            }
            Self::Exp => [x.exp(); 3],
            Self::Ln => [x.ln(), 1.0 / x, -1.0 / (x * x)],
            Self::Log10 => {
                let c = std::f64::consts::LOG10_E;
                [x.log10(), c / x, -c / (x * x)]
            }
            Self::Sqrt => {
                let r = x.sqrt();
                [r, 0.5 / r, -0.25 / (r * x)]
            }
            Self::Cbrt => {
                let r = x.cbrt();
                [r, 1.0 / (3.0 * r * r), -2.0 / (9.0 * r * r * x)]
            }
            Self::Abs => [x.abs(), sign(x), 0.0],
            Self::Sign => [sign(x), 0.0, 0.0],
            Self::Floor => [x.floor(), 0.0, 0.0],
            Self::Ceil => [x.ceil(), 0.0, 0.0],
            Self::Round => [x.round(), 0.0, 0.0],
            Self::Step => [if x >= 0.0 { 1.0 } else { 0.0 }, 0.0, 0.0],
            Self::Smoothstep => smoothstep(x),
            // Of two or three arguments.
            _ => [x, 1.0, 0.0],
        }
    }
}

/// 1 for true, 0 for false.
fn truth(holds: bool) -> Jet {
    Jet::constant(f64::from(u8::from(holds)))
}

fn sign(x: f64) -> f64 {
    if x == 0.0 { 0.0 } else { x.signum() }
}

fn inverse_sine(value: f64, x: f64, sign: f64) -> [f64; 3] {
    let d = 1.0 / (1.0 - x * x).sqrt();
    [value, sign * d, sign * x * d * d * d]
}

/// From 0 at 0 to 1 at 1 by the quintic whose first and second derivatives vanish at both ends, so that a
/// motion prescribed with it has a continuous acceleration.
fn smoothstep(x: f64) -> [f64; 3] {
    if x <= 0.0 {
        [0.0; 3]
    } else if x >= 1.0 {
        [1.0, 0.0, 0.0]
    } else {
        let y = x * (1.0 - x);
        [x * x * x * (10.0 - x * (15.0 - 6.0 * x)), 30.0 * y * y, 60.0 * y * (1.0 - 2.0 * x)]
    }
}
