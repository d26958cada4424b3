//! Feeds the PLY reader whatever the fuzzer comes up with: `cargo +nightly fuzz run read_ply`.

#![no_main]

use axiscope::ply::{Encoding, Precision, WriteOptions, read, write};

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    match read(bytes) {
        Ok(first) => {
            assert!(
                first
                    .notes
                    .iter()
                    .all(|note| note.to_string().lines().count() == 1)
            );
            // What was read can be written, and comes back as it was.
            for encoding in Encoding::ALL {
                let options = WriteOptions {
                    encoding,
                    precision: Precision::Double,
                    ..WriteOptions::default()
                };
                let mut written = Vec::new();
                write(&mut written, &first.cloud, &options).expect("memory takes everything");
                let second = read(&written).expect("our own files are well-formed");
                assert_eq!(second.cloud, first.cloud);
            }
        }
        Err(error) => assert_eq!(error.to_string().lines().count(), 1),
    }
});
