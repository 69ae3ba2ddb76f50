//! Moving pictures: APNG, which browsers show (other programs show its first picture), and GIF, which all programs show.

use std::thread;

use gif::{Encoder, EncodingError, Frame, Repeat};

use crate::drawing::{Drawing, DrawingError, PngError};
use crate::image::Image;
use crate::png;

/// Speed of the choice of colours of a GIF, 1 to 30: its precision is sufficient for shaded surfaces.
const SPEED: i32 = 20;

impl From<EncodingError> for PngError {
    fn from(error: EncodingError) -> Self {
        Self::Encoder(error.to_string())
    }
}

/// Format of a moving picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// True colours.
    Apng,
    /// At most 256 colours in a picture.
    Gif,
}

/// The bytes of a moving picture of `count` frames, each shown for `delay` [s], in an infinite loop. `frame` returns the image
/// of this index and the drawing above it, all of one size. Frames are drawn by all processors.
///
/// # Errors
/// That of a frame; if there is none, sizes differ, or a drawing has no finite position or too many pixels.
///
/// # Panics
/// If `frame` does.
pub fn animation<E: From<DrawingError> + Send>(
    (format, delay): (Format, f64),
    count: usize,
    frame: impl Fn(usize) -> Result<(Image, Drawing), E> + Sync,
) -> Result<Vec<u8>, E> {
    let drawn = |index: usize| -> Result<([u32; 2], Encoded), E> {
        let (image, drawing) = frame(index)?;
        let pixels = drawing.over(&image)?;
        let [width, height] = image.size;
        if format == Format::Apng {
            return Ok((image.size, Encoded::Colours(pixels)));
        }
        let side = |side: u32| {
            let large = PngError::TooLarge { width: width.into(), height: height.into() };
            u16::try_from(side).map_err(|_| DrawingError::from(large))
        };
        let mut frame = Frame::from_rgb_speed(side(width)?, side(height)?, &pixels, SPEED);
        frame.delay = (100.0 * delay).round().clamp(1.0, 65535.0) as u16;
        frame.make_lzw_pre_encoded();
        Ok((image.size, Encoded::Gif(frame)))
    };
    if count == 0 {
        return Err(DrawingError::from(PngError::Nothing).into());
    }
    let (size, first) = drawn(0)?;
    let mut file = Vec::new();
    let mut writer = Writer::of(&mut file, size, (format, count, delay)).map_err(DrawingError::from)?;
    writer.add(first).map_err(DrawingError::from)?;
    let workers = thread::available_parallelism().map_or(1, usize::from);
    for first in (1..count).step_by(workers) {
        let drawn = &drawn;
        let frames: Vec<_> = thread::scope(|scope| {
            let of = |index| scope.spawn(move || drawn(index));
            let started: Vec<_> = (first..count.min(first + workers)).map(of).collect();
            started.into_iter().map(|worker| worker.join().expect("drawing does not panic")).collect()
        });
        for frame in frames {
            let (own, encoded) = frame?;
            if own != size {
                return Err(DrawingError::from(PngError::Sizes).into());
            }
            writer.add(encoded).map_err(DrawingError::from)?;
        }
    }
    writer.finish().map_err(DrawingError::from)?;
    Ok(file)
}

/// A frame for a file.
enum Encoded {
    /// Red, green and blue of all pixels.
    Colours(Vec<u8>),
    Gif(Frame<'static>),
}

/// A file to which frames are added.
enum Writer<'a> {
    Apng(::png::Writer<&'a mut Vec<u8>>),
    Gif(Encoder<&'a mut Vec<u8>>),
}

impl<'a> Writer<'a> {
    fn of(
        file: &'a mut Vec<u8>,
        [width, height]: [u32; 2],
        (format, count, delay): (Format, usize, f64),
    ) -> Result<Self, PngError> {
        if format == Format::Gif {
            let mut encoder = Encoder::new(file, width as u16, height as u16, &[])?;
            encoder.set_repeat(Repeat::Infinite)?;
            return Ok(Self::Gif(encoder));
        }
        let mut encoder = png::encoder(file, [width, height]);
        encoder.set_animated(count as u32, 0)?;
        encoder.set_frame_delay((1000.0 * delay).round().clamp(1.0, 65535.0) as u16, 1000)?;
        Ok(Self::Apng(encoder.write_header()?))
    }

    fn add(&mut self, frame: Encoded) -> Result<(), PngError> {
        match (self, frame) {
            // The encoder's stream of rows marks later frames wrongly.
            (Self::Apng(writer), Encoded::Colours(pixels)) => writer.write_image_data(&pixels)?,
            (Self::Gif(encoder), Encoded::Gif(frame)) => encoder.write_lzw_pre_encoded_frame(&frame)?,
            _ => {}
        }
        Ok(())
    }

    fn finish(self) -> Result<(), PngError> {
        match self {
            Self::Apng(writer) => writer.finish()?,
            Self::Gif(encoder) => drop(encoder),
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
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
}
