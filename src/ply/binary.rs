//! The body of a binary PLY file, of either byte order.

use half::f16;

use super::Note;
use super::collect::{BLOCK, Collector};
use super::columns::{Columns, Role};
use super::error::{PlyError, Problem, quoted};
use super::header::{Element, Header, Kind};
use super::scalar::{FromBytes, Scalar, value};

/// Reads the vertices into the collector and steps over everything else.
pub(super) fn read<const BIG_ENDIAN: bool>(
    bytes: &[u8],
    header: &Header,
    vertex: &Element,
    columns: &Columns,
    collector: &mut Collector<'_>,
    notes: &mut Vec<Note>,
) -> Result<(), PlyError> {
    let body = Body::<BIG_ENDIAN> { bytes };
    let mut at = header.body;
    let mut elements = header.elements.iter();
    for element in elements.by_ref() {
        if std::ptr::eq(element, vertex) {
            at = body.collect(at, element, columns, collector)?;
            break;
        }
        at = body.skip(at, element)?;
    }
    for element in elements {
        let Ok(next) = body.skip(at, element) else {
            notes.push(Note::RestDamaged {
                element: quoted(element.name.as_bytes()),
            });
            return Ok(());
        };
        at = next;
    }
    let rest = bytes.get(at..).unwrap_or_default().trim_ascii();
    if !rest.is_empty() {
        notes.push(Note::Trailing { bytes: rest.len() });
    }
    Ok(())
}

struct Body<'a, const BIG_ENDIAN: bool> {
    bytes: &'a [u8],
}

impl<const BIG_ENDIAN: bool> Body<'_, BIG_ENDIAN> {
    /// The end of an element that starts at `at`.
    fn skip(&self, at: usize, element: &Element) -> Result<usize, PlyError> {
        if element.has_lists() {
            self.rows_with_lists(at, element, None)
        } else {
            Ok(at + self.fixed_rows(at, element)?.len())
        }
    }

    /// Reads the vertices, which start at `at`, and returns where they end.
    fn collect(
        &self,
        at: usize,
        vertex: &Element,
        columns: &Columns,
        collector: &mut Collector<'_>,
    ) -> Result<usize, PlyError> {
        if vertex.has_lists() {
            let fit = self.from(at).len() / vertex.least_stride().max(1);
            collector.reserve(usize::try_from(vertex.count).unwrap_or(usize::MAX).min(fit));
            return self.rows_with_lists(at, vertex, Some((columns, collector)));
        }
        let rows = self.fixed_rows(at, vertex)?;
        collect_fixed::<BIG_ENDIAN>(rows, vertex, columns, collector)?;
        Ok(at + rows.len())
    }

    /// The bytes from `at` to the end of the file.
    fn from(&self, at: usize) -> &[u8] {
        self.bytes.get(at..).unwrap_or_default()
    }

    fn ends_early(&self, element: &Element, complete: u64) -> PlyError {
        PlyError::at_byte(self.bytes.len(), element.ends_early(complete))
    }

    /// All rows of an element without lists. An element without properties takes no bytes, for any count.
    fn fixed_rows(&self, at: usize, element: &Element) -> Result<&[u8], PlyError> {
        let rest = self.from(at);
        let stride = element.least_stride();
        if stride == 0 {
            return Ok(&[]);
        }
        let complete = (rest.len() / stride) as u64;
        // A count that does not fit in memory's measure is above `complete` too.
        usize::try_from(element.count)
            .ok()
            .and_then(|count| count.checked_mul(stride))
            .and_then(|size| rest.get(..size))
            .ok_or_else(|| self.ends_early(element, complete))
    }

    /// Walks an element row by row and returns where it ends. Every row has a list, and so at least a
    /// byte: no count keeps this going beyond the end of the file.
    fn rows_with_lists(
        &self,
        mut at: usize,
        element: &Element,
        mut sink: Option<(&Columns, &mut Collector<'_>)>,
    ) -> Result<usize, PlyError> {
        let mut filled = 0;
        for row in 0..element.count {
            for (index, property) in element.properties.iter().enumerate() {
                let (Kind::Scalar(kind) | Kind::List { count: kind, .. }) = property.kind;
                let read = value(kind, self.from(at), BIG_ENDIAN);
                let read = read.ok_or_else(|| self.ends_early(element, row))?;
                if let Kind::List { item, .. } = property.kind {
                    if read < 0.0 {
                        return Err(PlyError::at_byte(at, Problem::NegativeListCount(read as i64)));
                    }
                    // A cast of too large a count stays too large for any file.
                    let end = (read as usize)
                        .checked_mul(item.size())
                        .and_then(|size| size.checked_add(at + kind.size()));
                    at = end
                        .filter(|&end| end <= self.bytes.len())
                        .ok_or_else(|| self.ends_early(element, row))?;
                    continue;
                }
                if let Some((columns, collector)) = &mut sink
                    && let Some(&Some(role)) = columns.roles().get(index)
                {
                    collector.block().column(role)[filled] = read;
                }
                at += kind.size();
            }
            if let Some((_, collector)) = &mut sink {
                filled += 1;
                if filled == BLOCK {
                    collector.take(filled)?;
                    filled = 0;
                }
            }
        }
        if let Some((_, collector)) = sink {
            collector.take(filled)?;
        }
        Ok(at)
    }
}

