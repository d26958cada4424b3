//! Feeds one target whatever the fuzzer comes up with: `cargo +nightly fuzz run axis_file`.

#![no_main]

#[path = "../../tests/campaign/targets.rs"]
mod targets;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| targets::axis_file(bytes));
