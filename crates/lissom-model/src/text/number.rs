//! Numbers as text.

/// A number with the fewest digits that give it back exactly; also a number of a model file.
pub fn number_text(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 || !value.is_finite() || (1e-4..1e9).contains(&size) {
        value.to_string()
    } else {
        format!("{value:e}")
    }
}
