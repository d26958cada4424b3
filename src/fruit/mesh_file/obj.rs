//! Wavefront OBJ: vertices, their colors, and faces. All else is skipped.

use glam::DVec3;

use super::{MeshFormatError, Parts, lines, three};
use crate::geometry::Cloud;

pub(super) fn parse(bytes: &[u8]) -> Result<Parts, MeshFormatError> {
    let (mut positions, mut colors, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
    for (line, text) in lines(bytes) {
        let mut words = text.split_whitespace();
        match words.next() {
            Some("v") => {
                let position = three(&mut words).ok_or(MeshFormatError::Vertex { line })?;
                positions.push(DVec3::from_array(position));
                // Three more numbers, 0 to 1, are a color by a wide-spread custom; a lone one is a weight.
                colors.extend(three(&mut words).map(color));
            }
            Some("f") => {
                let vertices = positions.len();
                let corners: Vec<u32> = words
                    .map(|word| corner(word, vertices, line))
                    .collect::<Result<_, _>>()?;
                if corners.len() < 3 {
                    return Err(MeshFormatError::Face { line });
                }
                triangles.extend(corners[1..].windows(2).map(|next| [corners[0], next[0], next[1]]));
            }
            _ => {}
        }
    }
    let has_colors = colors.len() == positions.len() && !colors.is_empty();
    let colors = has_colors.then_some(colors);
    Ok((Cloud::new(positions).with_columns(None, colors, None), triangles))
}

fn color(rgb: [f64; 3]) -> [u8; 4] {
    // A cast keeps within 0 to 255.
    let [r, g, b] = rgb.map(|channel| (channel * 255.0).round() as u8);
    [r, g, b, u8::MAX]
}

/// The vertex of a corner, which is written as `1`, `1/2`, `1//3` or `1/2/3`, or counted backwards from `-1`.
fn corner(word: &str, vertices: usize, line: usize) -> Result<u32, MeshFormatError> {
    let first = word.split('/').next().unwrap_or_default();
    let index: i64 = first.parse().map_err(|_| MeshFormatError::Face { line })?;
    let place = if index < 0 {
        index.checked_add(vertices as i64)
    } else {
        Some(index - 1)
    };
    let known = place.filter(|place| (0..vertices as i64).contains(place));
    let known = known.and_then(|place| u32::try_from(place).ok());
    known.ok_or(MeshFormatError::NoSuchVertex {
        line,
        index,
        vertices,
    })
}
