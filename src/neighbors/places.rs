//! Points that lie exactly at one place, found by hashing.

use glam::DVec3;

/// The distinct places of `points`: for each its lowest point index, ascending, and for each point
/// its place.
pub(super) fn distinct_places(points: &[DVec3]) -> (Vec<u32>, Vec<u32>) {
    const FREE: u32 = u32::MAX;
    let slots = (points.len() * 2).next_power_of_two();
    let mut table = vec![FREE; slots];
    let mut first = Vec::with_capacity(points.len());
    let mut place_of = Vec::with_capacity(points.len());
    for (i, p) in points.iter().enumerate() {
        let mut slot = hash(*p) as usize & (slots - 1);
        let place = loop {
            let place = table[slot];
            if place == FREE {
                table[slot] = first.len() as u32;
                first.push(i as u32);
                break table[slot];
            }
            if points[first[place as usize] as usize] == *p {
                break place;
            }
            slot = (slot + 1) & (slots - 1);
        };
        place_of.push(place);
    }
    (first, place_of)
}

fn hash(p: DVec3) -> u64 {
    // Adding zero turns -0.0 into 0.0, so that equal coordinates have equal bits.
    (p + 0.0).to_array().iter().fold(0, |h: u64, x| {
        let mixed = (h ^ x.to_bits()).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        mixed ^ (mixed >> 32)
    })
}
