//! True axes by hand: what annotators say of a cloud's axis, kept safely, compared and exchanged.
//!
//! There are no clocks here and no disks: times are passed in, and a [`Store`] writes through [`Files`].

mod agreement;
mod annotation;
mod author;
mod disk;
mod ends;
pub mod exchange;
mod file;
mod files;
mod journal;
mod own_files;
mod store;

pub use agreement::{
    AnnotatorSummary, CloudAgreement, FAR_OFF_DEG, MeanAxis, Pair, PairSummary, SetAgreement, estimates,
    mean_axis,
};
pub use annotation::{Annotation, CloudId, Confidence, Judgment, Method};
pub use author::{AXIS_ENDING, Author, NameError, Role, axis_file_of};
pub use disk::{DiskFiles, read_annotation};
pub use ends::{Ends, EndsError, NUDGES_DEG, Pivot};
pub use file::{FileError, LONGEST_FILE, now};
pub use files::{Files, Notice, StoreError};
pub use journal::{Journal, JournalError, Operation, head_line, operation_line, read_journal};
pub use store::Store;
