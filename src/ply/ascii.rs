//! The body of an ASCII PLY file.
//!
//! A row takes one line. Some programs wrap rows over several lines; a file whose lines do not fit is therefore read
//! again word by word, and accepted if its words come out even.

use super::Note;
use super::collect::{BLOCK, Collector};
use super::columns::{Columns, Role};
use super::error::{PlyError, Problem, quoted};
use super::header::{Element, Header, Kind, line_of};
use super::number::{is_space, number, word};

/// Reads the vertices into the collector and steps over everything else.
pub(super) fn read(
    bytes: &[u8],
    header: &Header,
    vertex: &Element,
    columns: &Columns,
    collector: &mut Collector<'_>,
    notes: &mut Vec<Note>,
) -> Result<(), PlyError> {
    let body = Body { bytes };
    match body.lines(header, vertex, columns, collector) {
        Ok(at) => {
            body.note_the_rest(at, header, vertex, notes);
            Ok(())
        }
        Err(error) => {
            // Where rows have lists, wrapped lines and a wrong count look alike.
            if !matches!(error.problem, Problem::RowLength { at_least: false, .. }) {
                return Err(error);
            }
            *collector = collector.afresh(columns);
            match body.comes_out_even(header, vertex, columns, collector) {
                Ok(true) => {}
                Ok(false) => return Err(error),
                Err(cancelled) => return Err(cancelled),
            }
            notes.push(Note::RowsWrap { place: error.place });
            Ok(())
        }
    }
}

struct Body<'a> {
    bytes: &'a [u8],
}

/// The treatment of one property's word within a row.
#[derive(Clone, Copy)]
enum Step {
    Skip,
    Keep(Role),
    List,
}

