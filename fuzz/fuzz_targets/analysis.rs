//! Feeds one target whatever the fuzzer comes up with: `cargo +nightly fuzz run analysis`.

#![no_main]

#[path = "../../tests/campaign/targets.rs"]
mod targets;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| targets::analysis(bytes));
