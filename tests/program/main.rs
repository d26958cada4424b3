//! The program as a user runs it, and the charts that it writes.

#[path = "../helpers/mod.rs"]
mod helpers;

mod agreeing;
mod annotating_killed;
mod command_line;
mod command_line_other;
mod estimating;
mod evaluating;
mod evaluating_parts;
mod evaluating_peduncle;
mod exchanging;
mod extreme_numbers;
mod figures;
mod hostile_input;
mod points;
mod scanning;
mod writing;
