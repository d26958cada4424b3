//! The conversion of rows of numbers to a cloud.

use glam::{DVec3, Vec3};

use super::Note;
use super::columns::{Columns, Role};
use super::error::{PlyError, Problem};
use super::scalar::Scalar;
use crate::geometry::Cloud;
use crate::parallel::Watch;

/// The number of rows that are decoded before they are appended to the cloud: few enough for all columns of a block to
/// stay in the fastest cache.
pub(super) const BLOCK: usize = 128;

/// The number of blocks between two questions to the watch: a millisecond at most.
const LOOK: usize = 32;

/// The label of a point whose label cannot be used.
const NO_LABEL: i32 = -1;

/// Takes decoded rows, a block at a time, and makes a cloud of them.
pub(super) struct Collector<'a> {
    watch: &'a dyn Watch,
    /// Blocks taken, and how many there will be if the header is right.
    taken: usize,
    expected: usize,
    block: Block,
    colors: Option<Colors>,
    positions: Vec<DVec3>,
    normals: Option<Vec<Vec3>>,
    labels: Option<Vec<i32>>,
    dropped: usize,
    unusable_labels: usize,
}

/// Some rows, column by column.
pub(super) struct Block {
    columns: [[f64; BLOCK]; Role::COUNT],
}

impl Block {
    /// The values of a role, one a row.
    #[inline]
    pub(super) fn column(&mut self, role: Role) -> &mut [f64; BLOCK] {
        &mut self.columns[role as usize]
    }
}

impl<'a> Collector<'a> {
    pub(super) fn new(columns: &Columns, rows: u64, watch: &'a dyn Watch) -> Self {
        let mut block = Block {
            columns: [[0.0; BLOCK]; Role::COUNT],
        };
        let colors = Colors::of(columns);
        if colors.is_some() && columns.kind(Role::Alpha).is_none() {
            *block.column(Role::Alpha) = [255.0; BLOCK];
        }
        let rows = usize::try_from(rows).unwrap_or(usize::MAX);
        Self {
            watch,
            taken: 0,
            expected: rows.div_ceil(BLOCK),
            block,
            colors,
            positions: Vec::new(),
            normals: columns.kind(Role::NormalX).map(|_| Vec::new()),
            labels: columns.kind(Role::Label).map(|_| Vec::new()),
            dropped: 0,
            unusable_labels: 0,
        }
    }

    /// Reserves memory for so many rows. The caller knows that the file can hold them.
    pub(super) fn reserve(&mut self, rows: usize) {
        self.positions.reserve(rows);
        if let Some(normals) = &mut self.normals {
            normals.reserve(rows);
        }
        if let Some(colors) = &mut self.colors {
            colors.reserve(rows);
        }
        if let Some(labels) = &mut self.labels {
            labels.reserve(rows);
        }
    }

    /// The block to be filled with the next rows before [`Collector::take`].
    #[inline]
    pub(super) fn block(&mut self) -> &mut Block {
        &mut self.block
    }

    /// A new, empty collector for the same rows.
    pub(super) fn afresh(&self, columns: &Columns) -> Self {
        let rows = self.expected.saturating_mul(BLOCK) as u64;
        Self::new(columns, rows, self.watch)
    }

    /// Takes the first `rows` rows of the block, at most [`BLOCK`].
    ///
    /// # Errors
    /// Returns [`Problem::Cancelled`] if the watch calls the work off.
    pub(super) fn take(&mut self, rows: usize) -> Result<(), PlyError> {
        self.taken += 1;
        if self.taken % LOOK == 1 {
            if self.watch.is_cancelled() {
                return Err(PlyError::of_file(Problem::Cancelled));
            }
            self.watch.advanced(self.taken.min(self.expected), self.expected);
        }
        self.take_rows(rows.min(BLOCK));
        Ok(())
    }

    fn take_rows(&mut self, rows: usize) {
        let of = |role: Role| &self.block.columns[role as usize][..rows];
        let three = |roles: [Role; 3]| {
            let [a, b, c] = roles.map(of);
            a.iter().zip(b).zip(c).map(|((&a, &b), &c)| DVec3::new(a, b, c))
        };
        // Rare, so that the common case does not ask it for each value of each column.
        let kept: Option<Vec<bool>> = three(Role::POSITION)
            .any(|p| !p.is_finite())
            .then(|| three(Role::POSITION).map(DVec3::is_finite).collect());
        let before = self.positions.len();
        extend(&mut self.positions, three(Role::POSITION), kept.as_deref());
        self.dropped += rows - (self.positions.len() - before);
        if let Some(normals) = &mut self.normals {
            let values = three(Role::NORMAL).map(|n| {
                // Asked after the conversion, in which large values become infinite.
                Some(n.as_vec3()).filter(|n| n.is_finite()).unwrap_or(Vec3::ZERO)
            });
            extend(normals, values, kept.as_deref());
        }
        if let Some(colors) = &mut self.colors {
            let values = three(Role::COLOR)
                .zip(of(Role::Alpha))
                .map(|(c, &a)| [c.x, c.y, c.z, a]);
            colors.extend(values, kept.as_deref());
        }
        if let Some(labels) = &mut self.labels {
            let unusable = &mut self.unusable_labels;
            let values = of(Role::Label).iter().enumerate().map(|(row, &value)| {
                let rounded = value.round();
                if (f64::from(i32::MIN)..=f64::from(i32::MAX)).contains(&rounded) {
                    rounded as i32
                } else {
                    let is_kept = kept.as_ref().is_none_or(|kept| kept.get(row) == Some(&true));
                    *unusable += usize::from(is_kept);
                    NO_LABEL
                }
            });
            extend(labels, values, kept.as_deref());
        }
    }

