//! The direction of view of a picture: an orthographic projection.

use lissom_motion::{Rotation, Vector3};

use crate::pictures::geometry::{Geometry, Role, turn_to};

/// Brightness of the back of an open surface relative to its front.
const BACK: f64 = 0.8;

/// A direction of view by its name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum View {
    /// From the front and above for a model in a plane without shells and solids, otherwise oblique.
    #[default]
    Chosen,
    /// From the front, the right and above.
    Oblique,
    /// Against the global axis y.
    Front,
    /// Against the global axis x.
    Side,
    /// Against the global axis z.
    Top,
}

/// An orthographic projection: directions to the right, upward and towards the viewer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projection {
    right: Vector3,
    above: Vector3,
    /// From the model to the viewer.
    pub away: Vector3,
    /// Direction of the light source.
    light: Vector3,
}

impl Projection {
    /// For a model, from a direction.
    pub fn of(geometry: &Geometry, view: View) -> Self {
        let up = geometry.up;
        // Directions are given for z upward and rotated to the actual upward axis.
        let to_up = turn_to(&up) * turn_to(&Vector3::z()).inverse();
        let oblique = to_up.apply(&Vector3::new(1.0, -1.35, 0.75));
        let (away, up) = match view {
            View::Oblique => (oblique, up),
            View::Front => (-Vector3::y(), Vector3::z()),
            View::Side => (Vector3::x(), Vector3::z()),
            View::Top => (Vector3::z(), Vector3::y()),
            View::Chosen => Self::chosen(geometry, &to_up).unwrap_or((oblique, up)),
        };
        Self::new(&away, &up)
    }

    /// The direction of view and the upward direction, for a model in a plane without shells and solids.
    fn chosen(geometry: &Geometry, to_up: &Rotation) -> Option<(Vector3, Vector3)> {
        if geometry.pieces.iter().any(|piece| matches!(piece.role, Role::Shell | Role::Solid)) {
            return None;
        }
        let extent = geometry.high - geometry.low;
        let mut thin = (0..3).filter(|k| extent[*k] < 0.02 * geometry.extent());
        let (plane, None) = (thin.next()?, thin.next()) else { return None };
        if geometry.up[plane] != 0.0 {
            return Some((Vector3::z(), Vector3::y()));
        }
        let toward = if plane == 0 { [1.0, -0.32, 0.24] } else { [0.28, -1.0, 0.24] };
        Some((to_up.apply(&Vector3::from(toward)), geometry.up))
    }

    fn new(away: &Vector3, up: &Vector3) -> Self {
        let away = away.normalize();
        let right = up.cross(&away).normalize();
        let above = away.cross(&right);
        let light = (away + 0.9 * up - 0.5 * right).normalize();
        Self { right, above, away, light }
    }

    /// Coordinates to the right and upward [m].
    pub fn flat(&self, point: &Vector3) -> [f64; 2] {
        [self.right.dot(point), self.above.dot(point)]
    }

    /// Coordinate towards the viewer [m].
    pub fn near(&self, point: &Vector3) -> f64 {
        self.away.dot(point)
    }

    /// Brightness of the visible side of a face with the normal `face`, shaded by another normal: the back is darker.
    pub(super) fn brightness_of_side(&self, face: &Vector3, normal: &Vector3, up: &Vector3) -> f64 {
        let is_front = face.dot(&self.away) >= 0.0;
        if is_front { self.brightness(normal, up) } else { BACK * self.brightness(&-normal, up) }
    }

    /// Brightness of a face with this unit normal, about 1 if it faces the light.
    pub fn brightness(&self, normal: &Vector3, up: &Vector3) -> f64 {
        0.56 + 0.1 * normal.dot(up) + 0.42 * normal.dot(&self.light).max(0.0)
    }
}
