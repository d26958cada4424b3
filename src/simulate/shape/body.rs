//! A fruit's body: a tapered surface with lobes or ribs, a neck, and a dimple at either end.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::{DVec3, Vec3};
use rand::{Rng, RngExt};

use super::color::Paint;
use crate::geometry::Cloud;
use crate::simulate::mesh::{Mesh, Vertex};

/// Corners along the axis and around it: triangles of about a millimeter, the size of a pixel at
/// 45 cm, whose flatness is off by a few micrometers only.
const RINGS: u32 = 150;
const AROUND: u32 = 256;

/// The share of the stem end's dimple that the calyx fills.
const CALYX_FILLS: f64 = 0.3;

/// The parts of a shape that are the same for all fruits of a kind.
#[derive(Debug, Clone, Copy)]
pub(in crate::simulate) struct Form {
    /// The boxiness of the profile above and below the middle: 2 is round, more is boxier.
    pub(in crate::simulate) boxy: (f64, f64),
    /// The radius of the dimples at the stem end and the blossom end, relative to the body's.
    pub(in crate::simulate) dimple_radius: (f64, f64),
    /// The depth of the blossom end's dimple, relative to the other's.
    pub(in crate::simulate) blossom_dimple: f64,
    /// The rounding of the grooves between the lobes at their bottoms.
    pub(in crate::simulate) groove_rounding: f64,
    /// The narrowing towards the stem end, relative to the width, which is steepest at 0.3 of half the height
    /// over the middle: a pear's neck.
    pub(in crate::simulate) neck: f64,
}

impl Form {
    /// A sweet pepper.
    pub(in crate::simulate) const PEPPER: Self = Self {
        boxy: (2.9, 2.3),
        dimple_radius: (0.42, 0.33),
        blossom_dimple: 0.4,
        groove_rounding: 0.28,
        neck: 0.0,
    };
}

/// The body's measures, in the fruit's frame: y up the axis, the shoulders' tops at +height/2, the
/// lobes' bottoms at −height/2.
#[derive(Debug, Clone)]
pub(in crate::simulate) struct Body {
    pub(in crate::simulate) form: Form,
    pub(in crate::simulate) half_height_cm: f64,
    pub(in crate::simulate) half_width_cm: f64,
    pub(in crate::simulate) lobes: u32,
    pub(in crate::simulate) lobe_depth: f64,
    pub(in crate::simulate) taper: f64,
    pub(in crate::simulate) dimple_cm: f64,
    pub(in crate::simulate) asymmetry: Asymmetry,
}

/// The fruit's departures from its symmetry; each amplitude is of the size of the setting.
#[derive(Debug, Clone, Copy)]
pub(in crate::simulate) struct Asymmetry {
    size: f64,
    /// Lobes of unequal width, an oval section, one side fuller, slanting shoulders, a blossom end
    /// off the axis: the direction of each, around the axis.
    directions_rad: [f64; 5],
}

impl Asymmetry {
    pub(in crate::simulate) fn draw(size: f64, rng: &mut impl Rng) -> Self {
        let directions_rad = rng.random::<[f64; 5]>().map(|u| u * TAU);
        Self { size, directions_rad }
    }

    /// The wave `cos(n (θ − direction))` of one departure, times the amplitude.
    fn wave(&self, which: usize, n: f64, around_rad: f64) -> f64 {
        self.size * (n * (around_rad - self.directions_rad[which])).cos()
    }
}

/// The height and radius of the profile at a ring, before lobes.
#[derive(Debug, Clone, Copy)]
struct Profile {
    /// Height over the middle, relative to half the body's height: −1 to 1.
    up: f64,
    /// Distance from the axis relative to the body's half width: 0 to 1.
    out: f64,
    /// The same before the taper.
    out_untapered: f64,
}

/// Lengths that make the profile reach its full height and width in spite of dimples and taper.
#[derive(Debug, Clone, Copy)]
struct Fit {
    above: f64,
    below: f64,
    out: f64,
}

impl Body {
    /// The height of the peduncle's base over the center, a little above the floor of the stem end's dimple,
    /// which its calyx fills.
    pub(in crate::simulate) fn calyx_cm(&self) -> f64 {
        self.profile(FRAC_PI_2, self.fit()).up * self.half_height_cm + CALYX_FILLS * self.dimple_cm
    }

    /// The radius of a ball around the center that holds the body.
    pub(in crate::simulate) fn ball_cm(&self) -> f64 {
        self.half_height_cm.hypot(self.half_width_cm)
    }

    /// The skin, in the fruit's frame.
    pub(in crate::simulate) fn mesh(&self, paint: &Paint) -> Mesh {
        let fit = self.fit();
        let angle_rad = |ring: u32| {
            // Rings stand between the two poles, which are corners of their own.
            (f64::from(ring + 1) / f64::from(RINGS + 1) - 0.5) * std::f64::consts::PI
        };
        let profiles: Vec<Profile> = (0..RINGS).map(|r| self.profile(angle_rad(r), fit)).collect();
        let around: Vec<Around> = (0..AROUND)
            .map(|s| self.around(f64::from(s) / f64::from(AROUND) * TAU))
            .collect();
        let vertex = |profile: Profile, side: Around| {
            let relative = self.point(profile, side);
            Vertex {
                position: relative * DVec3::new(self.half_width_cm, self.half_height_cm, self.half_width_cm),
                color: color(paint, relative),
            }
        };
        Mesh::skin(
            Cloud::FRUIT,
            (RINGS, AROUND),
            vertex(self.profile(-FRAC_PI_2, fit), around[0]),
            vertex(self.profile(FRAC_PI_2, fit), around[0]),
            |ring, step| vertex(profiles[ring as usize], around[step as usize]),
        )
    }

