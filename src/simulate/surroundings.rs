//! The surroundings of a simulated fruit: peduncle, pose, leaf and camera, which are drawn and checked alike for all fruits.

use glam::{DMat3, DVec3};
use rand::{Rng, RngExt};
use serde::{Deserialize, Serialize};

use super::error::{each_within, set_within, within};
use super::mesh::Mesh;
use super::random::{Stream, set_or_draw, stream};
use super::scan::Scene;
use super::shape::{Leaf, Paint, Peduncle};
use super::{DepthCamera, Pose, ScanSettings, Settings, SimulateError, Simulated, TrueAxis, Truth};
use crate::geometry::Unit;

/// A fruit's peduncle and pose, the leaf before it, and the camera. The seed draws each field that is `None`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Surroundings {
    /// Length of the peduncle along its curve, from its calyx; settable from 0.5 to 20 cm.
    pub peduncle_length_cm: Option<f64>,
    /// Its thickness, settable from 0.1 to 5 cm.
    pub peduncle_width_cm: Option<f64>,
    /// The angle between the fruit's axis and the peduncle's free end; drawn from 10 to 50, settable from 0 to 120°.
    pub peduncle_bend_deg: Option<f64>,
    /// The direction that the peduncle bends to, around the fruit's axis; drawn from 0 to 360, settable from -360 to 360°.
    pub peduncle_bend_towards_deg: Option<f64>,
    /// The largest lean towards the camera or away that is drawn, 0 to 90°.
    pub max_tilt_towards_camera_deg: f64,
    /// The largest lean to a side that is drawn, 0 to 180°.
    pub max_tilt_sideways_deg: f64,
    /// The lean of the stem end out of the image plane, positive towards the camera; -90 to 90°.
    pub tilt_towards_camera_deg: Option<f64>,
    /// The lean of the axis, as the image shows it, from image-up to the right; -180 to 180°.
    pub tilt_sideways_deg: Option<f64>,
    /// The turn about the fruit's own axis; drawn from 0 to 360, settable from -360 to 360°.
    pub spin_deg: Option<f64>,
    /// The nearest and farthest depth of the fruit's center that are drawn, in the camera's range.
    pub distance_cm: [f64; 2],
    /// The fruit's center in the camera's frame; drawn so that the whole fruit is in the image.
    pub center_cm: Option<DVec3>,
    /// The share of the fruit (peduncle included) that a leaf before it hides, 0 to 0.9; 0 for no leaf.
    /// The truth holds the share that it does hide.
    pub leaf_cover: f64,
    /// The camera.
    pub camera: DepthCamera,
    /// The views that are taken and fused.
    pub scan: ScanSettings,
}

impl Default for Surroundings {
    /// A fruit upright to within 25° both ways, 30 to 60 cm ahead, with nothing before it.
    fn default() -> Self {
        Self {
            peduncle_length_cm: None,
            peduncle_width_cm: None,
            peduncle_bend_deg: None,
            peduncle_bend_towards_deg: None,
            max_tilt_towards_camera_deg: 25.0,
            max_tilt_sideways_deg: 25.0,
            tilt_towards_camera_deg: None,
            tilt_sideways_deg: None,
            spin_deg: None,
            distance_cm: [30.0, 60.0],
            center_cm: None,
            leaf_cover: 0.0,
            camera: DepthCamera::default(),
            scan: ScanSettings::default(),
        }
    }
}

/// The lengths that the place of a fruit in the image depends on.
#[derive(Debug, Clone, Copy)]
pub(super) struct Reach {
    /// The radius of a ball around the center that holds the body.
    pub(super) ball_cm: f64,
    /// The factor of that radius within which no camera may be; irregular fruits reach out a little farther.
    pub(super) margin: f64,
}

/// A rotation and a center.
#[derive(Debug, Clone, Copy)]
pub(super) struct Placement {
    pub(super) camera_from_fruit: DMat3,
    pub(super) center_cm: DVec3,
}

const TURN: (f64, f64) = (-360.0, 360.0);

