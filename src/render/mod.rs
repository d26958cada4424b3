//! A point renderer: a camera, a scene of points, lines and planes as plain data, and their picture.
//!
//! It depends on [`crate::geometry`] and on nothing else in this crate. [`Camera`] and [`Scene`] need no GPU and are always
//! built; the drawing itself needs the feature `window`.

mod camera;
#[cfg(feature = "window")]
mod canvas;
mod framing;
#[cfg(feature = "window")]
mod gpu;
mod image;
#[cfg(feature = "window")]
mod offscreen;
#[cfg(feature = "window")]
mod pipelines;
mod scene;
#[cfg(feature = "window")]
mod uploads;

pub use camera::{Camera, Projection, Ray, Viewport};
#[cfg(feature = "window")]
pub use canvas::{Canvas, Extract};
pub use framing::Insets;
#[cfg(feature = "window")]
pub use gpu::{Gpu, GpuError};
pub use image::{Image, MAX_SIDE_PX};
#[cfg(feature = "window")]
pub use offscreen::{DrawError, draw_extract, draw_image};
#[cfg(feature = "window")]
pub use pipelines::{Renderer, SHADERS};
pub use scene::{Background, Bounds, Color, Dash, EyeDome, Line, Points, Polygon, Scene};
