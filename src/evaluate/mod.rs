//! Clouds examined: one in full, with its report, or many, one row a cloud, and what the rows say
//! together.
//!
//! A cloud that cannot be read or analyzed is a row with its reason. Rows hold no times, so that a
//! resumed run, a run in shards and an unbroken run give the same bytes.

mod examine;
mod outcome;
mod report;
pub mod reproduce;
mod results;
mod row;
mod start;
mod summary;
mod sweep;
mod table;

pub use examine::{Examined, TruthChoice, compared, examine, peduncle_disagreement_deg, reference_of};
pub use outcome::{KnownAxis, Outcome};
pub use report::{AnalysisReport, SCHEMA, Timings};
pub use results::{ResultsError, WorstPicture, result_files, worst_first};
pub use row::Row;
pub use start::{StartError, start_axis};
pub use summary::Summary;
pub use sweep::{Sweep, SweepSettings, sweep_cloud};
pub use table::{TableError, csv, parquet};
