//! PLY: one point cloud from the bytes of a file, and back.
//!
//! Every file that describes points is read, whatever it holds besides: elements and properties of
//! no use here are skipped. What is malformed is refused with the line or the byte where it shows;
//! what is merely unusual is read, and told in [`PlyCloud::notes`].
//!
//! Reading keeps these promises for any bytes at all: no panic, time proportional to the file's
//! size, and memory of a small multiple of it, because nothing is allocated that the remaining
//! bytes cannot fill.

mod ascii;
mod binary;
mod collect;
mod columns;
mod error;
mod header;
mod note;
mod number;
mod scalar;
mod write;

pub use error::{Place, PlyError, Problem};
pub use note::Note;
pub use write::{Encoding, Precision, WriteError, WriteOptions, write};

use crate::geometry::{Cloud, Unit};
use crate::parallel::Watch;
use collect::Collector;
use columns::Columns;
use header::Header;

/// What a PLY file says about its points.
#[derive(Debug, Clone, PartialEq)]
pub struct PlyCloud {
    /// The points whose position is finite, in the file's order, unit and frame. A normal that is not
    /// finite is the zero vector ("none").
    pub cloud: Cloud,
    /// How many points were left out because x, y or z is infinite or no number.
    pub dropped_not_finite: usize,
    /// The unit that a `comment unit m` (or `cm`, `mm`) in the header states. This is our own
    /// convention: PLY has none.
    pub stated_unit: Option<Unit>,
    /// What was unusual about the file, each a short sentence when displayed.
    pub notes: Vec<Note>,
}

/// Reads a PLY file from its bytes: ASCII or binary of either byte order, any scalar type for any
/// property.
///
/// Positions in ASCII keep all the digits that stand in the file, even where the header says
/// `float`.
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
/// Where the bytes are no PLY file, its header is malformed or has no vertices with x, y and z, or
/// its body is malformed or ends before the last vertex.
pub fn read(bytes: &[u8]) -> Result<PlyCloud, PlyError> {
    read_watched(bytes, &())
}

/// As [`read`], telling `watch` how many of the file's rows of points are read, in any unit.
///
/// # Errors
/// As [`read`]; and [`Problem::Cancelled`] where the watch calls the work off, which it is asked
/// every few thousand rows.
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
