//! Mutations of files: a few random changes to one of them.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// Words that programs trip over.
const WORDS: [&str; 22] = [
    "nan",
    "inf",
    "-inf",
    "1e308",
    "-1e308",
    "1e-320",
    "1e400",
    "-1",
    "0",
    "4294967296",
    "18446744073709551615",
    "99999999999999999999",
    "null",
    "\"\"",
    "[]",
    "{}",
    "end_header\n",
    "list uchar float",
    "property double x\n",
    "\u{0}",
    "\u{feff}",
    "\u{202e}",
];

/// Returns one of the files with one to eight changes.
pub fn mutated(files: &[Vec<u8>], random: &mut ChaCha8Rng) -> Vec<u8> {
    let mut bytes = files[random.random_range(0..files.len())].clone();
    // Headers and first lines are where most is decided.
    let near_start = random.random();
    for _ in 0..random.random_range(1..=8) {
        let end = if near_start {
            bytes.len().min(400)
        } else {
            bytes.len()
        };
        let at = random.random_range(0..=end);
        let length = random.random_range(0..=16.min(bytes.len() - at));
        match random.random_range(0..8) {
            0 if at < bytes.len() => bytes[at] ^= 1 << random.random_range(0..8),
            1 if at < bytes.len() => bytes[at] = random.random(),
            2 => drop(bytes.drain(at..at + length)),
            3 => bytes.truncate(at),
            4 => {
                let copy = bytes[at..at + length].to_vec();
                bytes.splice(at..at, copy);
            }
            5 => {
                let word = WORDS[random.random_range(0..WORDS.len())];
                bytes.splice(at..at + length.min(word.len()), word.bytes());
            }
            6 => {
                let other = &files[random.random_range(0..files.len())];
                let from = random.random_range(0..=other.len());
                let part = &other[from..(from + 40).min(other.len())];
                bytes.splice(at..at, part.iter().copied());
            }
            _ => replace_a_number(&mut bytes, random),
        }
    }
    bytes
}

/// Replaces a whole number or word in a text by one of [`WORDS`].
fn replace_a_number(bytes: &mut Vec<u8>, random: &mut ChaCha8Rng) {
    let is_number = |byte: &u8| byte.is_ascii_digit() || matches!(byte, b'.' | b'-' | b'e');
    let from = random.random_range(0..=bytes.len());
    let Some(start) = bytes[from..].iter().position(is_number) else {
        return;
    };
    let start = from + start;
    let length = bytes[start..].iter().take_while(|byte| is_number(byte)).count();
    let word = WORDS[random.random_range(0..WORDS.len())];
    bytes.splice(start..start + length, word.bytes());
}

/// Writes the right checksum behind every chunk of a PNG.
pub fn repair_png(bytes: &mut [u8]) {
    let mut at = 8;
    while let Some(length) = bytes.get(at..at + 4) {
        let length = u32::from_be_bytes(length.try_into().expect("four bytes")) as usize;
        let Some(end) = at.checked_add(8).and_then(|start| start.checked_add(length)) else {
            return;
        };
        if bytes.len() < end.saturating_add(4) {
            return;
        }
        let sum = crc32(&bytes[at + 4..end]);
        bytes[end..end + 4].copy_from_slice(&sum.to_be_bytes());
        at = end + 4;
    }
}

fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0, |sum, &byte| {
        (0..8).fold(sum ^ u32::from(byte), |sum, _| {
            (sum >> 1) ^ (0xedb8_8320 & (sum & 1).wrapping_neg())
        })
    })
}
