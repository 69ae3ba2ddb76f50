//! What a compiled expression computes with: numbers, jets, intervals, or enclosures of a function over an interval.

use super::jet::Function;
use super::noise;

/// Operations of an expression.
pub(super) trait Number: Copy {
    /// Number with one value everywhere.
    fn constant(value: f64) -> Self;
    /// u + v.
    fn plus(self, other: Self) -> Self;
    /// u - v.
    fn minus(self, other: Self) -> Self;
    /// u v.
    fn times(self, other: Self) -> Self;
    /// u/v.
    fn over(self, other: Self) -> Self;
    /// u to the power of v.
    fn to_the(self, exponent: Self) -> Self;
    /// A function of one number.
    fn of(self, function: Function) -> Self;
    /// A function of two numbers.
    fn of_two(self, function: Function, other: Self) -> Self;
    /// u unless it is zero, and v otherwise, if this is not zero.
    fn choose(self, one: Self, other: Self) -> Self;

    /// c u.
    fn scaled(self, factor: f64) -> Self {
        Self::constant(factor).times(self)
    }

    /// u².
    fn square(self) -> Self {
        self.times(self)
    }

    /// A function of three numbers.
    fn of_three(self, function: Function, one: Self, other: Self) -> Self {
        match function {
            Function::If => self.choose(one, other),
            // Clamp; the compiler passes no others.
            _ => self.of_two(Function::Max, one).of_two(Function::Min, other),
        }
    }
}

/// A number at one point, which is on one side of every switch.
pub(super) trait Point: Number {
    /// Value of the number.
    fn value(self) -> f64;
}

impl Point for f64 {
    fn value(self) -> f64 {
        self
    }
}

impl Number for f64 {
    fn constant(value: f64) -> Self {
        value
    }

    fn plus(self, other: Self) -> Self {
        self + other
    }

    fn minus(self, other: Self) -> Self {
        self - other
    }

    fn times(self, other: Self) -> Self {
        self * other
    }

    fn over(self, other: Self) -> Self {
        self / other
    }

    fn to_the(self, exponent: Self) -> Self {
        // The power that occurs most.
        if exponent == 2.0 { self * self } else { self.powf(exponent) }
    }

    fn of(self, function: Function) -> Self {
        match function {
            Function::Sin => self.sin(),
            Function::Cos => self.cos(),
            Function::Tan => self.tan(),
            Function::Asin => self.asin(),
            Function::Acos => self.acos(),
            Function::Atan => self.atan(),
            Function::Sinh => self.sinh(),
            Function::Cosh => self.cosh(),
            Function::Tanh => self.tanh(),
            Function::Asinh => self.asinh(),
            Function::Acosh => self.acosh(),
            Function::Atanh => self.atanh(),
            Function::Exp => self.exp(),
            Function::Ln => self.ln(),
            Function::Log10 => self.log10(),
            Function::Sqrt => self.sqrt(),
            Function::Cbrt => self.cbrt(),
            Function::Abs => self.abs(),
            Function::Sign => sign(self),
            Function::Floor => self.floor(),
            Function::Ceil => self.ceil(),
            Function::Round => self.round(),
            Function::Step => truth(self >= 0.0),
            Function::Smoothstep => smoothstep(self)[0],
            // Of two or three arguments.
            _ => self,
        }
    }

    fn of_two(self, function: Function, other: Self) -> Self {
        match function {
            Function::Max => {
                if self >= other {
                    self
                } else {
                    other
                }
            }
            Function::Atan2 => self.atan2(other),
            Function::Mod => self.rem_euclid(other),
            Function::Random => noise::uniform(self, noise::counter(other)),
            Function::Normal => noise::normal(self, noise::counter(other)),
            Function::Less => truth(self < other),
            Function::LessOrEqual => truth(self <= other),
            Function::Greater => truth(self > other),
            Function::GreaterOrEqual => truth(self >= other),
            Function::Hypot => self.hypot(other),
            // Min; the compiler passes no others.
            _ => {
                if self <= other {
                    self
                } else {
                    other
                }
            }
        }
    }

