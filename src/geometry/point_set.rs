//! A set of a cloud's points, by their indices.

use std::fmt;

use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error as _};

/// Indices of points, each once and in ascending order. It is written as ranges, `5-90,92`: points that
/// are selected together are mostly consecutive in their file.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct PointSet(Vec<u32>);

impl PointSet {
    /// The points whose flag is set. Points from [`u32::MAX`] on are left out: no cloud has so many.
    pub fn of_mask(mask: &[bool]) -> Self {
        let set = mask.iter().enumerate().filter(|(_, is_in)| **is_in);
        Self(set.filter_map(|(i, _)| u32::try_from(i).ok()).collect())
    }

    /// A flag for each point of a cloud of `points` points.
    pub fn mask(&self, points: usize) -> Vec<bool> {
        let mut mask = vec![false; points];
        for i in self.iter().take_while(|&i| i < points) {
            mask[i] = true;
        }
        mask
    }

    /// The indices, ascending.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = usize> + Clone + '_ {
        self.0.iter().map(|&i| i as usize)
    }

    /// The number of points in the set.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether the set is empty.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Whether the set contains a point.
    pub fn contains(&self, index: usize) -> bool {
        u32::try_from(index).is_ok_and(|i| self.0.binary_search(&i).is_ok())
    }
}

impl FromIterator<usize> for PointSet {
    fn from_iter<I: IntoIterator<Item = usize>>(indices: I) -> Self {
        let mut set: Vec<u32> = indices
            .into_iter()
            .filter_map(|i| u32::try_from(i).ok())
            .collect();
        set.sort_unstable();
        set.dedup();
        Self(set)
    }
}

impl fmt::Display for PointSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut is_first = true;
        for run in self.0.chunk_by(|a, b| a + 1 == *b) {
            if !std::mem::take(&mut is_first) {
                f.write_str(",")?;
            }
            match run {
                [only] => write!(f, "{only}")?,
                [from, .., to] => write!(f, "{from}-{to}")?,
                [] => {}
            }
        }
        Ok(())
    }
}

impl std::str::FromStr for PointSet {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        const EXPECTED: &str = "expected indices and ranges of points in ascending order, as in 5-90,92";
        let mut set: Vec<u32> = Vec::new();
        for run in text.split(',').filter(|_| !text.is_empty()) {
            let (from, to) = run.split_once('-').unwrap_or((run, run));
            let (from, to): (u32, u32) = from.parse().ok().zip(to.parse().ok()).ok_or(EXPECTED)?;
            let is_ascending = from <= to && set.last().is_none_or(|last| *last < from);
            // A range without end would fill the memory.
            if !is_ascending || to - from > MOST {
                return Err(EXPECTED);
            }
            set.extend(from..=to);
        }
        Ok(Self(set))
    }
}

/// More points than any selection has.
const MOST: u32 = 200_000_000;

impl Serialize for PointSet {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for PointSet {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        text.parse().map_err(D::Error::custom)
    }
}
