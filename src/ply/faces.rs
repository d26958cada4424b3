//! The faces of a PLY file, as triangles.

use super::error::{PlyError, Problem, quoted};
use super::header::{Element, Header, Kind, line_of};
use super::number::{is_space, number, word};
use super::scalar::{Scalar, value};
use super::{Encoding, PlyCloud, read};

/// The vertices and faces of a PLY file.
#[derive(Debug, Clone, PartialEq)]
pub struct PlyMesh {
    /// The vertices, all of them finite.
    pub vertices: PlyCloud,
    /// Three indices of vertices each. A face of more corners is a fan of triangles around its first.
    pub triangles: Vec<[u32; 3]>,
}

/// Reads a mesh from the bytes of a PLY file whose element `face` has a list `vertex_indices` or `vertex_index`.
///
/// # Errors
/// Returns the errors of [`read`], and an error if there are no faces, they are malformed or end early, or a vertex is
/// not finite.
pub fn read_mesh(bytes: &[u8]) -> Result<PlyMesh, PlyError> {
    let header = Header::parse(bytes)?;
    // Before the vertices, which may be many: most clouds have no faces.
    let (face, indices) = face_list(&header).ok_or_else(|| PlyError::of_file(Problem::NoFaces))?;
    let vertices = read(bytes)?;
    let not_finite = vertices.dropped_not_finite;
    if not_finite > 0 {
        return Err(PlyError::of_file(Problem::VerticesNotFinite(not_finite)));
    }
    let mut body = Body {
        bytes,
        at: header.body,
        encoding: header.encoding,
    };
    let mut triangles = Vec::new();
    for element in &header.elements {
        if std::ptr::eq(element, face) {
            body.triangles(face, indices, vertices.cloud.len(), &mut triangles)?;
            break;
        }
        body.rows(element, |_, _, _| Ok(()))?;
    }
    if triangles.is_empty() {
        return Err(PlyError::of_file(Problem::NoFaces));
    }
    Ok(PlyMesh { vertices, triangles })
}

/// The element with the faces, and the place of the list among its properties.
fn face_list(header: &Header) -> Option<(&Element, usize)> {
    let is_face = |e: &&Element| e.name.eq_ignore_ascii_case("face");
    let face = header.elements.iter().find(is_face)?;
    let list = face.properties.iter().position(|property| {
        let named = ["vertex_indices", "vertex_index"];
        let is_named = named.iter().any(|name| property.name.eq_ignore_ascii_case(name));
        is_named && matches!(property.kind, Kind::List { .. })
    });
    Some((face, list?))
}

/// The body of a file, read number by number.
struct Body<'a> {
    bytes: &'a [u8],
    at: usize,
    encoding: Encoding,
}

impl Body<'_> {
    fn triangles(
        &mut self,
        face: &Element,
        indices: usize,
        vertices: usize,
        triangles: &mut Vec<[u32; 3]>,
    ) -> Result<(), PlyError> {
        let mut corners: [u32; 2] = [0; 2];
        self.rows(face, |property, place, index| {
            if property != indices {
                return Ok(());
            }
            if index.fract() != 0.0 || index < 0.0 || index >= vertices as f64 {
                let index = index.to_string();
                return Err(Problem::NoSuchVertex { index, vertices });
            }
            // A whole number below a count of vertices in memory; more than 32 bits would be 100 GB of them.
            let index = index as u32;
            match place {
                0 => corners[0] = index,
                1 => corners[1] = index,
                _ => {
                    triangles.push([corners[0], corners[1], index]);
                    corners[1] = index;
                }
            }
            Ok(())
        })
    }

    /// Calls `visit` with each number of each list of an element: the list's place among the properties, the number's
    /// place in the list, and the number.
    fn rows(
        &mut self,
        element: &Element,
        mut visit: impl FnMut(usize, usize, f64) -> Result<(), Problem>,
    ) -> Result<(), PlyError> {
        if element.properties.is_empty() {
            return Ok(());
        }
        for row in 0..element.count {
            for (at, property) in element.properties.iter().enumerate() {
                match property.kind {
                    Kind::Scalar(kind) => {
                        self.next(kind).ok_or_else(|| self.missing(element, row))?;
                    }
                    Kind::List { count, item } => {
                        let count = self.next(count).ok_or_else(|| self.missing(element, row))?;
                        if count < 0.0 || count.fract() != 0.0 {
                            return Err(self.error(Problem::NegativeListCount(count as i64)));
                        }
                        // A cast of too large a count stays too large for any file.
                        for place in 0..count as usize {
                            let number = self.next(item).ok_or_else(|| self.missing(element, row))?;
                            visit(at, place, number).map_err(|problem| self.error(problem))?;
                        }
                    }
                }
            }
        }
        Ok(())
    }

    /// Takes the next number; `None` at the end of the file or before what is no number.
    fn next(&mut self, kind: Scalar) -> Option<f64> {
        let rest = self.bytes.get(self.at..)?;
        if self.encoding == Encoding::Ascii {
            let space = rest.iter().take_while(|&&byte| is_space(byte)).count();
            let (number, taken) = number(&rest[space..])?;
            self.at += space + taken;
            Some(number)
        } else {
            let number = value(kind, rest, self.encoding == Encoding::BinaryBigEndian)?;
            self.at += kind.size();
            Some(number)
        }
    }

    /// The error of a row whose next number is not there.
    #[cold]
    fn missing(&self, element: &Element, row: u64) -> PlyError {
        let rest = self.bytes.get(self.at..).unwrap_or_default().trim_ascii_start();
        if self.encoding == Encoding::Ascii && !rest.is_empty() {
            self.error(Problem::NotANumber(quoted(word(rest))))
        } else {
            self.error(element.ends_early(row))
        }
    }

    #[cold]
    fn error(&self, problem: Problem) -> PlyError {
        match self.encoding {
            Encoding::Ascii => PlyError::at_line(line_of(self.bytes, self.at), problem),
            _ => PlyError::at_byte(self.at, problem),
        }
    }
}
