//! Gaps between clumps, where cuts leave them whole.
//!
//! A leaf that holds a part of a clump and something far from it is as wide as that is far, and single
//! precision then blurs all of the clump. What is near a clump that lies in several such leaves is in
//! doubt between them.

use super::order::{Cut, Item};

/// What lies within so much of each other, in units of how far what is cut reaches, is close.
const CLOSE: f32 = 1.0 / 64.0;
/// So many close items are a clump.
const CLUMP: usize = 3;

/// About so many items tell whether a cut may go through a clump: not where fewer than one of `BESIDE`
/// are close to it. An even surface has one of 32 there.
const TOLD_BY: usize = 64;
const BESIDE: usize = 8;

/// How finely gaps are looked for, and how many bins one leaves empty.
const BINS: usize = 256;
const GAP: usize = 4;
/// Neither half has fewer items: a small leaf is as dear as a full one.
const LEAST: usize = 2;
/// Of more items than so many none has fewer than this part, lest it take too many cuts.
const MANY: usize = 256;
const LEAST_PART: usize = 8;

/// How many items are to be in the first half so that the cut is in a gap, where the one that was made
/// goes through a clump: as many as in that one, or nearly, if there are several gaps.
pub(super) fn half_at_gap(items: &[Item], cut: &Cut) -> Option<usize> {
    let Cut { axis, low, high, .. } = *cut;
    let at = items[cut.half].at;
    let close = CLOSE * (high - low);
    let (mut told, mut beside) = (0, 0);
    for item in items.iter().step_by(items.len().div_ceil(TOLD_BY)) {
        told += 1;
        beside += usize::from((item.at[axis] - at[axis]).abs() < close);
    }
    if BESIDE * beside < told {
        return None;
    }
    let clump = items
        .iter()
        .filter(|item| (item.at - at).abs().max_element() < close);
    if clump.count() < CLUMP {
        return None;
    }
    let mut bins = [0; BINS];
    for item in items {
        let bin = (item.at[axis] - low) / (high - low) * BINS as f32;
        bins[(bin as usize).min(BINS - 1)] += 1;
    }
    let least = if items.len() > MANY {
        items.len() / LEAST_PART
    } else {
        LEAST
    };
    let (mut best, mut below, mut empty) = (None, 0, 0);
    for bin in bins {
        if bin == 0 {
            empty += 1;
            continue;
        }
        let half = if cut.backward { items.len() - below } else { below };
        if empty >= GAP
            && (least..=items.len() - least).contains(&half)
            && best.is_none_or(|best: usize| half.abs_diff(cut.half) < best.abs_diff(cut.half))
        {
            best = Some(half);
        }
        empty = 0;
        below += bin;
    }
    best
}
