//! The parser of numbers in ASCII files.
//!
//! Words of few digits, which nearly all are, take a short path of their own: a million rows of three such words take two
//! thirds of the time that `fast-float2` takes. All others go to the standard library.

/// 10⁰ to 10²², the powers of ten that an `f64` holds exactly.
const POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18,
    1e19, 1e20, 1e21, 1e22,
];

/// Whether a byte separates words.
#[inline]
pub(super) fn is_space(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\n' | b'\r' | 0x0b | 0x0c)
}

/// The number at the start of `bytes` and the length of its word, which ends at white space or with the bytes. `None` if
/// the word is no number.
#[inline]
pub(super) fn number(bytes: &[u8]) -> Option<(f64, usize)> {
    common(bytes).or_else(|| unusual(bytes))
}

/// Parses numbers of few digits with a modest exponent. The result is correctly rounded: digits and power of ten are exact
/// as `f64`, so that their product or quotient is rounded only once.
#[inline]
fn common(bytes: &[u8]) -> Option<(f64, usize)> {
    let mut at = usize::from(matches!(bytes.first(), Some(b'-' | b'+')));
    let mut digits: u64 = 0;
    let start = at;
    while let Some(digit) = digit(bytes, at) {
        digits = digits.wrapping_mul(10).wrapping_add(digit);
        at += 1;
    }
    let mut count = at - start;
    let mut exponent: i32 = 0;
    if bytes.get(at) == Some(&b'.') {
        at += 1;
        let point = at;
        while let Some(digit) = digit(bytes, at) {
            digits = digits.wrapping_mul(10).wrapping_add(digit);
            at += 1;
        }
        count += at - point;
        exponent = -i32::try_from(at - point).ok()?;
    }
    // With more than 19 digits the product may have wrapped around.
    if !(1..=19).contains(&count) || digits > 1 << 53 {
        return None;
    }
    if let Some(b'e' | b'E') = bytes.get(at) {
        at += 1;
        let negative = bytes.get(at) == Some(&b'-');
        at += usize::from(matches!(bytes.get(at), Some(b'-' | b'+')));
        let first = at;
        let mut written: i32 = 0;
        while let Some(digit) = digit(bytes, at) {
            written = written * 10 + digit as i32;
            at += 1;
            if at - first > 4 {
                return None;
            }
        }
        if at == first {
            return None;
        }
        exponent += if negative { -written } else { written };
    }
    if bytes.get(at).is_some_and(|&byte| !is_space(byte)) {
        return None;
    }
    let power = *POWERS.get(exponent.unsigned_abs() as usize)?;
    let size = if exponent < 0 {
        digits as f64 / power
    } else {
        digits as f64 * power
    };
    Some((if bytes.first() == Some(&b'-') { -size } else { size }, at))
}

#[inline]
fn digit(bytes: &[u8], at: usize) -> Option<u64> {
    let value = bytes.get(at)?.wrapping_sub(b'0');
    (value < 10).then_some(u64::from(value))
}

/// Parses all other numbers that the standard library knows (many digits; `nan` and `inf` in any case), and the spellings
/// of C libraries for values that are not finite.
#[cold]
fn unusual(bytes: &[u8]) -> Option<(f64, usize)> {
    let word = word(bytes);
    let text = std::str::from_utf8(word).ok()?;
    let value = text.parse().ok().or_else(|| not_finite(text))?;
    Some((value, word.len()))
}

/// The word at the start of `bytes`.
pub(super) fn word(bytes: &[u8]) -> &[u8] {
    bytes.split(|&byte| is_space(byte)).next().unwrap_or(bytes)
}

fn not_finite(text: &str) -> Option<f64> {
    let text = text.to_ascii_lowercase();
    let text = text.trim_start_matches(['-', '+']);
    if text.starts_with("nan(") && text.ends_with(')') {
        return Some(f64::NAN);
    }
    // Visual C++ before 2015 prints `1.#INF`, `1.#QNAN`, `-1.#IND` or `1.#R`, zeros following.
    text.starts_with("1.#").then_some(f64::NAN)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::number;

    fn parsed(text: &str) -> Option<f64> {
        number(text.as_bytes()).map(|(value, taken)| {
            assert_eq!(taken, text.len(), "{text}");
            value
        })
    }

    #[test]
    fn what_files_in_the_wild_call_a_number_is_one() {
        let cases = [
            ("0", 0.0),
            ("-0", -0.0),
            ("+1", 1.0),
            (".5", 0.5),
            ("1.", 1.0),
            ("-.25", -0.25),
            ("1E-3", 1e-3),
            ("1e+003", 1e3),
            ("12345678901234567890123", 12_345_678_901_234_567_890_123.0),
            // 2⁶⁴ + 1, which is 1 to those who count in 64 bits.
            ("18446744073709551617", 18_446_744_073_709_551_617.0),
            ("1e-320", 1e-320),
            ("1e22", 1e22),
            ("-inf", f64::NEG_INFINITY),
            ("Infinity", f64::INFINITY),
        ];
        for (text, expected) in cases {
            assert_eq!(
                parsed(text).map(f64::to_bits),
                Some(f64::to_bits(expected)),
                "{text}"
            );
        }
        for text in [
            "nan",
            "NaN",
            "-nan",
            "-nan(ind)",
            "nan(0x8000)",
            "1.#QNAN",
            "-1.#IND00",
            "1.#INF",
        ] {
            assert!(parsed(text).is_some_and(|value| !value.is_finite()), "{text}");
        }
    }

    #[test]
    fn what_is_no_number_is_refused() {
        let words = [
            "", ".", "-", "+-1", "1,5", "e5", "1e", "1e+", "1.2.3", "0x10", "1_000", "five", "1f", "1;",
            "--1", "١",
        ];
        for text in words {
            assert_eq!(number(text.as_bytes()), None, "{text}");
        }
    }

    #[test]
    fn a_number_ends_at_white_space() {
        for space in [" ", "\t", "\n", "\r\n"] {
            assert_eq!(number(format!("1.5{space}2").as_bytes()), Some((1.5, 3)));
            assert_eq!(
                number(format!("nan{space}2").as_bytes()).map(|(_, taken)| taken),
                Some(3)
            );
        }
    }

    proptest! {
        #[test]
        fn numbers_are_rounded_as_the_standard_library_does(
            digits in "[-+]?[0-9]{0,21}\\.?[0-9]{0,21}",
            exponent in proptest::option::of(-330i32..330),
        ) {
            let text = exponent.map_or(digits.clone(), |exponent| format!("{digits}e{exponent}"));
            prop_assert_eq!(parsed(&text).map(f64::to_bits), text.parse().ok().map(f64::to_bits), "{}", text);
        }

        #[test]
        fn every_number_is_read_as_it_was_written(value: f64) {
            prop_assume!(value.is_finite());
            for text in [format!("{value}"), format!("{value:e}"), format!("{value:?}")] {
                prop_assert_eq!(parsed(&text).map(f64::to_bits), Some(value.to_bits()), "{}", text);
            }
        }
    }
}
