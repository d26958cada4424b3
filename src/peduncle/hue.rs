//! Hues, which tell a green peduncle from a red or yellow fruit.

use serde::{Deserialize, Serialize};

/// A range of hues in degrees, 0 to 360; it may run through 0, as 350 to 20 does.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct HueRange {
    /// The first hue.
    pub from_deg: f64,
    /// The last hue, inclusive.
    pub to_deg: f64,
}

impl HueRange {
    /// Whether a hue lies in the range.
    pub fn contains(&self, hue_deg: f64) -> bool {
        if self.from_deg <= self.to_deg {
            (self.from_deg..=self.to_deg).contains(&hue_deg)
        } else {
            hue_deg >= self.from_deg || hue_deg <= self.to_deg
        }
    }
}

/// Colors grayer than this share of their brightest channel have no hue to speak of.
const LEAST_SATURATION: f64 = 0.15;

/// The hue of a color (red, green, blue, alpha) in degrees, 0 to 360; `None` for grays.
pub fn hue_deg(color: [u8; 4]) -> Option<f64> {
    let [r, g, b] = [color[0], color[1], color[2]].map(f64::from);
    let (max, min) = (r.max(g).max(b), r.min(g).min(b));
    let chroma = max - min;
    if max <= 0.0 || chroma / max < LEAST_SATURATION {
        return None;
    }
    let sixth = if max == r {
        (g - b) / chroma
    } else if max == g {
        (b - r) / chroma + 2.0
    } else {
        (r - g) / chroma + 4.0
    };
    Some((60.0 * sixth).rem_euclid(360.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hues_are_those_of_the_color_wheel() {
        let cases = [
            ([255, 0, 0, 255], 0.0),
            ([255, 255, 0, 255], 60.0),
            ([0, 200, 0, 255], 120.0),
            ([0, 0, 9, 255], 240.0),
        ];
        for (color, hue) in cases {
            assert_eq!(hue_deg(color), Some(hue));
        }
        assert_eq!(hue_deg([255, 0, 128, 0]).map(f64::round), Some(330.0));
        assert_eq!(hue_deg([128, 128, 128, 255]), None);
        assert_eq!(hue_deg([0, 0, 0, 255]), None);
        assert_eq!(hue_deg([100, 95, 97, 255]), None, "nearly gray");
    }

    #[test]
    fn a_range_may_run_through_red() {
        let red = HueRange {
            from_deg: 350.0,
            to_deg: 20.0,
        };
        assert!([350.0, 359.0, 0.0, 20.0].into_iter().all(|hue| red.contains(hue)));
        assert!([21.0, 180.0, 349.0].into_iter().all(|hue| !red.contains(hue)));
        let green = HueRange {
            from_deg: 90.0,
            to_deg: 150.0,
        };
        assert!(green.contains(120.0) && !green.contains(0.0) && !green.contains(151.0));
    }
}
