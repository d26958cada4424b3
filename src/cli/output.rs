//! The program's output beside its answer on standard output: notices on standard error, and files.

use std::borrow::Cow;
use std::io::Write;
use std::path::Path;

/// Prints a line on standard error. If that is closed or full there is nobody to tell, and the work goes on.
macro_rules! say {
    ($($text:tt)*) => {
        $crate::cli::output::say_line(format_args!($($text)*))
    };
}
pub(super) use say;

/// Prints a line on standard error, where that is possible; see [`say!`].
pub(super) fn say_line(line: std::fmt::Arguments<'_>) {
    let _ = writeln!(std::io::stderr(), "{}", printable(&line.to_string()));
}

/// Whether a path stands for standard output.
pub(super) fn is_standard_output(path: &Path) -> bool {
    path == Path::new("-")
}

/// Writes a file, whole or not at all; `-` is standard output.
pub(super) fn write(path: &Path, bytes: &[u8]) -> anyhow::Result<()> {
    if !is_standard_output(path) {
        return Ok(axiscope::files::write_whole(path, bytes)?);
    }
    let mut out = std::io::stdout().lock();
    out.write_all(bytes)?;
    Ok(out.flush()?)
}

/// Text for a terminal: control characters in it, which could move the cursor or hide what stands there, are written as
/// escapes. Line ends and tabs pass.
pub(super) struct Printable<W>(W);

impl Printable<std::io::StdoutLock<'static>> {
    /// Standard output.
    pub(super) fn stdout() -> Self {
        Self(std::io::stdout().lock())
    }
}

impl<W> Printable<W> {
    pub(super) fn new(out: W) -> Self {
        Self(out)
    }
}

impl<W: Write> Write for Printable<W> {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        match std::str::from_utf8(bytes) {
            Ok(text) => self.0.write_all(printable(text).as_bytes())?,
            Err(_) => self.0.write_all(&bytes.escape_ascii().collect::<Vec<u8>>())?,
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.0.flush()
    }
}

/// Returns the text with its control characters, but for line ends and tabs, as escapes.
fn printable(text: &str) -> Cow<'_, str> {
    let is_hidden = |c: char| c.is_control() && !matches!(c, '\n' | '\t');
    if !text.contains(is_hidden) {
        return text.into();
    }
    let mut shown = String::with_capacity(text.len() + 8);
    for c in text.chars() {
        if is_hidden(c) {
            shown.extend(c.escape_unicode());
        } else {
            shown.push(c);
        }
    }
    shown.into()
}
