//! Messages in prose: sentences made of errors, texts that fit, and texts in tables.

use std::borrow::Cow;

/// Returns an error's text, which is a clause, as a sentence: with a capital letter and a full stop.
pub fn sentence(text: &str) -> String {
    let mut letters = text.chars();
    let first: String = letters
        .next()
        .map(|c| c.to_uppercase().collect())
        .unwrap_or_default();
    format!("{first}{}.", letters.as_str())
}

/// Returns a text as one line: control characters in it, line ends among them, as escapes.
pub(crate) fn one_line(text: &str) -> String {
    let escape = |c: char| {
        if c.is_control() {
            c.escape_default().collect()
        } else {
            String::from(c)
        }
    };
    text.chars().map(escape).collect()
}

/// The characters at the beginning of a field that make a spreadsheet take it for a formula, and the apostrophe that
/// makes it a text.
const FORMULA: [char; 7] = ['=', '+', '-', '@', '\t', '\r', '\''];

/// Returns a text as a field of a table that no spreadsheet takes for a formula: behind an apostrophe where it begins like
/// one.
pub fn spreadsheet_field(text: &str) -> Cow<'_, str> {
    if text.starts_with(FORMULA) {
        format!("'{text}").into()
    } else {
        text.into()
    }
}

/// Returns the text of a field of [`spreadsheet_field`].
pub fn from_spreadsheet_field(field: &str) -> &str {
    match field.strip_prefix('\'') {
        Some(text) if text.starts_with(FORMULA) => text,
        _ => field,
    }
}

/// The text if it fits, or else its longest beginning that fits with an ellipsis; `None` if not even that fits.
pub(crate) fn shortened(text: &str, fits: impl Fn(&str) -> bool) -> Option<String> {
    if fits(text) {
        return Some(text.to_owned());
    }
    let mut kept = text.to_owned();
    while kept.pop().is_some() {
        let candidate = format!("{}…", kept.trim_end());
        if fits(&candidate) {
            return Some(candidate);
        }
    }
    None
}
