//! Edits by the line: each line holds what would stand on the command line.

use clap::{Args, Command, FromArgMatches};

use super::change::Change;

/// The edit in a line; `None` where the line is empty or a comment.
///
/// # Errors
/// One line that says what is wrong.
pub(super) fn change_of(line: &str) -> Result<Option<Change>, String> {
    let words = words(line)?;
    if words.is_empty() {
        return Ok(None);
    }
    let command = Change::augment_args(Command::new("edit").no_binary_name(true).disable_help_flag(true));
    let one_line = |error: clap::Error| {
        let text = error.render().to_string();
        let first = text.lines().next().unwrap_or_default();
        first.trim_start_matches("error: ").to_owned()
    };
    let matches = command.try_get_matches_from(words).map_err(one_line)?;
    Change::from_arg_matches(&matches).map(Some).map_err(one_line)
}

/// The words of a line: white space parts them, but not within quotes; a backslash takes the next
/// character as it is. What follows a `#` that begins a word is a comment.
fn words(line: &str) -> Result<Vec<String>, String> {
    let mut words = Vec::new();
    let mut word: Option<String> = None;
    let mut quote = None;
    let mut letters = line.chars();
    while let Some(c) = letters.next() {
        match (quote, c) {
            (_, '\\') => {
                let next = letters.next().ok_or("a backslash ends the line")?;
                word.get_or_insert_default().push(next);
            }
            (Some(open), c) if c == open => quote = None,
            (None, '"' | '\'') => {
                quote = Some(c);
                word.get_or_insert_default();
            }
            (None, c) if c.is_whitespace() => words.extend(word.take()),
            (None, '#') if word.is_none() => break,
            (_, c) => word.get_or_insert_default().push(c),
        }
    }
    if quote.is_some() {
        return Err("a quote is not closed".into());
    }
    words.extend(word);
    Ok(words)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_parted_as_a_shell_would() {
        let cases: [(&str, &[&str]); 6] = [
            ("  a  b\t", &["a", "b"]),
            ("--note \"two words\" x", &["--note", "two words", "x"]),
            (r#"'it''s' \"q\" a\ b"#, &["its", "\"q\"", "a b"]),
            ("\"\" # a comment", &[""]),
            ("a#b", &["a#b"]),
            ("", &[]),
        ];
        for (line, expected) in cases {
            assert_eq!(words(line).expect(line), expected, "{line}");
        }
        assert!(words("\"open").is_err() && words("open\\").is_err());
    }
}
