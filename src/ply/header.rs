//! The header of a PLY file: its encoding, elements and properties.

use std::collections::HashMap;

use super::error::{PlyError, Problem, quoted, text};
use super::scalar::Scalar;
use super::{Encoding, Note};
use crate::geometry::Unit;

/// The most bytes of a header. Real ones have some hundred; a binary file that lost its `end_header` is not searched
/// to its end.
const LONGEST_HEADER: usize = 1 << 20;

/// The layout of a property within a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Scalar(Scalar),
    List { count: Scalar, item: Scalar },
}

#[derive(Debug)]
pub(super) struct Property {
    pub(super) name: String,
    pub(super) kind: Kind,
}

#[derive(Debug)]
pub(super) struct Element {
    pub(super) name: String,
    /// The line of its declaration, counted from 1.
    pub(super) line: usize,
    /// The number of its rows by the header, which may be wrong.
    pub(super) count: u64,
    pub(super) properties: Vec<Property>,
}

impl Element {
    pub(super) fn has_lists(&self) -> bool {
        self.properties
            .iter()
            .any(|p| matches!(p.kind, Kind::List { .. }))
    }

    /// The problem of a file that ends after `complete` rows of this element.
    pub(super) fn ends_early(&self, complete: u64) -> Problem {
        Problem::EndsEarly {
            element: quoted(self.name.as_bytes()),
            complete,
            count: self.count,
        }
    }

    /// The least size of a row in binary, in bytes: its exact size if it has no lists.
    pub(super) fn least_stride(&self) -> usize {
        let sizes = self.properties.iter().map(|property| match property.kind {
            Kind::Scalar(scalar) => scalar.size(),
            Kind::List { count, .. } => count.size(),
        });
        sizes.sum()
    }
}

/// A header and the offset of the body.
#[derive(Debug)]
pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
    pub(super) stated_unit: Option<Unit>,
    pub(super) notes: Vec<Note>,
    /// The offset of the body in bytes from the start of the file.
    pub(super) body: usize,
    /// The line of `end_header`.
    last_line: usize,
}

impl Header {
    /// Reads the header at the start of a file.
    pub(super) fn parse(bytes: &[u8]) -> Result<Self, PlyError> {
        let mut lines = Lines::of(bytes);
        let first = loop {
            match lines.next() {
                Some(line) if line.trim_ascii().is_empty() => {}
                Some(line) => break line.trim_ascii(),
                None => return Err(PlyError::of_file(Problem::Empty)),
            }
        };
        if !first.eq_ignore_ascii_case(b"ply") {
            return Err(PlyError::of_file(other_format(bytes)));
        }
        let mut draft = Draft::default();
        while let Some(line) = lines.next() {
            if lines.at > LONGEST_HEADER {
                break;
            }
            if draft.take(lines.line, line)? == Step::End {
                return draft.finish(lines.line, lines.at);
            }
        }
        Err(PlyError::at_line(
            draft.last_known_line.max(1),
            Problem::NoEndHeader {
                searched: lines.at.min(LONGEST_HEADER),
            },
        ))
    }

    /// The element that holds the points.
    pub(super) fn vertex(&self) -> Result<&Element, PlyError> {
        let named = |exactly: bool| {
            self.elements.iter().find(|element| {
                element.name == "vertex" || (!exactly && element.name.eq_ignore_ascii_case("vertex"))
            })
        };
        named(true)
            .or_else(|| named(false))
            .ok_or_else(|| PlyError::at_line(self.last_line, Problem::NoVertex))
    }
}

/// The line, counted from 1, of the byte at `at`.
pub(super) fn line_of(bytes: &[u8], at: usize) -> usize {
    let end = line_end(bytes);
    1 + bytes.iter().take(at).filter(|&&byte| byte == end).count()
}

