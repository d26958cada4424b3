//! The errors of a simulation, and the checks of its settings.

use glam::DVec3;

/// Why a cloud could not be simulated.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum SimulateError {
    /// A setting is not a number or out of range.
    #[error("{name} is {value}; it must be {allowed}")]
    Setting {
        /// The name of the setting's field.
        name: &'static str,
        /// Its value.
        value: f64,
        /// The allowed values, in words.
        allowed: &'static str,
    },
    /// The viewpoint is inside the fruit or on it, where no point of the surface faces it.
    #[error("the viewpoint is inside the fruit: move its center farther away or make it smaller")]
    ViewpointInside,
    /// The ellipsoid shows the camera too little of itself to place the wanted points.
    #[error("only {found} of {wanted} points were found on the side that faces the viewpoint")]
    TooLittleVisible {
        /// Points found before the search was given up.
        found: usize,
        /// Points asked for.
        wanted: usize,
    },
    /// The camera stands at the point that it looks at.
    #[error("the camera stands at the point that it looks at")]
    LooksAtItself,
    /// A mesh does not fit between the camera's nearest and farthest depth.
    #[error(
        "the mesh is {size_cm:.1} cm across, and the camera sees from {near_cm} to {far_cm} cm only: is the mesh's unit right?"
    )]
    MeshTooLarge {
        /// The diameter of a ball around the mesh.
        size_cm: f64,
        /// The camera's nearest depth.
        near_cm: f64,
        /// Its farthest.
        far_cm: f64,
    },
    /// No point of the fruit was seen: it is outside the image or the camera's range, or hidden.
    #[error(
        "the camera sees no point of the fruit: it is outside the image or the camera's range, or hidden"
    )]
    NothingVisible,
}

/// Returns an error for a value outside `low..=high`, NaN included.
pub(super) fn within(
    name: &'static str,
    value: f64,
    (low, high): (f64, f64),
    allowed: &'static str,
) -> Result<(), SimulateError> {
    if (low..=high).contains(&value) {
        Ok(())
    } else {
        Err(SimulateError::Setting { name, value, allowed })
    }
}

/// Returns an error for a vector with a component outside `low..=high`, NaN included.
pub(super) fn each_within(
    name: &'static str,
    value: DVec3,
    range: (f64, f64),
    allowed: &'static str,
) -> Result<(), SimulateError> {
    value
        .to_array()
        .into_iter()
        .try_for_each(|component| within(name, component, range, allowed))
}
