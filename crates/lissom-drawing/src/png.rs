//! Pictures as PNG files, and several of them as an animation (APNG, which browsers show; other programs show the first
//! picture).

use std::io::Write;

use flate2::write::ZlibEncoder;
use flate2::{Compression, Crc};

use crate::drawing::{Drawing, DrawingError};
use crate::raster::Image;

/// Why a picture cannot be written.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PngError {
    /// It has no pixels, or there is no picture.
    #[error("a picture without pixels")]
    Nothing,
    /// It has too many.
    #[error("a picture of {width} x {height} pixels is too large")]
    TooLarge {
        /// Width in pixels.
        width: u64,
        /// Height in pixels.
        height: u64,
    },
    /// Frames of an animation differ in size.
    #[error("the pictures of a moving one have different sizes")]
    Sizes,
}

const SIGNATURE: [u8; 8] = [0x89, b'P', b'N', b'G', 0x0d, 0x0a, 0x1a, 0x0a];

/// The bytes of a PNG file.
pub(crate) fn picture(image: &Image) -> Result<Vec<u8>, PngError> {
    let mut file = SIGNATURE.to_vec();
    chunk(&mut file, *b"IHDR", &header(image)?);
    chunk(&mut file, *b"IDAT", &compressed(image));
    chunk(&mut file, *b"IEND", &[]);
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
    let mut file = SIGNATURE.to_vec();
    let mut number = 0_u32;
    for (index, drawing) in drawings.iter().enumerate() {
        let image = drawing.image(scale)?;
        if index == 0 {
            chunk(&mut file, *b"IHDR", &header(&image)?);
            // Number of frames, and number of repetitions: infinite.
            chunk(&mut file, *b"acTL", &[(drawings.len() as u32).to_be_bytes(), [0; 4]].concat());
        }
        let mut control = number.to_be_bytes().to_vec();
        number += 1;
        control.extend((image.width as u32).to_be_bytes());
        control.extend((image.height as u32).to_be_bytes());
        // At the upper left corner, duration in thousandths, no disposal, no blending.
        control.extend([0; 8]);
        control.extend(milliseconds.to_be_bytes());
        control.extend(1000_u16.to_be_bytes());
        control.extend([0, 0]);
        chunk(&mut file, *b"fcTL", &control);
        let data = compressed(&image);
        if index == 0 {
            chunk(&mut file, *b"IDAT", &data);
        } else {
            let mut numbered = number.to_be_bytes().to_vec();
            number += 1;
            numbered.extend(data);
            chunk(&mut file, *b"fdAT", &numbered);
        }
    }
    chunk(&mut file, *b"IEND", &[]);
    Ok(file)
}

/// Size, eight bits for each of three colours, no interlacing.
fn header(image: &Image) -> Result<Vec<u8>, PngError> {
    let (width, height) = (image.width as u64, image.height as u64);
    let side = |side: u64| {
        u32::try_from(side).ok().filter(|side| *side < 1 << 31).ok_or(PngError::TooLarge { width, height })
    };
    let mut header = side(width)?.to_be_bytes().to_vec();
    header.extend(side(height)?.to_be_bytes());
    header.extend([8, 2, 0, 0, 0]);
    Ok(header)
}

/// Pictures are a twentieth larger than at level 6, which took a third of the instructions of a run with its plots.
const LEVEL: Compression = Compression::new(4);

/// Rows, each as the difference from the row above, compressed.
fn compressed(image: &Image) -> Vec<u8> {
    const UP: u8 = 2;
    let length = 3 * image.width;
    let mut encoder = ZlibEncoder::new(Vec::new(), LEVEL);
    let mut above = vec![0; length];
    let mut line = vec![UP; length + 1];
    for row in image.pixels.chunks_exact(length) {
        for (to, (here, above)) in line[1..].iter_mut().zip(row.iter().zip(&above)) {
            *to = here.wrapping_sub(*above);
        }
        above.copy_from_slice(row);
        // Writing to memory cannot fail.
        let _ = encoder.write_all(&line);
    }
    encoder.finish().unwrap_or_default()
}

