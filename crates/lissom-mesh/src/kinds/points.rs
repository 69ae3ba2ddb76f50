//! Points of quadrature of third order on lines, squares and triangles.

use super::functions::Natural;

/// Points of Gauss on a line from -1 to 1, exact to the fifth order.
pub(super) fn on_line() -> [(f64, f64); 3] {
    let far = 0.6_f64.sqrt();
    [(-far, 5.0 / 9.0), (0.0, 8.0 / 9.0), (far, 5.0 / 9.0)]
}

/// Nine points of a square from -1 to 1.
pub(super) fn on_square(k: usize) -> (Natural, f64) {
    let line = on_line();
    let [x, y] = [line[k / 3], line[k % 3]];
    ([x.0, y.0, 0.0], x.1 * y.1)
}

/// Nine points of a triangle r, s ≥ 0, r + s ≤ 1, as a square of which one side is a corner.
pub(super) fn on_triangle(k: usize) -> (Natural, f64) {
    let ([x, y, _], weight) = on_square(k);
    let [u, v] = [x, y].map(|x| 0.5 * (1.0 + x));
    ([u, v * (1.0 - u), 0.0], 0.25 * weight * (1.0 - u))
}
