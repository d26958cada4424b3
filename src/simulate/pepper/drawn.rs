//! A pepper with nothing left to chance: the properties that were set, and those drawn by its seed.

use glam::{DMat3, DVec3};
use rand::{Rng, RngExt};
use rand_chacha::ChaCha8Rng;

use super::FruitColor;
use super::PepperSettings;
use super::body::{Asymmetry, Body};
use super::color::Paint;
use super::leaf::Leaf;
use super::peduncle::Peduncle;
use crate::geometry::Unit;
use crate::simulate::error::within;
use crate::simulate::mesh::Mesh;
use crate::simulate::random::{Stream, set_or_draw, stream};
use crate::simulate::{Pose, Settings, SimulateError, TrueAxis, Truth};

/// One pepper, its place and its surroundings.
#[derive(Debug, Clone)]
pub(super) struct Drawn {
    /// The settings, every one of which is set.
    settings: PepperSettings,
    body: Body,
    peduncle: Peduncle,
    camera_from_fruit: DMat3,
    pub(super) center_cm: DVec3,
    pub(super) paint: Paint,
    pub(super) leaf: Leaf,
}

impl Drawn {
    /// Draws everything that is not set. The streams and the order of their draws are part of the format:
    /// another order gives another pepper for the same seed.
    pub(super) fn new(wanted: &PepperSettings) -> Result<Self, SimulateError> {
        let seed = wanted.seed;
        let mut shape = stream(seed, Stream::Shape);
        let body = draw_body(wanted, &mut shape)?;
        let peduncle = draw_peduncle(wanted, &body, &mut shape);
        let mut pose = stream(seed, Stream::Pose);
        let tilt = Tilt::draw(wanted, &mut pose);
        let center_cm = draw_center(wanted, &body, &peduncle, &mut pose);
        // A camera inside would see the skin's inner side. Irregular fruits reach out a little farther.
        let ball_cm = body.ball_cm() * (1.0 + 2.0 * wanted.asymmetry);
        let mut cameras = wanted
            .scan
            .views(center_cm)
            .into_iter()
            .map(|view| view.position_cm);
        if center_cm.length() <= ball_cm || cameras.any(|camera| camera.distance(center_cm) <= ball_cm) {
            return Err(SimulateError::ViewpointInside);
        }
        let mut colors = stream(seed, Stream::Color);
        let drawn_color = FruitColor::ALL[colors.random_range(0..FruitColor::ALL.len())];
        let color = wanted.color.unwrap_or(drawn_color);
        let settings = PepperSettings {
            seed,
            height_cm: Some(body.half_height_cm * 2.0),
            width_cm: Some(body.half_width_cm * 2.0),
            lobes: Some(body.lobes),
            lobe_depth: Some(body.lobe_depth),
            taper: Some(body.taper),
            dimple_cm: Some(body.dimple_cm),
            asymmetry: wanted.asymmetry,
            color: Some(color),
            peduncle_length_cm: Some(peduncle.length_cm),
            peduncle_width_cm: Some(peduncle.width_cm),
            peduncle_bend_deg: Some(peduncle.bend_deg),
            peduncle_bend_towards_deg: Some(peduncle.bend_towards_deg),
            max_tilt_towards_camera_deg: wanted.max_tilt_towards_camera_deg,
            max_tilt_sideways_deg: wanted.max_tilt_sideways_deg,
            tilt_towards_camera_deg: Some(tilt.towards_camera),
            tilt_sideways_deg: Some(tilt.sideways),
            spin_deg: Some(tilt.spin),
            distance_cm: wanted.distance_cm,
            center_cm: Some(center_cm),
            leaf_cover: wanted.leaf_cover,
            camera: wanted.camera.clone(),
            scan: wanted.scan.clone(),
        };
        Ok(Self {
            settings,
            body,
            peduncle,
            camera_from_fruit: tilt.camera_from_fruit(),
            center_cm,
            paint: Paint::draw(color, &mut colors),
            leaf: Leaf::draw(&mut stream(seed, Stream::Leaf)),
        })
    }

    /// Body and peduncle where they are, in centimeters in the camera's frame.
    pub(super) fn fruit_in_camera(&self) -> Mesh {
        let mut mesh = self.body.mesh(&self.paint);
        mesh.append(&self.peduncle.mesh(&self.paint));
        mesh.moved(self.camera_from_fruit, self.center_cm)
    }

    /// The settings, every one of which is set.
    pub(super) fn into_settings(self) -> PepperSettings {
        self.settings
    }