    fn choose(self, one: Self, other: Self) -> Self {
        // What is chosen by nothing known is not known.
        if self.is_nan() {
            f64::NAN
        } else if self == 0.0 {
            other
        } else {
            one
        }
    }
}

/// 1 for true, 0 for false.
pub(super) fn truth(holds: bool) -> f64 {
    f64::from(u8::from(holds))
}

fn sign(x: f64) -> f64 {
    if x == 0.0 { 0.0 } else { x.signum() }
}

/// From 0 at 0 to 1 at 1 by the quintic whose first and second derivatives vanish at both ends, so that a
/// motion prescribed with it has a continuous acceleration.
fn smoothstep<N: Number>(x: N) -> [N; 3] {
    let number = N::constant;
    let x = x.of_three(Function::Clamp, number(0.0), number(1.0));
    let y = x.times(number(1.0).minus(x));
    let cube = x.times(x).times(x);
    [
        cube.times(number(10.0).minus(x.times(number(15.0).minus(x.scaled(6.0))))),
        y.square().scaled(30.0),
        y.times(number(1.0).minus(x.scaled(2.0))).scaled(60.0),
    ]
}

impl Function {
    /// `[f, f', f'']` of a function of one number. Kinks and jumps have the derivative of one side.
    pub(super) fn derivatives<N: Number>(self, x: N) -> [N; 3] {
        let number = N::constant;
        let square = N::square;
        let inverse = |u: N| number(1.0).over(u);
        let value = x.of(self);
        let [first, second] = match self {
            Self::Sin => [x.of(Self::Cos), value.scaled(-1.0)],
            Self::Cos => [x.of(Self::Sin).scaled(-1.0), value.scaled(-1.0)],
            Self::Tan => {
                let d = square(value).plus(number(1.0));
                [d, value.times(d).scaled(2.0)]
            }
            Self::Asin | Self::Acos => {
                let sign = if self == Self::Asin { 1.0 } else { -1.0 };
                let d = inverse(number(1.0).minus(square(x)).of(Self::Sqrt)).scaled(sign);
                [d, x.times(square(d)).times(d)]
            }
            Self::Atan => {
                let d = inverse(square(x).plus(number(1.0)));
                [d, x.times(square(d)).scaled(-2.0)]
            }
            Self::Sinh => [x.of(Self::Cosh), value],
            Self::Cosh => [x.of(Self::Sinh), value],
            Self::Tanh => {
                let d = number(1.0).minus(square(value));
                [d, value.times(d).scaled(-2.0)]
            }
            Self::Asinh | Self::Acosh => {
                let one = if self == Self::Asinh { 1.0 } else { -1.0 };
                let d = inverse(square(x).plus(number(one)).of(Self::Sqrt));
                [d, x.times(square(d)).times(d).scaled(-1.0)]
            }
            Self::Atanh => {
                let d = inverse(number(1.0).minus(square(x)));
                [d, x.times(square(d)).scaled(2.0)]
            }
            Self::Exp => [value; 2],
            Self::Ln | Self::Log10 => {
                let unit = if self == Self::Ln { 1.0 } else { std::f64::consts::LOG10_E };
                let d = inverse(x);
                [d.scaled(unit), square(d).scaled(-unit)]
            }
            Self::Sqrt => [inverse(value).scaled(0.5), inverse(value.times(x)).scaled(-0.25)],
            Self::Cbrt => {
                let cubed = square(value);
                [inverse(cubed.scaled(3.0)), inverse(cubed.times(x)).scaled(-2.0 / 9.0)]
            }
            Self::Abs => [x.of(Self::Sign), number(0.0)],
            Self::Smoothstep => {
                let [_, first, second] = smoothstep(x);
                [first, second]
            }
            // Steps.
            _ => [number(0.0); 2],
        };
        [value, first, second]
    }
}
