//! The program behind the window, without one.

#[path = "../helpers/mod.rs"]
mod helpers;

mod damaged_sessions;
mod estimators;
mod inspector;
mod many;
mod many_tags;
mod peduncle;
mod scan_from_here;
mod simulator;
mod true_axes;
mod why;
mod workers;
