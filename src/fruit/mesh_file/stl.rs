//! STL, text or binary: triangles without shared corners.

use glam::DVec3;

use super::{MeshFormatError, Parts, lines, three};
use crate::geometry::Cloud;

/// The bytes of a binary file before the triangles: a comment, and their number.
const HEADER: usize = 84;
/// The bytes of a triangle: a normal, three corners, and two bytes more.
const TRIANGLE: usize = 50;

pub(super) fn parse(bytes: &[u8]) -> Result<Parts, MeshFormatError> {
    let count = bytes
        .get(HEADER - 4..HEADER)
        .and_then(|count| count.first_chunk());
    let count = count.map(|count| u32::from_le_bytes(*count));
    // Some programs begin the comment of a binary file with "solid", too; then only the length tells.
    let is_whole = count.is_some_and(|count| bytes.len() == HEADER + TRIANGLE * count as usize);
    let corners = if bytes.trim_ascii_start().starts_with(b"solid") && !is_whole {
        of_text(bytes)?
    } else {
        of_binary(
            &bytes[HEADER.min(bytes.len())..],
            count.ok_or(MeshFormatError::NotStl)?,
        )?
    };
    let triangles = (0..corners.len() as u32 / 3).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]);
    // The mesh would look for them in a cloud that left them out.
    if let Some(vertex) = corners.iter().position(|p| !p.is_finite()) {
        return Err(MeshFormatError::NotFinite { triangle: vertex / 3 });
    }
    Ok((Cloud::new(corners), triangles.collect()))
}

fn of_binary(rows: &[u8], count: u32) -> Result<Vec<DVec3>, MeshFormatError> {
    let complete = rows.len() / TRIANGLE;
    if complete < count as usize {
        return Err(MeshFormatError::EndsEarly { complete, count });
    }
    let rows = rows.chunks_exact(TRIANGLE).take(count as usize);
    let number = |bytes: &[u8]| f64::from(f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]));
    let corner = |bytes: &[u8]| DVec3::new(number(bytes), number(&bytes[4..]), number(&bytes[8..]));
    Ok(rows
        .flat_map(|row| row[12..48].chunks_exact(12).map(corner))
        .collect())
}

fn of_text(bytes: &[u8]) -> Result<Vec<DVec3>, MeshFormatError> {
    let mut corners = Vec::new();
    let mut last_line = 0;
    for (line, text) in lines(bytes) {
        let mut words = text.split_whitespace();
        let first = words.next().unwrap_or_default();
        if first.eq_ignore_ascii_case("vertex") {
            let corner = three(&mut words).ok_or(MeshFormatError::Vertex { line })?;
            corners.push(DVec3::from_array(corner));
        } else if first.eq_ignore_ascii_case("endloop") && corners.len() % 3 != 0 {
            return Err(MeshFormatError::Corners { line });
        }
        last_line = line;
    }
    if corners.len() % 3 == 0 {
        Ok(corners)
    } else {
        Err(MeshFormatError::Corners { line: last_line })
    }
}