impl Surroundings {
    /// Checks the range of every setting, which NaN is out of.
    pub(super) fn check(&self) -> Result<(), SimulateError> {
        self.camera.check()?;
        self.scan.check()?;
        let set = set_within;
        let length = (0.5, 20.0);
        set("peduncle_length_cm", self.peduncle_length_cm, length, "0.5 to 20")?;
        let width = (0.1, 5.0);
        set("peduncle_width_cm", self.peduncle_width_cm, width, "0.1 to 5")?;
        let bend = (0.0, 120.0);
        set("peduncle_bend_deg", self.peduncle_bend_deg, bend, "0 to 120")?;
        let towards = self.peduncle_bend_towards_deg;
        set("peduncle_bend_towards_deg", towards, TURN, "-360 to 360")?;
        let (most, quarter) = (self.max_tilt_towards_camera_deg, (0.0, 90.0));
        within("max_tilt_towards_camera_deg", most, quarter, "0 to 90")?;
        let (most, half) = (self.max_tilt_sideways_deg, (0.0, 180.0));
        within("max_tilt_sideways_deg", most, half, "0 to 180")?;
        let (tilt, quarter) = (self.tilt_towards_camera_deg, (-90.0, 90.0));
        set("tilt_towards_camera_deg", tilt, quarter, "-90 to 90")?;
        let (tilt, half) = (self.tilt_sideways_deg, (-180.0, 180.0));
        set("tilt_sideways_deg", tilt, half, "-180 to 180")?;
        set("spin_deg", self.spin_deg, TURN, "-360 to 360")?;
        let (near, far) = (self.camera.near_cm, self.camera.far_cm);
        let [nearest, farthest] = self.distance_cm;
        within("distance_cm[0]", nearest, (near, far), "in the camera's range")?;
        let (beyond, allowed) = ((nearest, far), "at least the first and in the camera's range");
        within("distance_cm[1]", farthest, beyond, allowed)?;
        if let Some(center) = self.center_cm {
            each_within("center_cm", center, (-1000.0, 1000.0), "-1000 to 1000")?;
            within("center_cm.z", center.z, (near, far), "in the camera's range")?;
        }
        within("leaf_cover", self.leaf_cover, (0.0, 0.9), "0 to 0.9")
    }

    /// Draws the peduncle's open settings and keeps them; `base_cm` is the height of its base over the fruit's
    /// center, and the ranges are those of its length and width.
    pub(super) fn draw_peduncle(
        &mut self,
        base_cm: f64,
        [length, width]: [(f64, f64); 2],
        rng: &mut impl Rng,
    ) -> Peduncle {
        let mut draw = |set: &mut Option<f64>, (low, high)| {
            let value = set_or_draw(*set, rng, low, high);
            *set = Some(value);
            value
        };
        Peduncle {
            base_cm,
            length_cm: draw(&mut self.peduncle_length_cm, length),
            width_cm: draw(&mut self.peduncle_width_cm, width),
            bend_deg: draw(&mut self.peduncle_bend_deg, (10.0, 50.0)),
            bend_towards_deg: draw(&mut self.peduncle_bend_towards_deg, (0.0, 360.0)),
        }
    }

    /// Draws the pose's open settings and keeps them.
    ///
    /// # Errors
    /// Returns an error if the camera is inside the fruit.
    pub(super) fn place(
        &mut self,
        seed: u64,
        reach: Reach,
        peduncle: &Peduncle,
    ) -> Result<Placement, SimulateError> {
        let rng = &mut stream(seed, Stream::Pose);
        let mut up_to = |set, most: f64| set_or_draw(set, rng, -most, most);
        let towards_camera = up_to(self.tilt_towards_camera_deg, self.max_tilt_towards_camera_deg);
        let sideways = up_to(self.tilt_sideways_deg, self.max_tilt_sideways_deg);
        let spin = set_or_draw(self.spin_deg, rng, 0.0, 360.0);
        self.tilt_towards_camera_deg = Some(towards_camera);
        self.tilt_sideways_deg = Some(sideways);
        self.spin_deg = Some(spin);
        let center_cm = self.draw_center(reach.ball_cm, peduncle, rng);
        self.center_cm = Some(center_cm);
        // A camera inside would see the skin's inner side.
        let ball_cm = reach.ball_cm * reach.margin;
        let views = self.scan.views(center_cm);
        let mut cameras = views.into_iter().map(|view| view.position_cm);
        if center_cm.length() <= ball_cm || cameras.any(|camera| camera.distance(center_cm) <= ball_cm) {
            return Err(SimulateError::ViewpointInside);
        }
        // Spin about the fruit's own axis, half a turn from the fruit's y up to the image's y down, then
        // towards the camera, then sideways: in this order the two tilts are what the settings say,
        // an angle out of the image plane and an angle within it.
        let camera_from_fruit = DMat3::from_rotation_z(sideways.to_radians())
            * DMat3::from_rotation_x(towards_camera.to_radians())
            * DMat3::from_diagonal(DVec3::new(1.0, -1.0, -1.0))
            * DMat3::from_rotation_y(spin.to_radians());
        Ok(Placement {
            camera_from_fruit,
            center_cm,
        })
    }

