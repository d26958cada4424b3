//! Axes to and from other programs: a table, and 3D Slicer's markup lines. Bytes in, bytes out.

mod slicer;
#[cfg(feature = "reports")]
mod table;

pub use slicer::{Placement, SlicerError, SlicerFrame, SlicerLine, place, read_lines, write_line};
#[cfg(feature = "reports")]
pub use table::{ImportedRow, TableError, read_table, write_table};
