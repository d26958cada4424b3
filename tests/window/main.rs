//! The window, its panels and the pictures that a GPU draws.

#[path = "../helpers/mod.rs"]
mod helpers;

mod estimators;
mod inspector;
mod keys;
mod many;
mod panels_planes;
mod panels_settings;
mod peduncle;
mod real_window;
mod rendering;
mod simulator;
mod true_axes;
mod whole_scan;
