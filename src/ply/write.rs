//! The writer of PLY files.

use std::io::{self, Write};

use glam::{DVec3, Vec3};

use crate::geometry::{Cloud, Unit};

/// The encoding of the numbers in a PLY file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum Encoding {
    /// Text, one line per row.
    #[cfg_attr(feature = "cli", value(help = "Text"))]
    Ascii,
    /// Bytes, the least significant first, as on almost all machines.
    #[default]
    #[cfg_attr(feature = "cli", value(name = "binary", help = "Binary, little-endian"))]
    BinaryLittleEndian,
    /// Bytes, the most significant first.
    #[cfg_attr(feature = "cli", value(skip))]
    BinaryBigEndian,
}

impl Encoding {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Ascii, Self::BinaryLittleEndian, Self::BinaryBigEndian];

    /// Its name in the header.
    fn name(self) -> &'static str {
        match self {
            Self::Ascii => "ascii",
            Self::BinaryLittleEndian => "binary_little_endian",
            Self::BinaryBigEndian => "binary_big_endian",
        }
    }
}

/// The number of bits of a position's coordinates. Normals always have 32.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Precision {
    /// 32 bits: seven digits, as depth cameras and most programs use.
    #[default]
    Float,
    /// 64 bits, for large offsets such as projected coordinates.
    Double,
}

impl Precision {
    /// The least that keeps every position of a cloud exactly.
    pub fn needed_by(cloud: &Cloud) -> Self {
        let is_single = |p: &DVec3| p.as_vec3().as_dvec3() == *p;
        if cloud.positions().iter().all(is_single) {
            Self::Float
        } else {
            Self::Double
        }
    }
}

/// The options of [`write()`]. The default is binary, in single precision, without a unit.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct WriteOptions<'a> {
    /// The unit to state in the header, as a comment that [`read()`](super::read) understands.
    pub unit: Option<Unit>,
    /// Comments for the header. One of several lines becomes several comments.
    pub comments: &'a [String],
    /// The encoding of the numbers.
    pub encoding: Encoding,
    /// The precision of the positions.
    pub precision: Precision,
    /// Further columns of single precision after the cloud's own, which point cloud programs show as scalar fields.
    /// Each has a name without spaces and a value a point; missing values are NaN, as those programs have it.
    pub scalars: &'a [(&'a str, &'a [f32])],
}

/// The reason why a cloud was not written, or not to its end.
#[derive(Debug, thiserror::Error)]
pub enum WriteError {
    /// The destination refused.
    #[error(transparent)]
    Io(#[from] io::Error),
    /// A position is too large for [`Precision::Float`]. Nothing was written.
    #[error("the position of point {point} (counted from 0) is too large for single precision")]
    TooLarge {
        /// The index of the first such point.
        point: usize,
    },
    /// A further column has another number of values than the cloud has points. Nothing was written.
    #[error("the column {name} has {values} values for {points} points")]
    UnequalColumn {
        /// The name of the column.
        name: String,
        /// Its values.
        values: usize,
        /// Points of the cloud.
        points: usize,
    },
}

/// Writes a cloud as PLY: x y z, nx ny nz if it has normals, red green blue if it has colors (and alpha unless all are
/// opaque), label if it has labels, then the scalars of the options. The same cloud and options give the same bytes.
///
/// The destination needs no buffer of its own: it receives some tens of kilobytes at a time.
///
/// # Errors
/// Returns an error if the destination fails, or if a position does not fit in the requested precision.
pub fn write<'a>(
    mut out: impl Write,
    cloud: &'a Cloud,
    options: &WriteOptions<'a>,
) -> Result<(), WriteError> {
    const FLUSH_AT: usize = 1 << 16;
    let columns = Columns::of(cloud, options)?;
    let mut buffer = header(cloud, &columns, options).into_bytes();
    for row in 0..cloud.len() {
        match options.encoding {
            Encoding::Ascii => {
                columns.row(row, &mut AsciiRow { buffer: &mut buffer });
                // Every number left a space behind itself; the last one becomes the end of the line.
                if let Some(last) = buffer.last_mut() {
                    *last = b'\n';
                }
            }
            Encoding::BinaryLittleEndian => columns.row(row, &mut BinaryRow::<false> { buffer: &mut buffer }),
            Encoding::BinaryBigEndian => columns.row(row, &mut BinaryRow::<true> { buffer: &mut buffer }),
        }
        if buffer.len() >= FLUSH_AT {
            out.write_all(&buffer)?;
            buffer.clear();
        }
    }
    out.write_all(&buffer)?;
    Ok(out.flush()?)
}

/// The columns that are written.
struct Columns<'a> {
    positions: &'a [DVec3],
    double: bool,
    normals: Option<&'a [Vec3]>,
    colors: Option<&'a [[u8; 4]]>,
    alpha: bool,
    labels: Option<&'a [i32]>,
    wide_labels: bool,
    scalars: &'a [(&'a str, &'a [f32])],
}

