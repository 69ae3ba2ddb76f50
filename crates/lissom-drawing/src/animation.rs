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
#[path = "../tests/unit/animation.rs"]
mod tests;
