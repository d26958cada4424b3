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
mod listing;
mod slots;
mod store;

pub use agreement::{
    AnnotatorSummary, CloudAgreement, FAR_OFF_DEG, MeanAxis, Pair, PairSummary, SetAgreement, estimates,
    mean_axis,
};
pub use annotation::{Annotation, CloudId, Confidence, Finding, Judgment, Method};
pub use author::{Author, NameError, Role, axis_file_of};
pub use disk::DiskFiles;
pub use ends::{Ends, EndsError, NUDGES_DEG, Pivot};
pub use file::{FileError, LONGEST_FILE, now};
pub use files::{Files, Notice, StoreError};
pub use journal::{Deed, Journal, JournalError, deed_line, head_line, read_journal};
pub use listing::{annotation_paths, read_annotations};
pub use store::Store;