    /// Draws a position at a depth in the wanted range such that a ball around the fruit, and another around
    /// its peduncle, lie within the image.
    fn draw_center(&self, ball: f64, peduncle: &Peduncle, rng: &mut impl Rng) -> DVec3 {
        let [right, down, ahead] = rng.random::<[f64; 3]>();
        let [nearest, farthest] = self.distance_cm;
        let depth = nearest + (farthest - nearest) * ahead;
        // Upright or nearly so, the peduncle needs room above; leaning, it needs less there and finds it
        // at the sides, which are wider.
        let above = ball.max(peduncle.base_cm + peduncle.length_cm);
        let half_view = self.camera.half_view() * (depth - ball).max(0.0);
        let side = (half_view.x - ball).max(0.0);
        let (top, bottom) = ((half_view.y - above).max(0.0), (half_view.y - ball).max(0.0));
        let drawn = DVec3::new(side * (2.0 * right - 1.0), (top + bottom) * down - top, depth);
        self.center_cm.unwrap_or(drawn)
    }

    /// Measures a fruit whose mesh is in the camera's frame, with a leaf before it if one is asked for, and adds what was
    /// measured to the truth about it.
    ///
    /// # Errors
    /// Returns an error if the camera sees nothing of the fruit.
    pub(super) fn measure(
        &self,
        mesh: Mesh,
        paint: &Paint,
        mut truth: Truth,
    ) -> Result<Simulated, SimulateError> {
        let (camera, seed) = (&self.camera, truth.seed);
        let mut scene = Scene::new(mesh);
        if self.leaf_cover > 0.0 {
            let image = scene.fruit_in_middle_view(camera);
            if image.covered() == 0 {
                return Err(SimulateError::NothingVisible);
            }
            let leaf = Leaf::draw(&mut stream(seed, Stream::Leaf));
            let (leaf, hidden) = leaf.covering(self.leaf_cover, camera, &image, paint);
            scene.add_leaf(&leaf);
            truth.hidden_by_leaf = Some(hidden);
        }
        let scanned = scene.scan(camera, &self.scan, truth.center, seed)?;
        truth.coverage = scanned.coverage;
        Ok(Simulated {
            cloud: scanned.cloud,
            truth,
        })
    }
}

impl Placement {
    /// The truth about a fruit of this place whose axis leaves it `half_length_cm` from its center at either end.
    pub(super) fn truth(self, half_length_cm: f64, seed: u64, settings: Settings) -> Truth {
        let direction = self.camera_from_fruit * DVec3::Y;
        let to_stem_end = direction * half_length_cm;
        Truth {
            schema: Truth::SCHEMA.into(),
            program_version: env!("CARGO_PKG_VERSION").into(),
            unit: Unit::Centimeter,
            seed,
            axis: TrueAxis {
                origin: self.center_cm,
                direction,
            },
            revolution_axis: None,
            note: None,
            center: self.center_cm,
            stem_end: self.center_cm + to_stem_end,
            blossom_end: self.center_cm - to_stem_end,
            pose: Pose::new(self.camera_from_fruit, self.center_cm),
            viewpoint: DVec3::ZERO,
            without_peduncle: false,
            hidden_by_leaf: None,
            coverage: None,
            settings,
        }
    }
}
