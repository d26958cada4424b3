//! The symmetry axis (Eq. 16), and axes from other sources.

use std::borrow::Cow;

use glam::DVec3;

/// Why Eq. 16 gives no axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum AxisError {
    /// The cross product of Eq. 16 vanishes.
    #[error("the axis is undefined: the plane's normal is parallel to the line of sight (Eq. 16)")]
    NormalAlongViewRay,
    /// The viewpoint is the center, so that there is no line of sight.
    #[error("the axis is undefined: the viewpoint is the fruit center")]
    ViewpointAtCenter,
}

/// The sine of the angle between normal and view ray, about 2·10⁻⁷ degrees, below which the direction of
/// the cross product is nothing but rounding.
const PARALLEL_SINE: f64 = 4e-9;

/// Computes the unit direction γ of the symmetry axis, which starts from the fruit center (Eq. 16, then
/// normalized). `plane_normal` has unit length; `center` and `viewpoint` share a frame and unit.
///
/// γ is perpendicular to the view ray, so the axis of a fruit that leans towards the camera by δ is
/// missed by at least δ.
///
/// # Errors
/// Returns an error if the normal is parallel to the view ray, or the viewpoint is the center.
pub fn symmetry_axis(plane_normal: DVec3, center: DVec3, viewpoint: DVec3) -> Result<DVec3, AxisError> {
    let toward_viewpoint = (viewpoint - center)
        .try_normalize()
        .ok_or(AxisError::ViewpointAtCenter)?;
    let gamma = plane_normal.cross(toward_viewpoint);
    let length = gamma.length();
    if length < PARALLEL_SINE {
        return Err(AxisError::NormalAlongViewRay);
    }
    Ok(gamma / length)
}

/// The source of an axis.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum AxisSource {
    /// Eq. 16, from the symmetry plane.
    SymmetryPlane,
    /// A plane or a body fitted to the points, by the estimator of this name.
    Fitted(&'static str),
    /// § 3.2: from the fruit center through the mean of the peduncle's points.
    Peduncle,
    /// The line along which the peduncle's points are spread most.
    PeduncleDirection,
    /// The simulator that made the cloud.
    Simulation,
    /// One annotator, by hand.
    Annotator(String),
    /// The mean of the axes of several annotators, with their number.
    Annotators(usize),
    /// The adjudicator between the annotators.
    Adjudicated,
}

impl AxisSource {
    /// The name that reports use: `annotator:NAME` for one annotator, `annotators:3` for the mean of three.
    pub fn name(&self) -> Cow<'static, str> {
        match self {
            Self::SymmetryPlane => "symmetry-plane".into(),
            Self::Fitted(estimator) => (*estimator).into(),
            Self::Peduncle => "peduncle".into(),
            Self::PeduncleDirection => "peduncle-direction".into(),
            Self::Simulation => "simulation".into(),
            Self::Annotator(name) => format!("annotator:{name}").into(),
            Self::Annotators(count) => format!("annotators:{count}").into(),
            Self::Adjudicated => "adjudicated".into(),
        }
    }

    /// The axis in words, as texts for readers have it: “the simulated axis”, “Ada's axis”.
    pub fn in_words(&self) -> Cow<'static, str> {
        match self {
            Self::SymmetryPlane => "the symmetry plane's axis".into(),
            Self::Fitted(estimator) => format!("the axis by {estimator}").into(),
            Self::Peduncle => "the peduncle's axis".into(),
            Self::PeduncleDirection => "the peduncle's own direction".into(),
            Self::Simulation => "the simulated axis".into(),
            Self::Annotator(name) => format!("{name}'s axis").into(),
            Self::Annotators(1) => "the annotator's axis".into(),
            Self::Annotators(_) => "the annotators' mean".into(),
            Self::Adjudicated => "the adjudicated axis".into(),
        }
    }
}

/// One estimate of a fruit's axis among several.
#[derive(Debug, Clone, PartialEq)]
pub struct AxisEstimate {
    /// Its source.
    pub source: AxisSource,
    /// A point on it, mostly the fruit center, in the file's unit and frame.
    pub origin: DVec3,
    /// Its unit direction.
    pub direction: DVec3,
    /// The confidence that its source states, 0 to 1; `None` if it states none.
    pub confidence: Option<f64>,
}
