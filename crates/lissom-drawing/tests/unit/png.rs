//! Tests of `png`, a module of it.

use std::io::Cursor;

use png::{DecodeOptions, Decoder};

use super::*;

fn square(left: f64) -> Drawing {
    let mut drawing = Drawing::new("square", [12.0, 8.0]);
    let right = left + 4.0;
    drawing.polygon(vec![[left, 2.0], [right, 2.0], [right, 6.0], [left, 6.0]], [10, 20, 30]);
    drawing
}

#[test]
fn pixels_come_back() {
    let file = square(4.0).png().unwrap();
    let mut options = DecodeOptions::default();
    options.set_ignore_checksums(false);
    let mut reader = Decoder::new_with_options(Cursor::new(&file), options).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let found = reader.next_frame(&mut pixels).unwrap();
    assert_eq!([found.width, found.height], [24, 16]);
    let pixel = |column: usize, row: usize| &pixels[3 * (24 * row + column)..][..3];
    assert_eq!(pixel(12, 8), [10, 20, 30], "the middle of the square");
    assert_eq!(pixel(2, 8), [255; 3], "beside it");
    assert_eq!(file, square(4.0).png().unwrap());
}
