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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_are_few() {
        let texts = [0.0, 4.81, 46.5, 137.8, 9.96, 0.95, 1.52e21, -2.4e-10, f64::NAN].map(two);
        assert_eq!(texts, ["0", "4.8", "46", "138", "10", "9.5e-1", "1.5e21", "-2.4e-10", "NaN"]);
        assert_eq!([3.6e-10, 0.0].map(one), ["4e-10", "0"]);
    }
}