impl Body<'_> {
    /// Reads everything up to the vertices, one row per line, and returns their end.
    fn lines(
        &self,
        header: &Header,
        vertex: &Element,
        columns: &Columns,
        collector: &mut Collector<'_>,
    ) -> Result<usize, PlyError> {
        let mut at = header.body;
        for element in &header.elements {
            if std::ptr::eq(element, vertex) {
                return self.rows::<true>(at, element, Some((columns, collector)));
            }
            at = self.rows::<true>(at, element, None)?;
        }
        Ok(at)
    }

    /// Reads all elements word by word, regardless of line ends, and returns whether that consumed exactly the words of
    /// the file. Fails only if it is called off.
    fn comes_out_even(
        &self,
        header: &Header,
        vertex: &Element,
        columns: &Columns,
        collector: &mut Collector<'_>,
    ) -> Result<bool, PlyError> {
        let end = header.elements.iter().try_fold(header.body, |at, element| {
            let sink = std::ptr::eq(element, vertex).then_some((columns, &mut *collector));
            self.rows::<false>(at, element, sink)
        });
        match end {
            Ok(at) => Ok(self.from(at).trim_ascii().is_empty()),
            Err(error) if error.problem == Problem::Cancelled => Err(error),
            Err(_) => Ok(false),
        }
    }

    /// Notes that the elements after the vertices are obviously too short or too long.
    fn note_the_rest(&self, at: usize, header: &Header, vertex: &Element, notes: &mut Vec<Note>) {
        let rest = self.from(at).trim_ascii().len();
        let after = header
            .elements
            .iter()
            .skip_while(|&element| !std::ptr::eq(element, vertex))
            .skip(1);
        let mut least: u64 = 0;
        let mut first = None;
        for element in after {
            // A word takes a character and something to part it from the next.
            let words = element.count.saturating_mul(element.properties.len() as u64);
            least = least.saturating_add(words.saturating_mul(2));
            first = first.or((words > 0).then_some(element));
        }
        match first {
            Some(element) if rest as u64 + 1 < least => {
                notes.push(Note::RestDamaged {
                    element: quoted(element.name.as_bytes()),
                });
            }
            None if rest > 0 => notes.push(Note::Trailing { bytes: rest }),
            _ => {}
        }
    }

    /// The bytes from `at` to the end of the file.
    #[inline]
    fn from(&self, at: usize) -> &[u8] {
        self.bytes.get(at..).unwrap_or_default()
    }

    /// Reads an element that starts at `at` and returns its end. With `BY_LINE` a row ends with its line.
    fn rows<const BY_LINE: bool>(
        &self,
        mut at: usize,
        element: &Element,
        mut sink: Option<(&Columns, &mut Collector<'_>)>,
    ) -> Result<usize, PlyError> {
        if element.properties.is_empty() {
            // Such rows would be empty lines, and empty lines are nothing.
            return Ok(at);
        }
        let steps = steps(element, sink.as_ref().map(|(columns, _)| *columns));
        if let Some((_, collector)) = &mut sink {
            // A word takes at least two bytes: what cannot be there gets no memory.
            let fit = self.from(at).len() / (2 * steps.len()) + 1;
            collector.reserve(usize::try_from(element.count).unwrap_or(usize::MAX).min(fit));
        }
        let mut filled = 0;
        for row in 0..element.count {
            at = self.skip_space(at, false);
            let start = at;
            for (index, &step) in steps.iter().enumerate() {
                at = if index == 0 {
                    at
                } else {
                    self.skip_space(at, BY_LINE)
                };
                match self.bytes.get(at) {
                    None => {
                        let error = element.ends_early(row);
                        return Err(PlyError::at_line(line_of(self.bytes, at), error));
                    }
                    Some(b'\n' | b'\r') => return Err(self.row_length(start, element)),
                    Some(_) => {}
                }
                let (value, taken) = number(self.from(at)).ok_or_else(|| self.not_a_number(at))?;
                match step {
                    Step::Skip => {}
                    Step::Keep(role) => {
                        if let Some((_, collector)) = &mut sink {
                            collector.block().column(role)[filled] = value;
                        }
                    }
                    Step::List => {
                        at = self.skip_list::<BY_LINE>(at, value, taken, row, start, element)?;
                        continue;
                    }
                }
                at += taken;
            }
            if BY_LINE {
                at = self.skip_space(at, true);
                if !matches!(self.bytes.get(at), None | Some(b'\n' | b'\r')) {
                    return Err(self.row_length(start, element));
                }
            }
            if let Some((_, collector)) = &mut sink {
                filled += 1;
                if filled == BLOCK {
                    collector.take(filled)?;
                    filled = 0;
                }
            }
        }
        if let Some((_, collector)) = sink {
            collector.take(filled)?;
        }
        Ok(at)
    }

    /// Steps over a list whose count is at `at`, and returns its end.
    fn skip_list<const BY_LINE: bool>(
        &self,
        at: usize,
        count: f64,
        taken: usize,
        row: u64,
        start: usize,
        element: &Element,
    ) -> Result<usize, PlyError> {
        // The fraction of what is not finite is no number, and so not zero.
        if count < 0.0 || count.fract() != 0.0 {
            let problem = Problem::BadListCount(quoted(word(self.from(at))));
            return Err(PlyError::at_line(line_of(self.bytes, at), problem));
        }
        let mut at = at + taken;
        // A cast of too large a count stays too large for any file.
        for _ in 0..count as u64 {
            at = self.skip_space(at, BY_LINE);
            match self.bytes.get(at) {
                None => {
                    let problem = element.ends_early(row);
                    return Err(PlyError::at_line(line_of(self.bytes, at), problem));
                }
                Some(b'\n' | b'\r') => return Err(self.row_length(start, element)),
                Some(_) => at += word(self.from(at)).len(),
            }
        }
        Ok(at)
    }

    /// The end of the white space at `at`, which may be empty.
    #[inline]
    fn skip_space(&self, mut at: usize, within_line: bool) -> usize {
        while let Some(&byte) = self.bytes.get(at) {
            if !is_space(byte) || (within_line && matches!(byte, b'\n' | b'\r')) {
                break;
            }
            at += 1;
        }
        at
    }

    #[cold]
    fn not_a_number(&self, at: usize) -> PlyError {
        let word = word(self.from(at));
        // `1,5` and `1,2,3`, but not `a,b`.
        let could_be = word.contains(&b',')
            && word
                .split(|&b| b == b',')
                .all(|part| part.is_empty() || number(part).is_some());
        let problem = if could_be {
            Problem::Comma(quoted(word))
        } else {
            Problem::NotANumber(quoted(word))
        };
        PlyError::at_line(line_of(self.bytes, at), problem)
    }

    #[cold]
    fn row_length(&self, start: usize, element: &Element) -> PlyError {
        let line = self
            .from(start)
            .split(|&byte| matches!(byte, b'\n' | b'\r'))
            .next()
            .unwrap_or_default();
        let problem = Problem::RowLength {
            found: line
                .split(|&byte| is_space(byte))
                .filter(|word| !word.is_empty())
                .count(),
            expected: element.properties.len(),
            at_least: element.has_lists(),
        };
        PlyError::at_line(line_of(self.bytes, start), problem)
    }
}

fn steps(element: &Element, columns: Option<&Columns>) -> Vec<Step> {
    let roles = columns.map_or(&[][..], Columns::roles);
    let step = |(index, kind)| match (kind, roles.get(index).copied().flatten()) {
        (Kind::List { .. }, _) => Step::List,
        (Kind::Scalar(_), Some(role)) => Step::Keep(role),
        (Kind::Scalar(_), None) => Step::Skip,
    };
    element
        .properties
        .iter()
        .map(|property| property.kind)
        .enumerate()
        .map(step)
        .collect()
}
