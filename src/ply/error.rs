//! The errors of the PLY reader, with their place in the file.

use std::fmt;

/// The place of an error in the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// The file as a whole.
    File,
    /// A line of the header or of an ASCII body, counted from 1.
    Line(usize),
    /// A byte of a binary body, counted from 0 at the start of the file.
    Byte(usize),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File => f.write_str("the file"),
            Self::Line(line) => write!(f, "line {line}"),
            Self::Byte(byte) => write!(f, "byte {byte}"),
        }
    }
}

/// A PLY file that cannot be read. Displayed as one line: the place, then what is wrong there.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{}{problem}", match .place {
    Place::File => String::new(),
    place => format!("{place}: "),
})]
pub struct PlyError {
    /// The place of the error.
    pub place: Place,
    /// The error.
    pub problem: Problem,
}

impl PlyError {
    pub(super) fn of_file(problem: Problem) -> Self {
        Self {
            place: Place::File,
            problem,
        }
    }

    pub(super) fn at_line(line: usize, problem: Problem) -> Self {
        Self {
            place: Place::Line(line),
            problem,
        }
    }

    pub(super) fn at_byte(byte: usize, problem: Problem) -> Self {
        Self {
            place: Place::Byte(byte),
            problem,
        }
    }
}

/// A defect of a PLY file. Texts from the file are escaped and shortened.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Problem {
    /// There are no bytes.
    #[error("the file is empty")]
    Empty,
    /// The first word is not `ply`.
    #[error("this is not a PLY file (its first word must be \"ply\")")]
    NotPly,
    /// The first bytes are those of some other format.
    #[error("this is not a PLY file but {0}")]
    OtherFormat(&'static str),
    /// No `end_header` line, or none within the bytes that a header may take.
    #[error("the header has no \"end_header\" line within the first {searched} bytes")]
    NoEndHeader {
        /// The number of bytes that were searched.
        searched: usize,
    },
    /// No `format` line.
    #[error("the header has no \"format\" line")]
    NoFormat,
    /// A second `format` line.
    #[error("a second \"format\" line")]
    SecondFormat,
    /// A format that is none of the three.
    #[error("unknown format {0} (ascii, binary_little_endian or binary_big_endian)")]
    UnknownFormat(String),
    /// A header line with too few or too many words.
    #[error("{found} words where \"{form}\" is expected")]
    Malformed {
        /// The expected form of the line.
        form: &'static str,
        /// The number of its words.
        found: usize,
    },
    /// A count of an element that is not a whole number, or too large for 64 bits.
    #[error("the count {0} is not a whole number that fits in 64 bits")]
    BadCount(String),
    /// A property before the first element.
    #[error("a property before the first element")]
    PropertyBeforeElement,
    /// A type that PLY does not know.
    #[error("unknown type {0}")]
    UnknownType(String),
    /// A list whose count is a floating-point number.
    #[error("the count of a list cannot be of type {0}")]
    FractionalListCount(String),
    /// Two elements of one name.
    #[error("element {name} was declared on line {first_line} already")]
    DuplicateElement {
        /// The name.
        name: String,
        /// The line of the first declaration.
        first_line: usize,
    },
    /// Two properties of one name in one element.
    #[error("property {name} was declared on line {first_line} already")]
    DuplicateProperty {
        /// The name.
        name: String,
        /// The line of the first declaration.
        first_line: usize,
    },
    /// No vertex element.
    #[error("the header has no vertex element")]
    NoVertex,
    /// The vertex element has no x, y or z.
    #[error("the vertex element has no property \"{0}\"")]
    NoCoordinate(&'static str),
    /// A coordinate is a list.
    #[error("property \"{0}\" is a list where a single number is expected")]
    CoordinateIsList(&'static str),
    /// The file ends before the last vertex.
    #[error("the file ends after {complete} of {count} rows of element {element}")]
    EndsEarly {
        /// The name of the element that is cut short, quoted.
        element: String,
        /// The number of its complete rows.
        complete: u64,
        /// The number of its rows by the header.
        count: u64,
    },
    /// A list with a count below zero.
    #[error("a list of {0} items")]
    NegativeListCount(i64),
    /// A list in an ASCII file whose count is not a whole number.
    #[error("the count of a list is {0}, which is no whole number from zero on")]
    BadListCount(String),
    /// A word that is no number.
    #[error("{0} is not a number")]
    NotANumber(String),
    /// A word that would be a number were its comma a point.
    #[error("{0} is not a number (the decimal sign must be a point, the separator a space)")]
    Comma(String),
    /// A row with too few or too many numbers.
    #[error("{found} numbers where {}{expected} are expected", if *.at_least { "at least " } else { "" })]
    RowLength {
        /// The count of numbers on the line.
        found: usize,
        /// The count by the header.
        expected: usize,
        /// Whether the row has lists, which may add to the expected count.
        at_least: bool,
    },
    /// A mesh is asked for, and there are no faces.
    #[error(
        "it has no faces (an element \"face\" with a list \"vertex_indices\"); a cloud of points cannot be scanned"
    )]
    NoFaces,
    /// A face has a corner that is no vertex.
    #[error("a face has the corner {index}, and the vertices are 0 to {}", .vertices - 1)]
    NoSuchVertex {
        /// The corner's index.
        index: String,
        /// The number of vertices.
        vertices: usize,
    },
    /// A mesh has vertices whose x, y or z is infinite or no number.
    #[error("{0} vertices have coordinates that are not finite")]
    VerticesNotFinite(usize),
    /// Reading was called off; nothing is wrong.
    #[error("reading was called off")]
    Cancelled,
}

/// A word from the file for a message: quoted, escaped, on one line, not too long.
pub(super) fn quoted(word: &[u8]) -> String {
    const LONGEST: usize = 40;
    let text = text(word);
    let mut shown: String = text.chars().take(LONGEST).flat_map(char::escape_debug).collect();
    if text.chars().nth(LONGEST).is_some() {
        shown.push('…');
    }
    format!("\"{shown}\"")
}

/// Text of a header: UTF-8, or else Latin-1, in which every byte is a character.
pub(super) fn text(bytes: &[u8]) -> String {
    match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().map(|&byte| char::from(byte)).collect(),
    }
}