    /// The truth about it.
    pub(super) fn into_truth(self, hidden_by_leaf: Option<f64>) -> Truth {
        let direction = self.camera_from_fruit * DVec3::Y;
        let to_stem_end = direction * self.body.half_height_cm;
        Truth {
            schema: Truth::SCHEMA.into(),
            program_version: env!("CARGO_PKG_VERSION").into(),
            unit: Unit::Centimeter,
            seed: self.settings.seed,
            axis: TrueAxis {
                origin: self.center_cm,
                direction,
            },
            revolution_axis: None,
            note: (self.settings.asymmetry > 0.0).then(|| {
                "The axis is the one the fruit was built around; the fruit departs from it \
                 slightly, as real ones do (see asymmetry)."
                    .into()
            }),
            center: self.center_cm,
            stem_end: self.center_cm + to_stem_end,
            blossom_end: self.center_cm - to_stem_end,
            pose: Pose::new(self.camera_from_fruit, self.center_cm),
            viewpoint: DVec3::ZERO,
            without_peduncle: false,
            hidden_by_leaf,
            coverage: None,
            settings: Settings::Pepper(Box::new(self.settings)),
        }
    }
}

fn draw_body(wanted: &PepperSettings, rng: &mut ChaCha8Rng) -> Result<Body, SimulateError> {
    let height_cm = set_or_draw(wanted.height_cm, rng, 7.0, 11.0);
    let width_cm = set_or_draw(wanted.width_cm, rng, 0.75 * height_cm, 0.95 * height_cm);
    let drawn_lobes = rng.random_range(3..=4);
    let lobe_depth = set_or_draw(wanted.lobe_depth, rng, 0.08, 0.16);
    let taper = set_or_draw(wanted.taper, rng, 0.1, 0.35);
    let dimple_cm = set_or_draw(wanted.dimple_cm, rng, 0.1 * height_cm, 0.15 * height_cm);
    let deepest = (0.0, height_cm / 4.0);
    within("dimple_cm", dimple_cm, deepest, "0 to a quarter of height_cm")?;
    let mut irregular = stream(wanted.seed, Stream::Asymmetry);
    Ok(Body {
        half_height_cm: height_cm / 2.0,
        half_width_cm: width_cm / 2.0,
        lobes: wanted.lobes.unwrap_or(drawn_lobes),
        lobe_depth,
        taper,
        dimple_cm,
        asymmetry: Asymmetry::draw(wanted.asymmetry, &mut irregular),
    })
}

fn draw_peduncle(wanted: &PepperSettings, body: &Body, rng: &mut ChaCha8Rng) -> Peduncle {
    Peduncle {
        base_cm: body.calyx_cm(),
        length_cm: set_or_draw(wanted.peduncle_length_cm, rng, 3.5, 5.0),
        width_cm: set_or_draw(wanted.peduncle_width_cm, rng, 0.7, 0.95),
        bend_deg: set_or_draw(wanted.peduncle_bend_deg, rng, 10.0, 50.0),
        bend_towards_deg: set_or_draw(wanted.peduncle_bend_towards_deg, rng, 0.0, 360.0),
    }
}

/// The rotation of a fruit away from upright, in degrees as in the settings.
#[derive(Debug, Clone, Copy)]
struct Tilt {
    towards_camera: f64,
    sideways: f64,
    spin: f64,
}

impl Tilt {
    fn draw(wanted: &PepperSettings, rng: &mut impl Rng) -> Self {
        let mut up_to = |set, most: f64| set_or_draw(set, rng, -most, most);
        Self {
            towards_camera: up_to(wanted.tilt_towards_camera_deg, wanted.max_tilt_towards_camera_deg),
            sideways: up_to(wanted.tilt_sideways_deg, wanted.max_tilt_sideways_deg),
            spin: set_or_draw(wanted.spin_deg, rng, 0.0, 360.0),
        }
    }

    /// Spin about the fruit's own axis, half a turn from the fruit's y up to the image's y down, then
    /// towards the camera, then sideways: in this order the two tilts are what the settings say,
    /// an angle out of the image plane and an angle within it.
    fn camera_from_fruit(&self) -> DMat3 {
        DMat3::from_rotation_z(self.sideways.to_radians())
            * DMat3::from_rotation_x(self.towards_camera.to_radians())
            * DMat3::from_diagonal(DVec3::new(1.0, -1.0, -1.0))
            * DMat3::from_rotation_y(self.spin.to_radians())
    }
}

/// Draws a position at a depth in the wanted range such that a ball around the fruit, and another around
/// its peduncle, lie within the image.
fn draw_center(wanted: &PepperSettings, body: &Body, peduncle: &Peduncle, rng: &mut impl Rng) -> DVec3 {
    let [right, down, ahead] = rng.random::<[f64; 3]>();
    let [nearest, farthest] = wanted.distance_cm;
    let depth = nearest + (farthest - nearest) * ahead;
    let ball = body.ball_cm();
    // Upright or nearly so, the peduncle needs room above; leaning, it needs less there and finds it
    // at the sides, which are wider.
    let above = ball.max(peduncle.base_cm + peduncle.length_cm);
    let half_view = wanted.camera.half_view() * (depth - ball).max(0.0);
    let side = (half_view.x - ball).max(0.0);
    let (top, bottom) = ((half_view.y - above).max(0.0), (half_view.y - ball).max(0.0));
    let drawn = DVec3::new(side * (2.0 * right - 1.0), (top + bottom) * down - top, depth);
    wanted.center_cm.unwrap_or(drawn)
}
