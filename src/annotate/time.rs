//! Times as text (RFC 3339). Whoever edits passes the time in: there is no clock here.

/// A moment as text, in UTC and to the second: `2026-03-01T12:00:00Z`. `seconds` count from the start of
/// 1970.
pub fn rfc3339(seconds: u64) -> String {
    let (days, second) = (seconds / 86_400, seconds % 86_400);
    // Counted from 1 March of the year 0, so that a leap day ends its year. Then every 400 years are
    // alike, and the months' lengths repeat every five months, 153 days.
    let days = days + 719_468;
    let era = days / 146_097;
    let day_of_era = days % 146_097;
    let year_of_era = (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let march_month = (5 * day_of_year + 2) / 153;
    let day = day_of_year - (153 * march_month + 2) / 5 + 1;
    let month = if march_month < 10 {
        march_month + 3
    } else {
        march_month - 9
    };
    let year = era * 400 + year_of_era + u64::from(month <= 2);
    let (hour, minute, second) = (second / 3600, second / 60 % 60, second % 60);
    format!("{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}Z")
}

/// Whether a text has the shape of a time: `2026-03-01T12:00:00Z`, with a fraction or an offset if need be.
pub fn is_rfc3339(text: &str) -> bool {
    let bytes = text.as_bytes();
    let Some((start, rest)) = bytes.split_at_checked(19) else {
        return false;
    };
    let shape = |pattern: &[u8], text: &[u8]| {
        text.len() == pattern.len()
            && text.iter().zip(pattern).all(|(&byte, &wanted)| match wanted {
                b'0' => byte.is_ascii_digit(),
                b'+' => byte == b'+' || byte == b'-',
                _ => byte == wanted,
            })
    };
    if !shape(b"0000-00-00T00:00:00", start) {
        return false;
    }
    let zone = match rest.strip_prefix(b".") {
        None => rest,
        Some(fraction) => {
            let digits = fraction.iter().take_while(|b| b.is_ascii_digit()).count();
            if digits == 0 {
                return false;
            }
            &fraction[digits..]
        }
    };
    zone == b"Z" || shape(b"+00:00", zone)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_are_those_of_the_calendar() {
        // By another calendar's count (date -u -d @N).
        let cases = [
            (0, "1970-01-01T00:00:00Z"),
            (951_782_399, "2000-02-28T23:59:59Z"),
            (951_782_400, "2000-02-29T00:00:00Z"),
            (951_868_800, "2000-03-01T00:00:00Z"),
            (1_772_366_399, "2026-03-01T11:59:59Z"),
            (1_798_761_599, "2026-12-31T23:59:59Z"),
            (4_107_542_400, "2100-03-01T00:00:00Z"),
        ];
        for (seconds, text) in cases {
            assert_eq!(rfc3339(seconds), text);
            assert!(is_rfc3339(text));
        }
    }

    #[test]
    fn only_times_have_the_shape_of_a_time() {
        for time in ["2026-03-01T12:00:00.25Z", "2026-03-01T12:00:00-05:30"] {
            assert!(is_rfc3339(time), "{time}");
        }
        let others = [
            "",
            "yesterday",
            "2026-03-01",
            "2026-03-01T12:00:00",
            "2026-03-01 12:00:00Z",
            "2026-03-01T12:00:00.Z",
            "2026-03-01T12:00:00Z ",
            "2026-03-01T12:00:0éZ",
        ];
        for other in others {
            assert!(!is_rfc3339(other), "{other}");
        }
    }
}
