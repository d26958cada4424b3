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

/// The words of a line, parted and quoted as in a POSIX shell. What follows a `#` that begins a word is a comment.
fn words(line: &str) -> Result<Vec<String>, &'static str> {
    // A carriage return of a file from Windows is no part of the last word.
    let line = line.trim_end_matches(['\r', '\n']);
    shlex::split(line).ok_or("a quote is not closed, or a backslash ends the line")
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
            ("a#b\r\n", &["a#b"]),
            ("", &[]),
        ];
        for (line, expected) in cases {
            assert_eq!(words(line).expect(line), expected, "{line}");
        }
        assert!(words("\"open").is_err() && words("open\\").is_err());
    }
}