    /// Two halves of superellipses, of different boxiness, with the dimples pressed in. Parametrized
    /// by the angle seen from the center, which spaces the rings evenly and is smooth at the poles.
    fn profile(&self, angle_rad: f64, fit: Fit) -> Profile {
        let (sin, cos) = angle_rad.sin_cos();
        let cos = cos.max(0.0);
        let dimple = self.dimple_cm / self.half_height_cm;
        let form = &self.form;
        let (boxy, radius, depth, reach) = if sin >= 0.0 {
            (form.boxy.0, form.dimple_radius.0, dimple, fit.above)
        } else {
            let depth = dimple * form.blossom_dimple;
            (form.boxy.1, form.dimple_radius.1, depth, fit.below)
        };
        let scale = (cos.powf(boxy) + sin.abs().powf(boxy)).powf(-boxy.recip());
        let out_untapered = cos * scale;
        // A bell that ends in zero at the rim, so that the two halves meet smoothly.
        let bell = |x: f64| (-(x / radius).powi(2)).exp();
        let pressed = depth * (bell(out_untapered) - bell(1.0));
        let up = sin.signum() * (reach * sin.abs() * scale - pressed);
        Profile {
            up,
            out: fit.out * out_untapered * (1.0 - self.taper * (1.0 - up) / 2.0) * self.neck(up),
            out_untapered,
        }
    }

    /// The width that a neck leaves at a height, relative to that without a neck.
    fn neck(&self, up: f64) -> f64 {
        if self.form.neck == 0.0 {
            return 1.0;
        }
        1.0 - self.form.neck * (1.0 + ((up - 0.3) / 0.35).tanh()) / 2.0
    }

    /// Stretches the profile until its highest and lowest points are at ±1 and its widest at 1.
    fn fit(&self) -> Fit {
        const SAMPLES: i32 = 400;
        let angles =
            |sign: f64| (0..=SAMPLES).map(move |i| sign * f64::from(i) / f64::from(SAMPLES) * FRAC_PI_2);
        let mut fit = Fit {
            above: 1.0,
            below: 1.0,
            out: 1.0,
        };
        let reach = |sign: f64, fit: Fit| {
            let ups = angles(sign).map(|a| self.profile(a, fit).up * sign);
            ups.fold(0.0, f64::max)
        };
        // The difference that is missing is added; the slope of the reach is about 1, so few steps do.
        for _ in 0..12 {
            fit.above += 1.0 - reach(1.0, fit);
            fit.below += 1.0 - reach(-1.0, fit);
        }
        let outs = angles(1.0).chain(angles(-1.0)).map(|a| self.profile(a, fit).out);
        fit.out = 1.0 / outs.fold(0.0, f64::max);
        fit
    }

    fn around(&self, around_rad: f64) -> Around {
        let a = &self.asymmetry;
        let n = f64::from(self.lobes);
        let cos = (n / 2.0 * (around_rad + 2.0 * a.wave(0, 1.0, around_rad))).cos();
        let (crest, floor) = (
            1.0_f64.hypot(self.form.groove_rounding),
            self.form.groove_rounding,
        );
        Around {
            direction: DVec3::new(around_rad.cos(), 0.0, -around_rad.sin()),
            groove: (crest - cos.hypot(self.form.groove_rounding)) / (crest - floor),
            oval: a.wave(1, 2.0, around_rad),
            full: a.wave(2, 1.0, around_rad),
            slant: a.wave(3, 1.0, around_rad),
        }
    }

    /// A point of the surface, relative to half the width and half the height.
    fn point(&self, profile: Profile, side: Around) -> DVec3 {
        let Profile {
            up,
            out,
            out_untapered: rim,
        } = profile;
        // Grooves are shallow at the waist, deep at both ends, and run over the shoulders into the
        // dimples; they fade where they meet on the axis, which keeps the surface smooth there.
        let deep = 0.55 + 0.45 * up * up;
        let over = if up > 0.0 { 1.0 } else { 1.6 } * 3.0 * rim * rim * (1.0 - rim.powi(4));
        let inward = self.lobe_depth * side.groove;
        let radius = out * (1.0 - inward * deep) * (1.0 + side.oval + 0.7 * side.full * up);
        let height = up - up.signum() * up * up * inward * over * 0.5 + side.slant * rim * up.abs();
        let low = (1.0 - up) / 2.0;
        let bend = self.asymmetry.directions_rad[4];
        let off_axis = DVec3::new(bend.cos(), 0.0, bend.sin()) * self.asymmetry.size * low * low;
        side.direction * radius + DVec3::Y * height + off_axis
    }
}

/// The skin's own color: greener in the dimple, where a pepper ripens last, and mottled a little.
fn color(paint: &Paint, relative: DVec3) -> Vec3 {
    let from_axis = relative.x.hypot(relative.z);
    let unripe = if relative.y > 0.0 {
        0.45 * (-(from_axis / 0.4).powi(2)).exp()
    } else {
        0.0
    };
    paint.fruit(relative, unripe)
}

/// The parts of the shape that depend on the angle around the axis alone.
#[derive(Debug, Clone, Copy)]
struct Around {
    direction: DVec3,
    /// 0 on a lobe's crest, 1 in the groove between two.
    groove: f64,
    oval: f64,
    full: f64,
    slant: f64,
}
