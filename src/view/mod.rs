//! A view of an analysis: colors and their legend, overlays, the primitives painted over the picture, and the one way
//! from settings to a scene ([`compose()`]), its page ([`Page`]) and a picture.
//!
//! All but pictures is plain data. A window and a picture without one show the same, since both are made here.

mod body;
mod caption;
mod coloring;
mod compose;
#[cfg(feature = "window")]
mod drawing;
mod layout;
mod legend;
mod overlays;
mod page;
mod palette;
mod pick;
#[cfg(feature = "reports")]
mod picture;
mod preset;
mod primitive;
mod scene;
mod select;
mod shown;
mod style;

pub use body::{BODY_AXIS_COLOR, BodyDrawing, BodyParts, Facet};
pub use caption::{caption, grouped, lead_in_words};
pub use coloring::{
    Colored, Coloring, ColoringError, Subject, color_bare, color_labels, color_points, round_step,
};
pub use compose::{Composition, PlaneView, SceneRequest, compose};
#[cfg(feature = "window")]
pub use drawing::{Drawing, DrawingError, DrawnCloud, draw_cloud, draw_page};
pub use layout::{insets, lay_out};
pub use legend::{Legend, Ramp, Swatch};
pub use overlays::{Overlay, Overlays};
pub use page::{Page, PageFacts};
pub use palette::{NEUTRAL, PEDUNCLE_MARK, VALUE_STOPS, faded, value_color};
pub use pick::pick_point;
#[cfg(feature = "reports")]
pub use picture::{
    PictureError, PictureSettings, SETTINGS_KEY, decode_picture, encode_picture, paint_primitives,
    picture_settings, text_width_px,
};
pub use preset::ViewPreset;
pub use primitive::{Anchor, Primitive, Theme};
pub use scene::{
    AXIS_COLOR, SceneSettings, build_bare_scene, build_scene, framed_cloud, framed_points, line_scale,
    reference_color,
};
pub use select::{Brush, Lasso, Region, Screen};
pub use shown::ShownPoints;
pub use style::Style;
