//! Tests of `depth_buffer`, a module of it.

use super::*;

/// Colours of the pixels of four rows of four, with these faces in this order.
fn drawn(faces: &[([f64; 3], Shade)]) -> Vec<u8> {
    let mut buffer = DepthBuffer::new([4, 4]);
    for ([here, right, below], shade) in faces {
        buffer.draw(&[[0.0, 0.0, *here, 1.0], [20.0, 0.0, *right, 1.0], [0.0, 20.0, *below, 1.0]], *shade);
    }
    buffer.image().pixels.iter().map(|shade| shade[0]).collect()
}

#[test]
fn the_nearest_face_is_seen_in_any_order() {
    let (near, far) = (([1.0; 3], [10, 0, 0]), ([0.0; 3], [0, 10, 0]));
    assert_eq!(drawn(&[near, far]), [10; 16]);
    assert_eq!(drawn(&[far, near]), [10; 16]);
}

#[test]
fn faces_that_pass_through_each_other_meet_in_a_line() {
    let slope = |rise: f64| [-2.0 * rise, 18.0 * rise, -2.0 * rise];
    let pixels = drawn(&[(slope(1.0), [100; 3]), (slope(-1.0), [200; 3])]);
    assert_eq!(pixels[..2], [200; 2]);
    assert_eq!(pixels[3], 100);
}

#[test]
fn brightness_changes_between_corners_and_beside_a_face_is_white() {
    let mut buffer = DepthBuffer::new([4, 2]);
    buffer.draw(
        &[[0.0, 0.0, 0.0, 0.0], [3.0, 0.0, 0.0, 1.5], [3.0, 2.0, 0.0, 1.5], [0.0, 2.0, 0.0, 0.0]],
        [100; 3],
    );
    let row: Vec<u8> = buffer.image().pixels[..4].iter().map(|shade| shade[0]).collect();
    assert!(row[0] < row[1] && row[1] < row[2], "{row:?}");
    assert!(row[2] > 100 && row[3] >= 200, "{row:?}");
}
