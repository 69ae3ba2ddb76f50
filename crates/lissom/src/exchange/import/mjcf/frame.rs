//! Positions and orientations in MJCF.

use lissom_motion::{Motion, Rotation, Vector3};

use super::super::{ImportError, from_z};
use super::element::Element;

/// The attributes of a frame.
pub(super) const ATTRIBUTES: [&str; 6] = ["pos", "quat", "axisangle", "xyaxes", "zaxis", "euler"];

/// Format of angles.
pub(super) struct Angles {
    /// Radians per unit.
    pub(super) unit: f64,
    /// Axes of `euler`, and for each whether it rotates with the previous ones.
    pub(super) sequence: [(Vector3, bool); 3],
}

impl Angles {
    /// As specified by `<compiler>`.
    pub(super) fn read(compiler: &Element) -> Result<Self, ImportError> {
        let unit = match compiler.text("angle").unwrap_or("degree") {
            "degree" => std::f64::consts::PI / 180.0,
            "radian" => 1.0,
            other => {
                return Err(compiler.fault(format!("`angle` must be degree or radian, not `{other}`")));
            }
        };
        let letters = compiler.text("eulerseq").unwrap_or("xyz");
        let axis = |letter: char| match letter.to_ascii_lowercase() {
            'x' => Some((Vector3::x(), letter.is_ascii_lowercase())),
            'y' => Some((Vector3::y(), letter.is_ascii_lowercase())),
            'z' => Some((Vector3::z(), letter.is_ascii_lowercase())),
            _ => None,
        };
        let read: Option<Vec<(Vector3, bool)>> = letters.chars().map(axis).collect();
        let sequence = read.and_then(|axes| axes.try_into().ok()).ok_or_else(|| {
            compiler.fault(format!("`eulerseq` must be three of x, y, z, X, Y, Z, not `{letters}`"))
        })?;
        Ok(Self { unit, sequence })
    }
}

/// The direction of a vector.
pub(super) fn direction(element: &Element, key: &str, vector: [f64; 3]) -> Result<Vector3, ImportError> {
    let direction = Vector3::from(vector).try_normalize(1e-14);
    direction.ok_or_else(|| element.fault(format!("`{key}` has no direction: all its numbers are zero")))
}

/// The position of an element in the enclosing frame.
pub(super) fn frame(element: &Element, angles: &Angles) -> Result<Motion, ImportError> {
    let position = Vector3::from(element.numbers::<3>("pos")?.unwrap_or_default());
    Ok(Motion::new(rotation(element, angles)?, position))
}

fn rotation(element: &Element, angles: &Angles) -> Result<Rotation, ImportError> {
    let given: Vec<&str> =
        ATTRIBUTES[1..].iter().copied().filter(|key| element.text(key).is_some()).collect();
    if given.len() > 1 {
        return Err(element.fault(format!("its orientation is given by {} at once", given.join(" and "))));
    }
    if let Some(quaternion) = element.numbers::<4>("quat")? {
        let turn = Rotation::from_quaternion(quaternion);
        return turn.ok_or_else(|| element.fault("`quat` has the length zero"));
    }
    if let Some([x, y, z, angle]) = element.numbers::<4>("axisangle")? {
        return Ok(Rotation::about_axis(&direction(element, "axisangle", [x, y, z])?, angle * angles.unit));
    }
    if let Some([a, b, c, d, e, f]) = element.numbers::<6>("xyaxes")? {
        let turn = Rotation::from_axis_and_reference(&Vector3::new(a, b, c), &Vector3::new(d, e, f));
        return turn.ok_or_else(|| element.fault("`xyaxes` are parallel, or one of them is zero"));
    }
    if let Some(z) = element.numbers::<3>("zaxis")? {
        return Ok(from_z(&direction(element, "zaxis", z)?));
    }
    let turns = element.numbers::<3>("euler")?.unwrap_or_default();
    let turn = angles.sequence.iter().zip(turns).fold(
        Rotation::identity(),
        |so_far, ((axis, is_carried), angle)| {
            let own = Rotation::about_axis(axis, angle * angles.unit);
            if *is_carried { so_far * own } else { own * so_far }
        },
    );
    Ok(turn)
}
