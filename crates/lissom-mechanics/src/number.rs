//! Numbers in messages and on the terminal: few digits, exponents only for very small and very large ones.

use std::fmt::{self, Display, Formatter, LowerExp};
use std::ops::Deref;

/// Significant digits where none are specified.
pub const DIGITS: usize = 7;
/// Magnitudes without an exponent, except zero.
const PLAIN: std::ops::RangeInclusive<f64> = 1e-4..=1e6;

/// `value` with at most so many significant digits, such as `0.004`, `12.5` or `1.2e-9`.
pub fn written(value: f64, digits: usize) -> String {
    if !value.is_finite() {
        return value.to_string();
    }
    let rounded: f64 = format!("{value:.*e}", digits.max(1) - 1).parse().unwrap_or(value);
    if rounded == 0.0 {
        "0".to_owned()
    } else if PLAIN.contains(&rounded.abs()) {
        rounded.to_string()
    } else {
        format!("{rounded:e}")
    }
}

/// A duration of a computation [s], such as `12.3 s` or `4.2 ms`.
pub fn duration(seconds: f64) -> String {
    if seconds >= 0.1 {
        format!("{} s", written(seconds, 3))
    } else {
        format!("{} ms", written(1e3 * seconds, 2))
    }
}

/// A number that a format string writes by [`written`]: `{}` with seven digits, `{:.2e}` with at most three, and `{:.2}` with two
/// decimals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Written(pub f64);

impl Display for Written {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        if f.precision().is_some() { Display::fmt(&self.0, f) } else { f.pad(&written(self.0, DIGITS)) }
    }
}

impl LowerExp for Written {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        // The precision is padding's length, too.
        f.write_str(&written(self.0, f.precision().map_or(DIGITS, |decimals| decimals + 1)))
    }
}

impl Deref for Written {
    type Target = f64;

    fn deref(&self) -> &f64 {
        &self.0
    }
}

/// A value in a message: `(&Shown(value)).shown()` is a [`Written`] for a number, whose method takes precedence, and a reference
/// for anything else.
#[derive(Debug)]
pub struct Shown<'a, T: ?Sized>(pub &'a T);

/// Numbers in messages.
pub trait ShownNumber {
    /// The number.
    fn shown(&self) -> Written;
}

/// Other values in messages.
pub trait ShownOther<'a, T: ?Sized> {
    /// The value.
    fn shown(&self) -> &'a T;
}

impl ShownNumber for Shown<'_, f64> {
    fn shown(&self) -> Written {
        Written(*self.0)
    }
}

impl<'a, T: ?Sized> ShownOther<'a, T> for &Shown<'a, T> {
    fn shown(&self) -> &'a T {
        self.0
    }
}

/// Makes the given variables, references to values, those that are shown in messages.
#[macro_export]
macro_rules! as_written {
    ($($name:ident),*) => {
        $(
            #[allow(unused_variables)]
            let $name = {
                #[allow(unused_imports)]
                use $crate::number::{ShownNumber as _, ShownOther as _};
                (&$crate::number::Shown($name)).shown()
            };
        )*
    };
}

pub use as_written;

#[cfg(test)]
#[path = "../tests/unit/number.rs"]
mod tests;