/// The byte that ends a line, decided by the first line. In a file with `\r\n` that is `\n`; `\r` ends a line only if
/// it stands alone. Otherwise a binary body that starts with the value 10 or 13 would lose a byte to the header.
fn line_end(bytes: &[u8]) -> u8 {
    let first = bytes.iter().position(|byte| matches!(byte, b'\r' | b'\n'));
    match first.and_then(|at| bytes.get(at..)) {
        Some([b'\r', b'\n', ..]) => b'\n',
        Some([b'\r', ..]) => b'\r',
        _ => b'\n',
    }
}

/// The lines at the start of a file, a byte-order mark left out.
struct Lines<'a> {
    bytes: &'a [u8],
    end: u8,
    /// The offset of the next line.
    at: usize,
    /// The number of the last line that was returned, counted from 1.
    line: usize,
}

impl<'a> Lines<'a> {
    fn of(bytes: &'a [u8]) -> Self {
        let at = if bytes.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
        Self {
            bytes,
            end: line_end(bytes),
            at,
            line: 0,
        }
    }

    fn next(&mut self) -> Option<&'a [u8]> {
        let rest = self.bytes.get(self.at..).filter(|rest| !rest.is_empty())?;
        let line = rest.split(|&byte| byte == self.end).next().unwrap_or(rest);
        self.at += (line.len() + 1).min(rest.len());
        self.line += 1;
        Some(line)
    }
}

