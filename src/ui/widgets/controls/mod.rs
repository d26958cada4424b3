//! The controls that panels of settings and lists are made of.

mod buttons;
mod coordinates;
mod fields;
mod request_edit;
mod section;
mod text;

pub use buttons::{button, checkbox, toggle};
pub use coordinates::{Coordinates, coordinates, decimals};
pub use fields::{Choice, Number, SliderRow, choice_row, count};
pub use request_edit::Edit;
pub use section::{row, section};
pub use text::{caution, hint, small, text_field, warning_color};
