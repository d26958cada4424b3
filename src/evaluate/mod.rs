//! Evaluation of one cloud, with its report, or of many: a row for each, and tables, figures and a page about all
//! of them.
//!
//! [`examine`] analyzes a cloud and compares it with its reference axes; an [`Outcome`] holds the comparison, and
//! a [`Row`] the part of it that belongs to one reference. A [`Runner`] does that for cloud after cloud, and keeps
//! the rows in a [`RowStore`]. A cloud that cannot be read or analyzed has a row with the reason. Rows hold no
//! times: a resumed run, a run in shards and an unbroken run give the same bytes.

mod checksummed_lines;
mod error_breakdown;
mod estimates;
mod examine;
mod file_hashes;
mod outcome;
#[cfg(feature = "window")]
mod pictures;
mod point_report;
mod point_rows;
#[cfg(feature = "reports")]
mod point_table;
mod report;
#[cfg(feature = "reports")]
pub mod reproduce;
#[cfg(feature = "reports")]
mod results;
mod row;
mod row_store;
mod runner;
mod start;
mod summary;
mod sweep;
#[cfg(feature = "reports")]
mod table;
mod tags;
#[cfg(feature = "window")]
mod thumbnails;

pub use error_breakdown::{ErrorBreakdown, GivenCenter, NearestPlane};
pub use estimates::{EstimateInRow, estimates_of, surface_of, surface_of_fruit};
pub use examine::{
    Examination, TruthChoice, collect_references, examine, examine_file, peduncle_disagreement_deg,
    reference_of,
};
pub use file_hashes::KnownHash;
pub use outcome::{KnownAxis, Outcome};
#[cfg(feature = "window")]
pub use pictures::pictures_of_worst;
pub use point_rows::{PointRow, point_rows};
#[cfg(feature = "reports")]
pub use point_table::{PointTableError, PointsFormat, point_table};
pub use report::{AnalysisReport, SCHEMA, TimedEstimate, Timings};
#[cfg(feature = "reports")]
pub use results::{ResultsError, WorstPicture, csv, parquet, result_files, worst_first};
pub use row::Row;
pub use row_store::{RowStore, StoreKind, StoreProblem, StoredRow};
pub use runner::{EvaluateError, EvaluatedCloud, Reuse, Runner, annotation_files, evaluate_file};
pub use start::{StartError, start_axis};
pub use summary::{MeanGivenCenter, MeanParts, Summary};
pub use sweep::{Sweep, SweepSettings, sweep_cloud};
#[cfg(feature = "reports")]
pub use table::TableError;
pub use tags::{CloudTags, TAGS_FILE, add_tags, read_tags, write_tags};
#[cfg(feature = "window")]
pub use thumbnails::{THUMBNAIL_PX, ThumbnailFile, ThumbnailRenderer, ThumbnailSettings};
