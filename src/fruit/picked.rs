//! Points that were picked by hand to be the peduncle, cloud by cloud.

use std::collections::BTreeMap;
use std::sync::Arc;

use serde::{Deserialize, Serialize, Serializer};

use crate::geometry::PointSet;

/// The picked points of each cloud, by the SHA-256 of its file: a file that has changed is another cloud, with other
/// points. Clones share their content.
#[derive(Debug, Clone, PartialEq, Eq, Default, Deserialize)]
#[serde(from = "BTreeMap<String, PointSet>")]
pub struct PickedPoints(Arc<BTreeMap<String, Arc<PointSet>>>);

impl PickedPoints {
    /// The points that were picked of a cloud; `None` if none were picked yet.
    pub fn of(&self, sha256: &str) -> Option<&Arc<PointSet>> {
        self.0.get(sha256)
    }

    /// A copy with the points of one cloud replaced.
    #[must_use]
    pub fn with(&self, sha256: &str, points: Arc<PointSet>) -> Self {
        let mut all = (*self.0).clone();
        all.insert(sha256.into(), points);
        Self(Arc::new(all))
    }
}

impl From<BTreeMap<String, PointSet>> for PickedPoints {
    fn from(all: BTreeMap<String, PointSet>) -> Self {
        let shared = all.into_iter().map(|(sha256, points)| (sha256, Arc::new(points)));
        Self(Arc::new(shared.collect()))
    }
}

impl Serialize for PickedPoints {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(sha256, points)| (sha256, &**points)))
    }
}
