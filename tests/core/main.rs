//! The library without window, command line or charts.

#[path = "../helpers/mod.rs"]
mod helpers;

mod annotating;
mod annotating_format;
mod calling_off;
mod geometry;
mod method_choices;
mod method_error_parts;
mod method_reference;
mod method_stages;
mod method_terms;
mod peduncle;
mod reading;
mod reading_layout;
mod reading_malformed;
mod reading_oracle;
mod reading_properties;
mod reading_units;
mod reading_watched;
mod sampling;
mod simulating;
mod strays;
mod view;
