//! The method of the paper, a file for each step.
//!
//! ```text
//! cloud ─▶ filters ─▶ normals ─▶ center ─▶ plane terms ─▶ scores ─▶ axis
//!                    (surface)             n, ΣD, ΣΞ     ╲─▶ detail of one plane
//! ```
//!
//! Every stage is a pure function of its inputs. [`analyze`] runs all of them once; [`Stages`] keeps
//! their results, so that the next analysis of the cloud runs only the stages whose inputs have changed.

mod analysis;
mod axis;
mod candidates;
mod center;
mod detail;
mod error;
mod error_parts;
mod params;
mod partners;
mod point_steps;
mod score;
mod stages;
mod surface;
mod terms;
mod used_points;
mod visibility;
mod warning;

pub use analysis::{Analysis, AnalysisError, BestPlane};
pub use axis::{AxisError, AxisEstimate, AxisSource, symmetry_axis};
pub use candidates::{Candidate, CandidateGrid};
pub use center::{
    CenterError, CenterMethod, RandomSearch, distance_deviation, find_center, fit_sphere, rms_distance,
};
pub use detail::{Partner, PlaneDetail, PointDetail, Side, plane_detail};
pub use error::axis_error_rad;
pub use error_parts::{CandidateAxes, ErrorParts, NearestCandidate, lean_rad};
pub use params::{Filters, NormalSource, OutlierFilter, ParamError, Params, Preset, TAU_CM_PER_RAD};
pub use point_steps::{PartnerSteps, PointSteps};
pub use score::{Aggregation, NoSymmetryPlane, Ranking};
pub use stages::{Observe, Stage, Stages, analyze};
pub use surface::{Surface, SurfaceError};
pub use terms::{PlaneTerm, PlaneTerms, plane_terms, terms_of_planes};
pub use visibility::{has_visible_partner, is_viewpoint_inside};
pub use warning::Warning;
