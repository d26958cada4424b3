//! The paper, a file a step.
//!
//! ```text
//! cloud ─▶ filters ─▶ normals ─▶ center ─▶ plane terms ─▶ scores ─▶ axis
//!                    (surface)             n, ΣD, ΣΞ     ╲─▶ detail of one plane
//! ```
//!
//! Every stage is a pure function of its inputs; [`analyze`] walks through all of them. Changing τ,
//! the aggregation or the partner fraction needs [`Ranking::new`] alone, on the same
//! [`PlaneTerms`]; changing u keeps the [`Surface`] and the center.

mod analysis;
mod axis;
mod candidates;
mod center;
mod detail;
mod error;
mod params;
mod partners;
mod score;
mod surface;
mod terms;
mod visibility;

pub use analysis::{
    Analysis, AnalysisError, BestPlane, Observe, Stage, UsedPoints, Warning, analyze, used_points,
};
pub use axis::{AxisError, AxisEstimate, AxisSource, symmetry_axis};
pub use candidates::{Candidate, CandidateGrid};
pub use center::{
    CenterError, CenterMethod, RandomSearch, distance_deviation, find_center, fit_sphere, rms_distance,
};
pub use detail::{Partner, PlaneDetail, PointDetail, Side, plane_detail};
pub use error::axis_error_rad;
pub use params::{Filters, NormalSource, OutlierFilter, ParamError, Params, Preset, TAU_CM_PER_RAD};
pub use score::{Aggregation, NoSymmetryPlane, Ranking};
pub use surface::{Surface, SurfaceError};
pub use terms::{PlaneTerm, PlaneTerms, plane_terms, terms_of_planes};
pub use visibility::{has_visible_partner, is_viewpoint_inside};
