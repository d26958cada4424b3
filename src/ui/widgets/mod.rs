//! The parts that panels share.

pub(super) mod arrows;
pub(super) mod color_scale;
pub(super) mod controls;
pub(super) mod error_parts;
pub(super) mod marks;
pub(super) mod memo;
pub(super) mod notice;
pub(super) mod plane_tip;
pub(super) mod plot;
pub(super) mod progress;
pub(super) mod reference;
pub(super) mod rows;
