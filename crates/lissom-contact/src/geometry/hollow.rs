//! Balls that touch two sides of a surface, of which the gap contains only the nearest one.
//!
//! Legend: r radius of the ball, φᵢ and nᵢ distances and normals of the sides, δᵢ = r - φᵢ, 1 the nearest side.
//!
//! ```text
//! δ₂ - δ₁ n₁·n₂     penetration of side 2 that remains after a displacement δ₁ n₁
//! ```

use lissom_mechanics::round_off;
use lissom_motion::Vector3;

use super::surfaces::Surface;

/// Penetrations of two sides of a surface by a ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hollow {
    /// Penetration of the nearest side [m].
    pub depth: f64,
    /// Penetration of the other side, after a displacement of the ball out of the nearest one [m].
    pub remaining: f64,
}

/// The side whose penetration remains largest when a ball about y leaves the nearest one; none if no penetration remains.
pub(super) fn hollow(surface: &dyn Surface, y: &Vector3, radius: f64) -> Option<Hollow> {
    if !surface.has_hollows() {
        return None;
    }
    let nearest = surface.distance(y);
    let depth = radius - nearest.value;
    if nearest.value <= 0.0 || depth <= 0.0 {
        return None;
    }
    let mut remaining = round_off::OPERATIONS * radius;
    let mut is_found = false;
    surface.sides(y, radius, &mut |side| {
        let own = radius - side.value - depth * side.normal.dot(&nearest.normal);
        if own > remaining {
            (remaining, is_found) = (own, true);
        }
    });
    is_found.then_some(Hollow { depth, remaining })
}

#[cfg(test)]
#[path = "../../tests/unit/geometry/hollow.rs"]
mod tests;
