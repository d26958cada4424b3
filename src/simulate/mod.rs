//! Clouds whose axis is known: the paper's ellipsoid, a pepper, fruits of other kinds, and the depth camera that
//! looks at them.
//!
//! A pure room: settings go in, a [`Simulated`] comes out, and the same settings always give the
//! same points to the bit. Everything is made in centimeters in the camera's frame (x right, y down,
//! z ahead; the viewpoint `p_v` is the origin) and can be rescaled afterwards.
//!
//! ```
//! use axiscope::simulate::PepperSettings;
//! let pepper = PepperSettings { seed: 7, ..PepperSettings::default() }.simulate()?;
//! assert!(pepper.cloud.len() > 1000);
//! assert!(pepper.truth.axis.direction.y < 0.0, "the stem end is up in the image");
//! # Ok::<(), axiscope::simulate::SimulateError>(())
//! ```

mod depth_camera;
mod ellipsoid;
mod error;
mod fruit;
mod mesh;
mod pepper;
mod random;
mod scene;
mod shape;
mod truth;

pub use depth_camera::DepthCamera;
pub use ellipsoid::EllipsoidSettings;
pub use error::SimulateError;
pub use fruit::{FruitKind, FruitSettings};
pub use pepper::PepperSettings;
pub use random::seeds;
pub use scene::Scene;
pub use shape::FruitColor;
pub use truth::{Pose, Settings, Simulated, TrueAxis, Truth};