/// Reads rows of one length, block by block and within a block column by column, so that a column's type is matched once
/// per block and not once per value.
fn collect_fixed<const BIG_ENDIAN: bool>(
    rows: &[u8],
    vertex: &Element,
    columns: &Columns,
    collector: &mut Collector<'_>,
) -> Result<(), PlyError> {
    let stride = vertex.least_stride().max(1);
    let mut plan: Vec<(Role, Scalar, usize)> = Vec::new();
    let mut offset = 0;
    for (property, role) in vertex.properties.iter().zip(columns.roles()) {
        let Kind::Scalar(kind) = property.kind else {
            continue;
        };
        plan.extend(role.map(|role| (role, kind, offset)));
        offset += kind.size();
    }
    collector.reserve(rows.len() / stride);
    for block in rows.chunks(stride * BLOCK) {
        for &(role, kind, offset) in &plan {
            let from = block.get(offset..).unwrap_or_default();
            let out = collector.block().column(role);
            match kind {
                Scalar::I8 => decode::<i8, 1, BIG_ENDIAN>(from, stride, out),
                Scalar::U8 => decode::<u8, 1, BIG_ENDIAN>(from, stride, out),
                Scalar::I16 => decode::<i16, 2, BIG_ENDIAN>(from, stride, out),
                Scalar::U16 => decode::<u16, 2, BIG_ENDIAN>(from, stride, out),
                Scalar::I32 => decode::<i32, 4, BIG_ENDIAN>(from, stride, out),
                Scalar::U32 => decode::<u32, 4, BIG_ENDIAN>(from, stride, out),
                Scalar::I64 => decode::<i64, 8, BIG_ENDIAN>(from, stride, out),
                Scalar::U64 => decode::<u64, 8, BIG_ENDIAN>(from, stride, out),
                Scalar::F16 => decode::<f16, 2, BIG_ENDIAN>(from, stride, out),
                Scalar::F32 => decode::<f32, 4, BIG_ENDIAN>(from, stride, out),
                Scalar::F64 => decode::<f64, 8, BIG_ENDIAN>(from, stride, out),
            }
        }
        collector.take(block.len() / stride)?;
    }
    Ok(())
}

/// Reads the values that start a stride apart.
fn decode<T: FromBytes<SIZE>, const SIZE: usize, const BIG_ENDIAN: bool>(
    from: &[u8],
    stride: usize,
    out: &mut [f64; BLOCK],
) {
    for (row, out) in from.chunks(stride).zip(out) {
        if let Some(&bytes) = row.first_chunk() {
            *out = T::from_bytes(bytes, BIG_ENDIAN);
        }
    }
}