    /// The cloud, and how many rows had no finite position.
    pub(super) fn finish(self, notes: &mut Vec<Note>) -> (Cloud, usize) {
        if self.unusable_labels > 0 {
            notes.push(Note::UnusableLabels {
                count: self.unusable_labels,
            });
        }
        let mut cloud = Cloud::new(self.positions);
        // Every column has as many rows as there are positions, as they are filled side by side.
        let whole = "columns are filled side by side";
        if let Some(normals) = self.normals {
            cloud = cloud.with_normals(normals).expect(whole);
        }
        if let Some(colors) = self.colors {
            cloud = cloud.with_colors(colors.finish()).expect(whole);
        }
        if let Some(labels) = self.labels {
            cloud = cloud.with_labels(labels).expect(whole);
        }
        (cloud, self.dropped)
    }
}

/// Appends the values that are kept; `None` keeps all of them.
fn extend<T>(column: &mut Vec<T>, values: impl Iterator<Item = T>, kept: Option<&[bool]>) {
    match kept {
        None => column.extend(values),
        Some(kept) => {
            column.extend(
                values
                    .zip(kept)
                    .filter_map(|(value, &kept)| kept.then_some(value)),
            );
        }
    }
}

/// Colors to be converted to 0–255. Unless all are bytes, their scale is known only after the last row.
enum Colors {
    Bytes(Vec<[u8; 4]>),
    Scaled {
        values: Vec<[f32; 4]>,
        scales: [Scale; 4],
    },
}

/// The range of a channel's values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Scale {
    /// 0 to 255, being bytes.
    Byte,
    /// Wider integers: 0 to 65535 if one is above 255, else 0 to 255.
    Wide,
    /// Floating point: 0 to 255 if one is above 1, else 0 to 1.
    Float,
}

impl Colors {
    fn of(columns: &Columns) -> Option<Self> {
        let scale = |role| {
            columns.kind(role).map(|kind| match kind {
                Scalar::I8 | Scalar::U8 => Scale::Byte,
                kind if kind.is_float() => Scale::Float,
                _ => Scale::Wide,
            })
        };
        let [red, green, blue] = Role::COLOR.map(scale);
        let scales = [red?, green?, blue?, scale(Role::Alpha).unwrap_or(Scale::Byte)];
        Some(if scales == [Scale::Byte; 4] {
            Self::Bytes(Vec::new())
        } else {
            Self::Scaled {
                values: Vec::new(),
                scales,
            }
        })
    }

    fn reserve(&mut self, rows: usize) {
        match self {
            Self::Bytes(colors) => colors.reserve(rows),
            Self::Scaled { values, .. } => values.reserve(rows),
        }
    }

    fn extend(&mut self, rows: impl Iterator<Item = [f64; 4]>, kept: Option<&[bool]>) {
        // A cast keeps within 0 to 255, and makes 0 of what is no number.
        match self {
            Self::Bytes(colors) => extend(colors, rows.map(|row| row.map(|value| value as u8)), kept),
            Self::Scaled { values, .. } => {
                extend(values, rows.map(|row| row.map(|value| value as f32)), kept);
            }
        }
    }

    fn finish(self) -> Vec<[u8; 4]> {
        let (values, scales) = match self {
            Self::Bytes(colors) => return colors,
            Self::Scaled { values, scales } => (values, scales),
        };
        let mut largest = [f32::NEG_INFINITY; 4];
        for row in &values {
            for (largest, &value) in largest.iter_mut().zip(row) {
                // False for what is no number.
                if value > *largest {
                    *largest = value;
                }
            }
        }
        // Red, green and blue share a scale as far as they share a type; alpha has its own, as
        // files exist with colors to 255 and alpha to 1.
        let mut factors = [1.0; 4];
        for (channel, factor) in factors.iter_mut().enumerate() {
            let group = if channel == 3 { 3..4 } else { 0..3 };
            let largest = group
                .filter(|&other| scales[other] == scales[channel])
                .fold(f32::NEG_INFINITY, |all, other| all.max(largest[other]));
            *factor = match scales[channel] {
                Scale::Float if largest <= 1.0 => 255.0,
                Scale::Wide if largest > 255.0 => 255.0 / 65535.0,
                _ => 1.0,
            };
        }
        let to_byte = |value: f32, factor: f32| (value * factor).round() as u8;
        let row_to_bytes = |row: &[f32; 4]| std::array::from_fn(|i| to_byte(row[i], factors[i]));
        values.iter().map(row_to_bytes).collect()
    }
}
