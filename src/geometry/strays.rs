//! Strays: points that lie far from the rest of a cloud, as a depth camera leaves them.

use glam::{DVec3, IVec3};
use rustc_hash::FxHashMap;

use crate::parallel::{Cancelled, Watch};

/// The fewest points among which strays can be told.
const FEWEST: usize = 20;
/// The distance from the cloud's middle, in radii of its inner half, up to which no point is a stray.
const NEVER_WITHIN: f64 = 4.0;
/// The edge of the cells in which points count as close together, in the same radii.
const EDGE: f64 = 1.5;
/// The share of all points below which a cell does not connect its neighbors: a haze of strays around a
/// large cloud would connect with it otherwise.
const CONNECTS: f64 = 1e-4;
/// The number of cells from the middle beyond which a point is a stray in any case.
const FARTHEST_CELL: f64 = 1e6;

/// Returns the indices of the strays among `points`, ascending: the points that lie outside the cloud's bulk
/// and are not connected with it by other points. Nothing depends on the unit or the frame.
///
/// The inner half of the points, in a cube around the median of each coordinate, gives the scale: the half
/// edge r of that cube. The points are sorted into cells of 1.5 r, and from the inner half's cells the bulk
/// grows into adjacent occupied cells. What it does not reach is separated from it by at least 1.5 r; it is
/// a stray if it is also more than 4 r from the middle. Fruits with a peduncle or a leaf in front are far
/// from having such gaps. A single tree of neighbors would not do: the points (0, 0, 0) of missing depth are
/// very close to one another.
///
/// There are none among fewer than 20 points, or where more than half of the points are equal.
pub fn strays(points: &[DVec3]) -> Vec<usize> {
    // Without a watch nothing is called off.
    strays_watched(points, &()).unwrap_or_default()
}

/// [`strays`], called off by a watch.
pub(crate) fn strays_watched(points: &[DVec3], watch: &dyn Watch) -> Result<Vec<usize>, Cancelled> {
    let Some((middle, radius)) = inner_half(points, watch)? else {
        return Ok(Vec::new());
    };
    let far = |p: &DVec3| chebyshev(*p - middle) > NEVER_WITHIN * radius;
    // Most clouds have no point that far out, and this is all that they cost.
    if !points.iter().any(far) {
        return Ok(Vec::new());
    }
    let edge = EDGE * radius;
    let cell = |p: &DVec3| {
        let place = ((*p - middle) / edge).floor();
        (place.abs().max_element() < FARTHEST_CELL).then(|| place.as_ivec3())
    };
    let mut cells: FxHashMap<IVec3, Cell> = FxHashMap::default();
    for piece in points.chunks(PIECE) {
        watch.go_on()?;
        for cell in piece.iter().filter_map(cell) {
            cells.entry(cell).or_default().points += 1;
        }
    }
    let connecting = (CONNECTS * points.len() as f64).ceil() as usize;
    grow_bulk(&mut cells, connecting);
    let in_bulk = |p: &DVec3| cell(p).is_some_and(|cell| cells.get(&cell).is_some_and(|c| c.in_bulk));
    let mut strays = Vec::new();
    for from in (0..points.len()).step_by(PIECE) {
        watch.go_on()?;
        let piece = from..points.len().min(from + PIECE);
        strays.extend(piece.filter(|&i| far(&points[i]) && !in_bulk(&points[i])));
    }
    Ok(strays)
}

/// The indices below `count` that are not among `strays`, which ascend.
pub(crate) fn without(strays: &[usize], count: usize) -> impl Iterator<Item = usize> {
    let mut strays = strays.iter().copied().peekable();
    (0..count).filter(move |i| strays.next_if_eq(i).is_none())
}

/// Points between two questions to the watch: some hundredths of a second.
const PIECE: usize = 1 << 20;

/// The points of one cell.
#[derive(Debug, Clone, Copy, Default)]
struct Cell {
    points: usize,
    in_bulk: bool,
}

/// Grows the bulk from the cells around the middle into all cells that cells of enough points connect with it.
fn grow_bulk(cells: &mut FxHashMap<IVec3, Cell>, connecting: usize) {
    // The inner half reaches less than one cell from the middle, which is a corner of eight.
    let mut open: Vec<IVec3> = around(IVec3::ZERO).filter(|c| c.max_element() < 1).collect();
    while let Some(place) = open.pop() {
        let Some(cell) = cells.get_mut(&place) else {
            continue;
        };
        if !std::mem::replace(&mut cell.in_bulk, true) && cell.points >= connecting {
            open.extend(around(place));
        }
    }
}

/// A cell and the 26 that touch it.
fn around(cell: IVec3) -> impl Iterator<Item = IVec3> {
    (0..27).map(move |i| cell + IVec3::new(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1))
}

/// The median of each coordinate, and half the edge of the cube around it that holds half of the points.
/// `None` if there are too few points or most are equal.
///
/// Points at the very origin are not counted, since a depth camera writes its missing points there.
fn inner_half(points: &[DVec3], watch: &dyn Watch) -> Result<Option<(DVec3, f64)>, Cancelled> {
    if points.len() < FEWEST {
        return Ok(None);
    }
    let measured = || points.iter().filter(|&&p| p != DVec3::ZERO);
    let mut column: Vec<f64> = Vec::with_capacity(points.len());
    // The median of no values is zero, and so is the radius then.
    let mut median = |values: &mut dyn Iterator<Item = f64>| {
        watch.go_on()?;
        column.clear();
        column.extend(values);
        let rank = column.len().saturating_sub(1) / 2;
        let found = (!column.is_empty()).then(|| *column.select_nth_unstable_by(rank, f64::total_cmp).1);
        Ok(found.unwrap_or_default())
    };
    let mut middle = DVec3::ZERO;
    for axis in 0..3 {
        middle[axis] = median(&mut measured().map(|p| p[axis]))?;
    }
    let radius = median(&mut measured().map(|&p| chebyshev(p - middle)))?;
    Ok((radius > 0.0 && radius.is_finite()).then_some((middle, radius)))
}

/// The largest coordinate by amount, which does not overflow where squares would.
fn chebyshev(v: DVec3) -> f64 {
    v.abs().max_element()
}
