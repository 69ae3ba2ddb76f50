//! Pixels below a drawing.

use crate::drawing::Shade;

/// Pixels below a drawing, row by row from above.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// Width and height.
    pub size: [u32; 2],
    /// Their colours.
    pub pixels: Vec<Shade>,
}

impl Image {
    /// A white one.
    pub fn white(size: [u32; 2]) -> Self {
        Self { size, pixels: vec![[255; 3]; size[0] as usize * size[1] as usize] }
    }
}