impl<'a> Columns<'a> {
    fn of(cloud: &'a Cloud, options: &WriteOptions<'a>) -> Result<Self, WriteError> {
        let points = cloud.len();
        if let Some((name, values)) = options.scalars.iter().find(|(_, values)| values.len() != points) {
            return Err(WriteError::UnequalColumn {
                name: (*name).to_owned(),
                values: values.len(),
                points,
            });
        }
        let double = options.precision == Precision::Double;
        let too_large = |p: &DVec3| !double && !p.as_vec3().is_finite();
        if let Some(point) = cloud.positions().iter().position(too_large) {
            return Err(WriteError::TooLarge { point });
        }
        let is_wide = |&label: &i32| u8::try_from(label).is_err();
        Ok(Self {
            positions: cloud.positions(),
            double,
            normals: cloud.normals(),
            colors: cloud.colors(),
            alpha: cloud
                .colors()
                .is_some_and(|colors| colors.iter().any(|&[.., alpha]| alpha != 255)),
            labels: cloud.labels(),
            wide_labels: cloud.labels().is_some_and(|labels| labels.iter().any(is_wide)),
            scalars: options.scalars,
        })
    }

    fn row(&self, row: usize, out: &mut impl Row) {
        let position = self.positions[row];
        if self.double {
            for value in position.to_array() {
                out.double(value);
            }
        } else {
            for value in position.as_vec3().to_array() {
                out.float(value);
            }
        }
        if let Some(normals) = self.normals {
            for value in normals[row].to_array() {
                out.float(value);
            }
        }
        if let Some(colors) = self.colors {
            let [red, green, blue, alpha] = colors[row];
            for value in [red, green, blue] {
                out.byte(value);
            }
            if self.alpha {
                out.byte(alpha);
            }
        }
        if let Some(labels) = self.labels {
            match u8::try_from(labels[row]) {
                Ok(label) if !self.wide_labels => out.byte(label),
                _ => out.int(labels[row]),
            }
        }
        for (_, values) in self.scalars {
            out.float(values[row]);
        }
    }
}

fn header(cloud: &Cloud, columns: &Columns<'_>, options: &WriteOptions<'_>) -> String {
    let mut lines = vec![
        "ply".to_owned(),
        format!("format {} 1.0", options.encoding.name()),
    ];
    lines.extend(options.unit.map(|unit| format!("comment unit {unit}")));
    let comment_lines = options
        .comments
        .iter()
        .flat_map(|comment| comment.split(['\n', '\r']));
    lines.extend(comment_lines.map(|line| format!("comment {line}").trim_end().to_owned()));
    lines.push(format!("element vertex {}", cloud.len()));
    let mut declare = |kind: &str, names: &[&str]| {
        lines.extend(names.iter().map(|name| format!("property {kind} {name}")));
    };
    declare(if columns.double { "double" } else { "float" }, &["x", "y", "z"]);
    if columns.normals.is_some() {
        declare("float", &["nx", "ny", "nz"]);
    }
    if columns.colors.is_some() {
        declare("uchar", &["red", "green", "blue"]);
    }
    if columns.alpha {
        declare("uchar", &["alpha"]);
    }
    if columns.labels.is_some() {
        declare(if columns.wide_labels { "int" } else { "uchar" }, &["label"]);
    }
    for (name, _) in columns.scalars {
        declare("float", &[*name]);
    }
    lines.push("end_header\n".to_owned());
    lines.join("\n")
}

/// A destination for the values of one row.
trait Row {
    fn float(&mut self, value: f32);
    fn double(&mut self, value: f64);
    fn byte(&mut self, value: u8);
    fn int(&mut self, value: i32);
}

/// A row as text: the fewest digits that distinguish each number from its neighbors, a space after each.
struct AsciiRow<'a> {
    buffer: &'a mut Vec<u8>,
}

impl AsciiRow<'_> {
    fn put(&mut self, text: std::fmt::Arguments<'_>) {
        // Memory takes everything.
        let _ = write!(self.buffer, "{text} ");
    }

    /// Plain digits where they are few, an exponent for the very large and very small.
    fn put_float(&mut self, value: impl Into<f64> + std::fmt::Display + std::fmt::LowerExp + Copy) {
        let size: f64 = value.into().abs();
        if size == 0.0 || (1e-5..1e16).contains(&size) || !size.is_finite() {
            self.put(format_args!("{value}"));
        } else {
            self.put(format_args!("{value:e}"));
        }
    }
}

impl Row for AsciiRow<'_> {
    fn float(&mut self, value: f32) {
        self.put_float(value);
    }

    fn double(&mut self, value: f64) {
        self.put_float(value);
    }

    fn byte(&mut self, value: u8) {
        self.put(format_args!("{value}"));
    }

    fn int(&mut self, value: i32) {
        self.put(format_args!("{value}"));
    }
}

struct BinaryRow<'a, const BIG_ENDIAN: bool> {
    buffer: &'a mut Vec<u8>,
}

impl<const BIG_ENDIAN: bool> BinaryRow<'_, BIG_ENDIAN> {
    fn put<const SIZE: usize>(&mut self, mut little_endian: [u8; SIZE]) {
        if BIG_ENDIAN {
            little_endian.reverse();
        }
        self.buffer.extend_from_slice(&little_endian);
    }
}

impl<const BIG_ENDIAN: bool> Row for BinaryRow<'_, BIG_ENDIAN> {
    fn float(&mut self, value: f32) {
        self.put(value.to_le_bytes());
    }

    fn double(&mut self, value: f64) {
        self.put(value.to_le_bytes());
    }

    fn byte(&mut self, value: u8) {
        self.put([value]);
    }

    fn int(&mut self, value: i32) {
        self.put(value.to_le_bytes());
    }
}
