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
#[path = "../tests/unit/png.rs"]
mod tests;
