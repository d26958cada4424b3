//! The details of the planes that were looked at last, as many as there is room for.

use std::collections::VecDeque;
use std::sync::Arc;

use crate::method::{PlaneDetail, PointDetail};

/// Room for details, in bytes. One is always kept.
const ROOM: usize = 128 << 20;

/// Details under their planes' indices, the newest last.
#[derive(Debug, Default)]
pub(in crate::app) struct Details {
    kept: VecDeque<(usize, Arc<PlaneDetail>)>,
}

impl Details {
    pub(in crate::app) fn get(&mut self, index: usize) -> Option<Arc<PlaneDetail>> {
        let place = self.kept.iter().position(|(kept, _)| *kept == index)?;
        let found = self.kept.remove(place)?;
        let detail = found.1.clone();
        self.kept.push_back(found);
        Some(detail)
    }

    pub(in crate::app) fn keep(&mut self, index: usize, detail: Arc<PlaneDetail>) {
        self.kept.retain(|(kept, _)| *kept != index);
        self.kept.push_back((index, detail));
        let size = |detail: &PlaneDetail| detail.points.len() * size_of::<PointDetail>();
        let mut room: usize = self.kept.iter().map(|(_, detail)| size(detail)).sum();
        while room > ROOM && self.kept.len() > 1 {
            room -= self.kept.pop_front().map_or(0, |(_, detail)| size(&detail));
        }
    }

    pub(in crate::app) fn clear(&mut self) {
        self.kept.clear();
    }

    pub(in crate::app) fn all(&self) -> Vec<Arc<PlaneDetail>> {
        self.kept.iter().map(|(_, detail)| detail.clone()).collect()
    }
}
