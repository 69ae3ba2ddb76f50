//! Pictures as PNG files.

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
        self.png_at(2.0)
    }

    /// The drawing as the bytes of a PNG file with `scale` pixels for each of the drawing.
    ///
    /// # Errors
    /// If a position is not a finite number, or the drawing is too large.
    pub fn png_at(&self, scale: f64) -> Result<Vec<u8>, DrawingError> {
        Ok(picture(&self.raster(scale)?)?)
    }
}

/// The bytes of a PNG file.
fn picture(raster: &Raster) -> Result<Vec<u8>, PngError> {
    let mut file = Vec::new();
    let mut writer = encoder(&mut file, [raster.width, raster.height]).write_header()?;
    let mut stream = writer.stream_writer()?;
    raster.write(None, &mut stream)?;
    stream.finish()?;
    writer.finish()?;
    Ok(file)
}

/// An encoder of this width and height.
pub(crate) fn encoder(file: &mut Vec<u8>, [width, height]: [u32; 2]) -> Encoder<'static, &mut Vec<u8>> {
    let mut encoder = Encoder::new(file, width, height);
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
}