/// The problem of bytes that do not start with `ply`.
fn other_format(bytes: &[u8]) -> Problem {
    match bytes {
        [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => Problem::OtherFormat("UTF-16 text"),
        [0x1f, 0x8b, ..] => Problem::OtherFormat("gzip, which must be unpacked first"),
        [b'P', b'K', 3, 4, ..] => Problem::OtherFormat("a ZIP archive"),
        [b'#', b' ', b'.', b'P', b'C', b'D', ..] => Problem::OtherFormat("PCD (Point Cloud Library)"),
        _ => Problem::NotPly,
    }
}

#[derive(Debug, PartialEq, Eq)]
enum Step {
    Continue,
    End,
}

/// A header of which some lines were read.
#[derive(Default)]
struct Draft {
    encoding: Option<Encoding>,
    elements: Vec<Element>,
    element_lines: HashMap<String, usize>,
    /// The properties of the last element.
    property_lines: HashMap<String, usize>,
    unit: Option<Unit>,
    units_disagree: bool,
    unknown_lines: Option<(usize, usize)>,
    last_known_line: usize,
    notes: Vec<Note>,
}

impl Draft {
    fn take(&mut self, number: usize, line: &[u8]) -> Result<Step, PlyError> {
        let mut words = line
            .split(u8::is_ascii_whitespace)
            .filter(|word| !word.is_empty());
        let Some(keyword) = words.next() else {
            return Ok(Step::Continue);
        };
        let words = Words {
            words: words.collect(),
            line: number,
        };
        match keyword.to_ascii_lowercase().as_slice() {
            b"comment" => self.comment(&words),
            b"obj_info" => {}
            b"format" => self.format(&words)?,
            b"element" => self.element(&words)?,
            b"property" => self.property(&words)?,
            b"end_header" => return Ok(Step::End),
            _ => {
                self.unknown_lines.get_or_insert((number, 0)).1 += 1;
                return Ok(Step::Continue);
            }
        }
        self.last_known_line = number;
        Ok(Step::Continue)
    }

    /// `comment unit cm` is our own convention; every other comment is ignored.
    fn comment(&mut self, words: &Words<'_>) {
        let [keyword, symbol] = words.words.as_slice() else {
            return;
        };
        if !keyword.eq_ignore_ascii_case(b"unit") {
            return;
        }
        let Some(unit) = Unit::ALL
            .into_iter()
            .find(|unit| unit.symbol().as_bytes() == *symbol)
        else {
            self.notes.push(Note::UnknownUnit {
                line: words.line,
                unit: quoted(symbol),
            });
            return;
        };
        if self.unit.is_some_and(|stated| stated != unit) && !self.units_disagree {
            self.units_disagree = true;
            self.notes.push(Note::UnitsDisagree { line: words.line });
        }
        self.unit = Some(unit);
    }

    fn format(&mut self, words: &Words<'_>) -> Result<(), PlyError> {
        let malformed = || words.malformed("format NAME 1.0");
        let (name, version) = match words.words.as_slice() {
            [name] => (name, None),
            [name, version] => (name, Some(*version)),
            _ => return Err(malformed()),
        };
        let encoding = match name.to_ascii_lowercase().as_slice() {
            b"ascii" => Encoding::Ascii,
            b"binary_little_endian" => Encoding::BinaryLittleEndian,
            b"binary_big_endian" => Encoding::BinaryBigEndian,
            _ => return Err(words.error(Problem::UnknownFormat(quoted(name)))),
        };
        if self.encoding.replace(encoding).is_some() {
            return Err(words.error(Problem::SecondFormat));
        }
        if version != Some(b"1.0") {
            self.notes.push(Note::Version(
                version.map_or_else(|| "not stated".to_owned(), quoted),
            ));
        }
        Ok(())
    }

    fn element(&mut self, words: &Words<'_>) -> Result<(), PlyError> {
        let [name, count] = words.words.as_slice() else {
            return Err(words.malformed("element NAME COUNT"));
        };
        let parsed = std::str::from_utf8(count)
            .ok()
            .and_then(|count| count.parse().ok());
        let count = parsed.ok_or_else(|| words.error(Problem::BadCount(quoted(count))))?;
        let key = text(name);
        if let Some(first_line) = self.element_lines.insert(key.clone(), words.line) {
            return Err(words.error(Problem::DuplicateElement {
                name: quoted(name),
                first_line,
            }));
        }
        self.property_lines.clear();
        self.elements.push(Element {
            name: key,
            line: words.line,
            count,
            properties: Vec::new(),
        });
        Ok(())
    }

    fn property(&mut self, words: &Words<'_>) -> Result<(), PlyError> {
        let scalar =
            |word: &[u8]| Scalar::named(word).ok_or_else(|| words.error(Problem::UnknownType(quoted(word))));
        let (kind, name) = match words.words.as_slice() {
            [list, count, item, name] if list.eq_ignore_ascii_case(b"list") => {
                let kind = Kind::List {
                    count: scalar(count)?,
                    item: scalar(item)?,
                };
                if scalar(count)?.is_float() {
                    return Err(words.error(Problem::FractionalListCount(quoted(count))));
                }
                (kind, name)
            }
            [list, ..] if list.eq_ignore_ascii_case(b"list") => {
                return Err(words.malformed("property list COUNT_TYPE ITEM_TYPE NAME"));
            }
            [kind, name] => (Kind::Scalar(scalar(kind)?), name),
            _ => return Err(words.malformed("property TYPE NAME")),
        };
        let Some(element) = self.elements.last_mut() else {
            return Err(words.error(Problem::PropertyBeforeElement));
        };
        let key = text(name);
        if let Some(first_line) = self.property_lines.insert(key.clone(), words.line) {
            return Err(words.error(Problem::DuplicateProperty {
                name: quoted(name),
                first_line,
            }));
        }
        element.properties.push(Property { name: key, kind });
        Ok(())
    }

    fn finish(mut self, last_line: usize, body: usize) -> Result<Header, PlyError> {
        let encoding = self
            .encoding
            .ok_or_else(|| PlyError::at_line(last_line, Problem::NoFormat))?;
        if let Some((first_line, count)) = self.unknown_lines {
            self.notes.push(Note::UnknownHeaderLines { first_line, count });
        }
        Ok(Header {
            encoding,
            elements: self.elements,
            stated_unit: self.unit.filter(|_| !self.units_disagree),
            notes: self.notes,
            body,
            last_line,
        })
    }
}

/// The words of a header line after its keyword.
struct Words<'a> {
    words: Vec<&'a [u8]>,
    line: usize,
}

impl Words<'_> {
    fn error(&self, problem: Problem) -> PlyError {
        PlyError::at_line(self.line, problem)
    }

    fn malformed(&self, form: &'static str) -> PlyError {
        self.error(Problem::Malformed {
            form,
            found: self.words.len() + 1,
        })
    }
}
