//! A picture in memory.

/// The longest side of a picture: larger ones are typing errors, and a gigabyte of memory.
pub const MAX_SIDE_PX: u32 = 16_384;

/// An opaque picture: four bytes a pixel (red, green, blue, alpha; sRGB), row after row from the top.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Image {
    /// Pixels a row.
    pub width_px: u32,
    /// Rows.
    pub height_px: u32,
    /// The pixels.
    pub rgba: Vec<u8>,
}

impl Image {
    /// The pixel in column `x` and row `y`, if it is there.
    pub fn pixel(&self, x: u32, y: u32) -> Option<[u8; 4]> {
        if x >= self.width_px || y >= self.height_px {
            return None;
        }
        let at = 4 * (y as usize * self.width_px as usize + x as usize);
        self.rgba.get(at..at + 4)?.try_into().ok()
    }
}
