//! Bytes to clouds and back.

pub mod figures;
