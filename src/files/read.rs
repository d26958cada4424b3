//! The reading of small files that may be anything: endless, a pipe, or far larger than they should be.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// Reads a file of at most `longest` bytes, which may be a pipe.
///
/// # Errors
/// Returns an error if the file is longer, or cannot be read.
pub fn read_at_most(path: &Path, longest: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    // One more than allowed tells a longer file from one that just fits.
    File::open(path)?
        .take(longest.saturating_add(1))
        .read_to_end(&mut bytes)?;
    if bytes.len() as u64 > longest {
        let limit = match longest {
            0..0x10_0000 => format!("{} kB", longest >> 10),
            _ => format!("{} MB", longest >> 20),
        };
        let message = format!("it is longer than {limit}, which no such file needs");
        return Err(io::Error::new(io::ErrorKind::FileTooLarge, message));
    }
    Ok(bytes)
}

/// Reads a regular file of at most `longest` bytes. Anything else is refused before it is opened, since opening a pipe
/// waits for another program to write to it.
///
/// # Errors
/// Returns an error if the file is longer, is not a regular file, or cannot be read.
pub fn read_regular(path: &Path, longest: u64) -> io::Result<Vec<u8>> {
    if std::fs::metadata(path)?.is_file() {
        read_at_most(path, longest)
    } else {
        Err(io::Error::other("it is not a regular file"))
    }
}
