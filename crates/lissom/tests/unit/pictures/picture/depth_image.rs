//! Tests of `pictures::picture::depth_image`, a module of it.

use lissom_core::kinematics::GROUND;
use lissom_motion::Vector3;

use super::*;
use crate::pictures::geometry::{Carrier, Colour, Mesh, Piece, Role};
use crate::pictures::picture::View;

/// Red values of the pixels of four tilted squares, from above.
fn pixels(is_open: bool, is_reversed: bool) -> Vec<u8> {
    let points = (0..9).map(|k| Vector3::new(f64::from(k % 3), f64::from(k / 3), 0.2 * f64::from(k / 3)));
    let face = |first: u32| {
        let mut face = vec![first, first + 1, first + 4, first + 3];
        if is_reversed {
            face.reverse();
        }
        face
    };
    let mesh = Mesh { points: points.collect(), faces: [0, 1, 3, 4].map(face).to_vec(), is_open };
    let piece = Piece {
        name: "sheet".to_owned(),
        role: Role::Shell,
        colour: Colour::Part(1),
        mesh,
        carrier: Carrier::Node(GROUND),
    };
    let (low, high) = (Vector3::zeros(), Vector3::new(2.0, 2.0, 0.4));
    let geometry = Geometry { pieces: vec![piece], low, high, size: 2.0, up: Vector3::z() };
    let projection = Projection::of(&geometry, View::Top);
    let model = (&geometry, &Paint::default(), &projection);
    let place = |[x, y]: &[f64; 2]| [20.0 + 30.0 * x, 80.0 - 30.0 * y];
    let image = depth_image(model, (&[Pose::identity()], 0.0), [100, 100], place);
    image.pixels.iter().map(|shade| shade[0]).collect()
}

#[test]
fn open_surfaces_are_seen_from_both_sides_and_have_edges() {
    let at = |image: &[u8], x: usize, y: usize| image[100 * y + x];
    let [front, back] = [false, true].map(|is_reversed| pixels(true, is_reversed));
    for (a, b) in front.iter().zip(&back) {
        assert!(a == b && *a == 255 || b < a && *a < 255, "the back is darker: {a} {b}");
    }
    let (face, inner, border) = (at(&front, 35, 65), at(&front, 50, 65), at(&front, 20, 65));
    assert!(border < inner && inner < face && face < 255, "{border} {inner} {face}");
    assert_eq!((at(&front, 10, 65), at(&front, 90, 65)), (255, 255));
    // A closed surface is not seen from inside, and has no lines.
    assert!(pixels(false, true).iter().all(|pixel| *pixel == 255));
    let closed = pixels(false, false);
    assert_eq!(at(&closed, 50, 65), at(&closed, 35, 65));
}
