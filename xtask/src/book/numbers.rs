//! Numbers as the tables of the book show them: so few digits that they are the same on every machine.

/// Two digits.
pub(super) fn two(value: f64) -> String {
    let magnitude = value.abs();
    if value == 0.0 || !value.is_finite() {
        value.to_string()
    } else if (9.95..999.5).contains(&magnitude) {
        format!("{value:.0}")
    } else if (0.995..9.95).contains(&magnitude) {
        format!("{value:.1}")
    } else {
        format!("{value:.1e}")
    }
}

/// One digit, for numbers determined by round-off.
pub(super) fn one(value: f64) -> String {
    if value == 0.0 || !value.is_finite() { value.to_string() } else { format!("{value:.0e}") }
}

/// One digit, rounded up: a bound of a number determined by round-off.
pub(super) fn bound(value: f64) -> String {
    let rounded = one(value);
    let is_below = rounded.parse::<f64>().is_ok_and(|shown| shown < value);
    if is_below { one(value + 0.5 * 10_f64.powf(value.log10().floor())) } else { rounded }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_are_few() {
        let texts = [0.0, 4.81, 46.5, 137.8, 9.96, 0.95, 1.52e21, -2.4e-10, f64::NAN].map(two);
        assert_eq!(texts, ["0", "4.8", "46", "138", "10", "9.5e-1", "1.5e21", "-2.4e-10", "NaN"]);
        assert_eq!([3.6e-10, 0.0].map(one), ["4e-10", "0"]);
        assert_eq!([1.3e-14, 9.2e-15, 4e-15, 2.7e-13].map(bound), ["2e-14", "1e-14", "4e-15", "3e-13"]);
    }
}
