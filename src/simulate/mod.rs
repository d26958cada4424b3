//! Clouds whose axis is known: the paper's ellipsoid, a pepper, and the depth camera that looks at them, from one place or
//! from several.
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

mod coverage;
mod depth_camera;
mod ellipsoid;
mod error;
mod mesh;
mod mesh_scan;
mod pepper;
mod random;
mod scan;
mod seen_points;
mod trajectory;
mod triangle_mesh;
mod truth;
mod views;

pub use depth_camera::DepthCamera;
pub use ellipsoid::EllipsoidSettings;
pub use error::SimulateError;
pub use mesh_scan::{MeshScanSettings, ScannedMesh};
pub use pepper::{FruitColor, PepperSettings};
pub use random::seeds;
pub use seen_points::seen_points;
pub use trajectory::{TrajectoryError, parse_trajectory};
pub use triangle_mesh::{MeshError, TriangleMesh};
pub use truth::{Pose, Settings, Simulated, TrueAxis, Truth};
pub use views::{CameraPose, ScanSettings};
