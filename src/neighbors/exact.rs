//! The nearest place of one query in double precision alone, where single precision tells nothing apart.

use glam::DVec3;

use super::Neighbors;
use super::boxes::WIDTH;
use super::tree::LEAF;

/// A place that may be the nearest one: its squared distance; the lowest index of its points, which decides between
/// places that are as far; and its position in the tree's order.
pub(super) type Candidate = (f64, u32, usize);

/// The lowest and the highest corner of a box along the coordinate axes, and the lowest index of its points.
type AxisBox = (DVec3, DVec3, u32);

/// Boxes of the leaves along the coordinate axes, then those of sixteen each, up to a single group.
///
/// Rounding may make numbers equal but never exchanges them. So the squared distance to a box, computed in the
/// same steps, is at most the computed one to each of its points, however far away they are. Among points that
/// are all as far, as doubles tell it, the lowest index of a box says whether it is worth a look.
#[derive(Debug)]
pub(super) struct ExactBoxes(Vec<Vec<AxisBox>>);

impl ExactBoxes {
    pub(super) fn new(index: &Neighbors) -> Self {
        let point = |position| {
            let at = index.tree.point(position);
            (at, at, index.first[position])
        };
        let mut boxes: Vec<AxisBox> = (0..index.first.len()).map(point).collect();
        let (mut levels, mut size) = (Vec::new(), LEAF);
        while levels.is_empty() || boxes.len() > WIDTH {
            let join = |a: AxisBox, b: &AxisBox| (a.0.min(b.0), a.1.max(b.1), a.2.min(b.2));
            let joined = |boxes: &[AxisBox]| boxes.iter().fold(boxes[0], join);
            boxes = boxes.chunks(size).map(joined).collect();
            levels.push(boxes.clone());
            size = WIDTH;
        }
        Self(levels)
    }

    /// The nearest place to `query`, which is `best` unless another one is nearer.
    pub(super) fn nearest(&self, index: &Neighbors, query: DVec3, mut best: Candidate) -> Candidate {
        let mut groups = vec![(self.0.len() - 1, 0)];
        while let Some((level, first)) = groups.pop() {
            for (node, &(low, high, lowest)) in self.0[level].iter().enumerate().skip(first).take(WIDTH) {
                let away = (low - query).max(query - high).max(DVec3::ZERO);
                if (away.length_squared(), lowest) >= (best.0, best.1) {
                    continue;
                }
                if level > 0 {
                    groups.push((level - 1, node * WIDTH));
                } else {
                    best = index.nearer_in(node, query, best);
                }
            }
        }
        best
    }
}
