//! Pictures as PNG files, and several of them as an animation (APNG, which browsers show; other programs show the first
//! picture).

use png::{ColorType, Compression, Encoder, EncodingError, Filter};

use crate::drawing::{Drawing, DrawingError, PngError};
use crate::raster::Raster;

impl From<EncodingError> for PngError {
    fn from(error: EncodingError) -> Self {
        Self::Encoder(error.to_string())
    }
}

impl Drawing {
    /// The drawing as the bytes of a PNG file, two pixels for each of the drawing.
    ///
    /// # Errors
    /// If a position is not a finite number, or the drawing is too large.
    pub fn png(&self) -> Result<Vec<u8>, DrawingError> {
        Ok(picture(&self.raster(2.0)?)?)
    }
}

/// The bytes of a PNG file.
fn picture(raster: &Raster) -> Result<Vec<u8>, PngError> {
    let mut file = Vec::new();
    let mut writer = encoder(&mut file, raster).write_header()?;
    let mut stream = writer.stream_writer()?;
    raster.write(&mut stream)?;
    stream.finish()?;
    writer.finish()?;
    Ok(file)
}

/// An animation of drawings of one size, as the bytes of an APNG file: each is shown for `delay` [s], in an infinite loop, with
/// `scale` pixels for each of the drawings'.
///
/// # Errors
/// If there is no drawing, sizes differ, or a drawing has no finite position or too many pixels.
pub fn animation(drawings: &[Drawing], delay: f64, scale: f64) -> Result<Vec<u8>, DrawingError> {
    let first = drawings.first().ok_or(PngError::Nothing)?;
    if drawings.iter().any(|drawing| drawing.size != first.size) {
        return Err(PngError::Sizes.into());
    }
    let milliseconds = (1000.0 * delay).round().clamp(1.0, 65535.0) as u16;
    let mut file = Vec::new();
    let mut encoder = encoder(&mut file, &first.raster(scale)?);
    encoder.set_animated(drawings.len() as u32, 0).map_err(PngError::from)?;
    encoder.set_frame_delay(milliseconds, 1000).map_err(PngError::from)?;
    let mut writer = encoder.write_header().map_err(PngError::from)?;
    let mut pixels = Vec::new();
    for drawing in drawings {
        pixels.clear();
        drawing.raster(scale)?.write(&mut pixels)?;
        // The encoder's stream of rows marks later frames wrongly.
        writer.write_image_data(&pixels).map_err(PngError::from)?;
    }
    writer.finish().map_err(PngError::from)?;
    Ok(file)
}

fn encoder<'a>(file: &'a mut Vec<u8>, raster: &Raster) -> Encoder<'static, &'a mut Vec<u8>> {
    let mut encoder = Encoder::new(file, raster.width, raster.height);
    encoder.set_color(ColorType::Rgb);
    encoder.set_compression(Compression::Fast);
    // Choosing a filter for every row saves a tenth of the file at most, and takes half as long again.
    encoder.set_filter(Filter::Paeth);
    encoder
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use png::{DecodeOptions, Decoder};

    use super::*;

    #[derive(Debug)]
    struct Frame {
        size: [u32; 2],
        delay: Option<[u16; 2]>,
        pixels: Vec<u8>,
    }

    /// The frames of a file, with checksums verified.
    fn frames(file: &[u8]) -> Vec<Frame> {
        let mut options = DecodeOptions::default();
        options.set_ignore_checksums(false);
        let mut reader = Decoder::new_with_options(Cursor::new(file), options).read_info().unwrap();
        let count = reader.info().animation_control().map_or(1, |control| control.num_frames);
        (0..count)
            .map(|_| {
                let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
                let frame = reader.next_frame(&mut pixels).unwrap();
                let delay =
                    reader.info().frame_control().map(|control| [control.delay_num, control.delay_den]);
                Frame { size: [frame.width, frame.height], delay, pixels }
            })
            .collect()
    }

    fn square(left: f64) -> Drawing {
        let mut drawing = Drawing::new("square", [12.0, 8.0]);
        let right = left + 4.0;
        drawing.polygon(vec![[left, 2.0], [right, 2.0], [right, 6.0], [left, 6.0]], [10, 20, 30]);
        drawing
    }

    #[test]
    fn pixels_come_back() {
        let file = square(4.0).png().unwrap();
        let found = frames(&file);
        let [Frame { size: [24, 16], delay: None, pixels }] = &found[..] else { panic!("{found:?}") };
        let pixel = |column: usize, row: usize| &pixels[3 * (24 * row + column)..][..3];
        assert_eq!(pixel(12, 8), [10, 20, 30], "the middle of the square");
        assert_eq!(pixel(2, 8), [255; 3], "beside it");
        assert_eq!(file, square(4.0).png().unwrap());
    }

    #[test]
    fn moving_pictures_are_shown_one_after_the_other() {
        let file = animation(&[square(1.0), square(3.0), square(5.0)], 0.05, 1.0).unwrap();
        let found = frames(&file);
        assert_eq!(found.len(), 3);
        for (index, Frame { size, delay, pixels }) in found.iter().enumerate() {
            assert_eq!((*size, *delay), ([12, 8], Some([50, 1000])), "50 thousandths of a second");
            let row = &pixels[3 * 12 * 4..];
            let left = (0..12).position(|column| row[3 * column] == 10);
            assert_eq!(left, Some(1 + 2 * index));
        }
        assert_eq!(animation(&[], 0.1, 1.0), Err(DrawingError::Png(PngError::Nothing)));
        let other = Drawing::new("other", [3.0, 3.0]);
        assert_eq!(animation(&[square(1.0), other], 0.1, 1.0), Err(DrawingError::Png(PngError::Sizes)));
    }
}
