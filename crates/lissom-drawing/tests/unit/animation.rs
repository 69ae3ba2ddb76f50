//! Tests of `animation`, a module of it.

use std::io::Cursor;

use ::png::{DecodeOptions, Decoder};
use gif::{ColorOutput, DecodeOptions as GifOptions};

use super::*;

const SIZE: [u32; 2] = [12, 8];

/// A frame with a square that begins at a column; red is 200 below it, and 10 within it.
fn frame(left: f64) -> (Image, Drawing) {
    let mut drawing = Drawing::new("square", SIZE.map(f64::from));
    let right = left + 4.0;
    drawing.polygon(vec![[left, 2.0], [right, 2.0], [right, 6.0], [left, 6.0]], [10, 20, 30]);
    let image = Image { pixels: vec![[200, 210, 220]; 96], ..Image::white(SIZE) };
    (image, drawing)
}

fn moving(format: Format, count: usize) -> Result<Vec<u8>, DrawingError> {
    animation((format, 0.05), count, |index| Ok(frame(1.0 + 2.0 * index as f64)))
}

/// The first column of the square, and the red of the first pixel.
fn check(pixels: &[u8], depth: usize, index: usize) {
    let row = &pixels[depth * 12 * 4..];
    let is_dark = |column: &usize| row[depth * column].abs_diff(10) < 8;
    assert_eq!((0..12).find(is_dark), Some(1 + 2 * index));
    assert!(pixels[0].abs_diff(200) < 8, "the image is below the drawing: {}", pixels[0]);
}

#[test]
fn frames_of_an_apng_are_shown_one_after_the_other() {
    let file = moving(Format::Apng, 3).unwrap();
    let mut options = DecodeOptions::default();
    options.set_ignore_checksums(false);
    let mut reader = Decoder::new_with_options(Cursor::new(file), options).read_info().unwrap();
    assert_eq!(reader.info().animation_control().unwrap().num_frames, 3);
    for index in 0..3 {
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut pixels).unwrap();
        let delay = reader.info().frame_control().map(|control| [control.delay_num, control.delay_den]);
        assert_eq!(delay, Some([50, 1000]), "50 thousandths of a second");
        check(&pixels, 3, index);
    }
}

#[test]
fn frames_of_a_gif_are_shown_one_after_the_other() {
    let file = moving(Format::Gif, 4).unwrap();
    let mut options = GifOptions::new();
    options.set_color_output(ColorOutput::RGBA);
    let mut reader = options.read_info(file.as_slice()).unwrap();
    assert_eq!([reader.width(), reader.height()], [12, 8]);
    for index in 0..4 {
        let frame = reader.read_next_frame().unwrap().unwrap();
        assert_eq!(frame.delay, 5, "five hundredths of a second");
        check(&frame.buffer, 4, index);
    }
    assert!(reader.read_next_frame().unwrap().is_none());
}

#[test]
fn frames_of_different_sizes_are_refused() {
    let sizes = Err(DrawingError::Png(PngError::Sizes));
    assert_eq!(moving(Format::Apng, 0), Err(DrawingError::Png(PngError::Nothing)));
    let small = || Image::white([3, 3]);
    assert_eq!(animation((Format::Gif, 0.1), 2, |_| Ok((small(), frame(1.0).1))), sizes);
    let of = |index| if index == 0 { frame(1.0) } else { (small(), Drawing::new("small", [3.0; 2])) };
    assert_eq!(animation((Format::Apng, 0.1), 2, |index| Ok(of(index))), sizes);
}