fn chunk(file: &mut Vec<u8>, kind: [u8; 4], content: &[u8]) {
    file.extend((content.len() as u32).to_be_bytes());
    let start = file.len();
    file.extend(kind);
    file.extend(content);
    let mut sum = Crc::new();
    sum.update(&file[start..]);
    file.extend(sum.sum().to_be_bytes());
}

#[cfg(test)]
mod tests {
    use std::io::Read;

    use super::*;

    /// Types and contents of the chunks of a file, with their checksums verified.
    fn chunks(file: &[u8]) -> Vec<(String, Vec<u8>)> {
        assert_eq!(file[..8], SIGNATURE);
        let (mut at, mut found) = (8, Vec::new());
        while at < file.len() {
            let number = |at: usize| u32::from_be_bytes(file[at..at + 4].try_into().unwrap());
            let length = number(at) as usize;
            let mut sum = Crc::new();
            sum.update(&file[at + 4..at + 8 + length]);
            assert_eq!(sum.sum(), number(at + 8 + length));
            let kind = String::from_utf8(file[at + 4..at + 8].to_vec()).unwrap();
            found.push((kind, file[at + 8..at + 8 + length].to_vec()));
            at += 12 + length;
        }
        found
    }

    fn square(left: f64) -> Drawing {
        let mut drawing = Drawing::new("square", [12.0, 8.0]);
        let right = left + 4.0;
        drawing.polygon(vec![[left, 2.0], [right, 2.0], [right, 6.0], [left, 6.0]], [10, 20, 30]);
        drawing
    }

    #[test]
    fn pixels_come_back() {
        let drawing = square(4.0);
        let found = chunks(&drawing.png().unwrap());
        let kinds: Vec<&str> = found.iter().map(|(kind, _)| kind.as_str()).collect();
        assert_eq!(kinds, ["IHDR", "IDAT", "IEND"]);
        assert_eq!(found[0].1, [0, 0, 0, 24, 0, 0, 0, 16, 8, 2, 0, 0, 0]);
        let mut bytes = Vec::new();
        flate2::read::ZlibDecoder::new(&found[1].1[..]).read_to_end(&mut bytes).unwrap();
        assert_eq!(bytes.len(), 16 * (1 + 3 * 24));
        let mut rows = vec![vec![0_u8; 72]];
        for row in bytes.chunks_exact(73) {
            let above = rows.last().unwrap();
            rows.push(
                above.iter().zip(&row[1..]).map(|(above, change)| above.wrapping_add(*change)).collect(),
            );
        }
        assert_eq!(rows[1 + 8][3 * 12..3 * 12 + 3], [10, 20, 30], "the middle of the square");
        assert_eq!(rows[1 + 8][3 * 2..3 * 2 + 3], [255; 3], "beside it");
        assert_eq!(rows[1..].concat(), drawing.image(2.0).unwrap().pixels);
    }

    #[test]
    fn moving_pictures_have_numbered_parts() {
        let file = animation(&[square(1.0), square(3.0), square(5.0)], 0.05, 1.0).unwrap();
        let found = chunks(&file);
        let kinds: Vec<&str> = found.iter().map(|(kind, _)| kind.as_str()).collect();
        assert_eq!(kinds, ["IHDR", "acTL", "fcTL", "IDAT", "fcTL", "fdAT", "fcTL", "fdAT", "IEND"]);
        assert_eq!(found[1].1, [0, 0, 0, 3, 0, 0, 0, 0]);
        let numbers: Vec<u8> =
            found.iter().filter(|(kind, _)| kind.starts_with('f')).map(|(_, c)| c[3]).collect();
        assert_eq!(numbers, [0, 1, 2, 3, 4]);
        assert_eq!(found[2].1[20..24], [0, 50, 3, 232], "50 thousandths of a second");
        assert_eq!(animation(&[], 0.1, 1.0), Err(DrawingError::Png(PngError::Nothing)));
        let other = Drawing::new("other", [3.0, 3.0]);
        assert_eq!(animation(&[square(1.0), other], 0.1, 1.0), Err(DrawingError::Png(PngError::Sizes)));
    }
}
