//! Bytes to clouds and back.
