//! The errors of meshes in OBJ and STL files.

/// The reason why a text is no mesh, or a binary STL file is not whole.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum MeshFormatError {
    /// A vertex of a text has no three numbers.
    #[error("line {line}: a vertex takes three numbers")]
    Vertex {
        /// The line, from 1.
        line: usize,
    },
    /// A face of an OBJ file is not made of at least three whole numbers.
    #[error("line {line}: a face takes at least three indices of vertices")]
    Face {
        /// The line, from 1.
        line: usize,
    },
    /// A face of an OBJ file has a corner that is not among the vertices before it.
    #[error("line {line}: a face has the corner {index}, after {vertices} vertices")]
    NoSuchVertex {
        /// The line, from 1.
        line: usize,
        /// The index as it stands in the file: from 1, or from −1 backwards.
        index: i64,
        /// The number of vertices before the line.
        vertices: usize,
    },
    /// A facet of an STL text has not three corners.
    #[error("line {line}: a facet does not have three corners")]
    Corners {
        /// The line, from 1, where the facet ends.
        line: usize,
    },
    /// A binary STL file ends too early.
    #[error("the file ends after {complete} of {count} triangles")]
    EndsEarly {
        /// The number of complete triangles.
        complete: usize,
        /// The number by the header.
        count: u32,
    },
    /// A corner of a binary STL file is infinite or no number.
    #[error("triangle {triangle} has a coordinate that is not finite")]
    NotFinite {
        /// The triangle, from 0.
        triangle: usize,
    },
    /// An STL file is shorter than its header, and no text.
    #[error("this is not an STL file: it does not start with \"solid\" and is shorter than a binary header")]
    NotStl,
    /// The file's name ends in none of the known endings.
    #[error("the file's name must end in .ply, .obj or .stl")]
    UnknownEnding,
}
