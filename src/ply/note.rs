//! Peculiarities of a PLY file that could be read all the same.

use super::Place;

/// Something about a file that its owner should know though it was read. Displayed as one sentence
/// without a full stop.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Note {
    /// Lines in the header that mean nothing in PLY; they were ignored.
    #[error("{} ignored", unknown_lines(*.first_line, *.count))]
    UnknownHeaderLines {
        /// The first of them, counted from 1.
        first_line: usize,
        /// Their number.
        count: usize,
    },
    /// A version other than 1.0, or none; the file was read as 1.0.
    #[error("The format's version is {0} and was taken for \"1.0\"")]
    Version(String),
    /// A `comment unit` that names no unit we know; it was ignored.
    #[error("Line {line} states the unknown unit {unit} (m, cm or mm) and was ignored")]
    UnknownUnit {
        /// The line, counted from 1.
        line: usize,
        /// The stated unit, quoted.
        unit: String,
    },
    /// Two comments state different units; both were ignored.
    #[error("Line {line} states another unit than a line before it; both were ignored")]
    UnitsDisagree {
        /// The line of the second, counted from 1.
        line: usize,
    },
    /// Some but not all properties of a column are there; the column was ignored.
    #[error("The {column} were ignored, as property \"{missing}\" is missing or is a list")]
    Incomplete {
        /// The name of the column.
        column: &'static str,
        /// The first property that is missing or is a list.
        missing: &'static str,
    },
    /// Labels that are no numbers, or too large; they were read as −1.
    #[error("Labels that are no numbers or too large were read as −1: {count}")]
    UnusableLabels {
        /// Their number.
        count: usize,
    },
    /// The rows of an ASCII file do not take one line each; it was read word by word.
    #[error("From {place} on, rows and lines do not go together; the numbers were read in sequence")]
    RowsWrap {
        /// The first line that is not a row.
        place: Place,
    },
    /// An element after the vertices, such as the faces, is damaged or cut short.
    #[error("Element {element}, which is not needed here, is damaged or cut short")]
    RestDamaged {
        /// The name of that element, or of the first of several, quoted.
        element: String,
    },
    /// Something follows the last element.
    #[error("Something follows the last element and was ignored, in bytes: {bytes}")]
    Trailing {
        /// The number of bytes, without white space around them.
        bytes: usize,
    },
}

fn unknown_lines(first_line: usize, count: usize) -> String {
    match count {
        1 => format!("Line {first_line} of the header is unknown and was"),
        _ => {
            format!("{count} lines of the header, the first of them line {first_line}, are unknown and were")
        }
    }
}
