//! A reader and a writer of PLY point clouds, from bytes and to bytes.
//!
//! The reader accepts every file that describes points and skips all other elements and properties. A malformed file
//! gives an error with its line or byte; a merely unusual file is read, and [`PlyCloud::notes`] tells of it.
//!
//! For any bytes at all the reader does not panic, takes time proportional to the file's size, and memory of a small
//! multiple of it: nothing is allocated that the remaining bytes cannot fill.

mod ascii;
mod binary;
mod collect;
mod columns;
mod error;
mod faces;
mod header;
mod note;
mod number;
mod scalar;
mod write;

pub use error::{Place, PlyError, Problem};
pub use faces::{PlyMesh, read_mesh};
pub use note::Note;
pub use write::{Encoding, Precision, WriteError, WriteOptions, write};

use crate::geometry::{Cloud, Unit};
use crate::parallel::Watch;
use collect::Collector;
use columns::Columns;
use header::Header;

/// The points of a PLY file.
#[derive(Debug, Clone, PartialEq)]
pub struct PlyCloud {
    /// The points whose position is finite, in the file's order, unit and frame. A normal that is not
    /// finite is the zero vector ("none").
    pub cloud: Cloud,
    /// The number of points that were left out since x, y or z is infinite or no number.
    pub dropped_not_finite: usize,
    /// The unit that a `comment unit m` (or `cm`, `mm`) in the header states. This is our own
    /// convention: PLY has none.
    pub stated_unit: Option<Unit>,
    /// The peculiarities of the file, each a short sentence when displayed.
    pub notes: Vec<Note>,
}

/// Reads a PLY file from its bytes: ASCII or binary of either byte order, any scalar type for any
/// property.
///
/// Positions in ASCII keep all digits of the file, even if the header says `float`.
///
/// ```
/// use axiscope::ply;
///
/// let file = b"ply
/// format ascii 1.0
/// comment unit cm
/// element vertex 2
/// property float x
/// property float y
/// property float z
/// end_header
/// 1 2 30
/// nan 0 0
/// ";
/// let read = ply::read(file)?;
/// assert_eq!(read.cloud.len(), 1);
/// assert_eq!(read.dropped_not_finite, 1);
/// # Ok::<(), ply::PlyError>(())
/// ```
///
/// # Errors
/// Returns an error if the bytes are no PLY file, if the header is malformed or has no vertices with x, y and z, or if
/// the body is malformed or ends before the last vertex.
pub fn read(bytes: &[u8]) -> Result<PlyCloud, PlyError> {
    read_watched(bytes, &())
}

/// [`read`] with its progress reported to `watch`.
///
/// # Errors
/// Returns the errors of [`read`], and [`Problem::Cancelled`] if the watch calls the work off. It is asked every few
/// thousand rows.
pub fn read_watched(bytes: &[u8], watch: &dyn Watch) -> Result<PlyCloud, PlyError> {
    let mut header = Header::parse(bytes)?;
    let mut notes = std::mem::take(&mut header.notes);
    let vertex = header.vertex()?;
    let columns = Columns::of(vertex, &mut notes)?;
    let mut collector = Collector::new(&columns, vertex.count, watch);
    match header.encoding {
        Encoding::Ascii => ascii::read(bytes, &header, vertex, &columns, &mut collector, &mut notes)?,
        Encoding::BinaryLittleEndian => {
            binary::read::<false>(bytes, &header, vertex, &columns, &mut collector, &mut notes)?;
        }
        Encoding::BinaryBigEndian => {
            binary::read::<true>(bytes, &header, vertex, &columns, &mut collector, &mut notes)?;
        }
    }
    let (cloud, dropped_not_finite) = collector.finish(&mut notes);
    Ok(PlyCloud {
        cloud,
        dropped_not_finite,
        stated_unit: header.stated_unit,
        notes,
    })
}
