//! The places from which a scan is taken: settings, the camera's poses on its way, and their errors.

use std::f64::consts::PI;

use glam::{DMat3, DQuat, DVec3};
use rand::RngExt;
use rand_distr::StandardNormal;
use serde::{Deserialize, Serialize};

use super::SimulateError;
use super::error::{each_within, within};
use super::random::{Stream, stream};

/// The most views of one scan.
const MOST_VIEWS: usize = 200;

/// The views of a scan, and their fusion to one cloud.
///
/// One view is a depth image of a camera at the origin, a point for each pixel. Several views are taken by a
/// camera on its way around the fruit, as by the paper's `KinFu` (§ 2.1), and fused: the points of
/// all views are brought into the frame of the middle of the way by the camera's poses as far as these are known,
/// and replaced by their means in the cubes of a voxel grid. The middle of the way is the
/// origin and the viewpoint `p_v`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ScanSettings {
    /// The number of depth images, 1 to 200. With one there is no way and no fusion, and all settings below are
    /// without effect. An odd number has a view in the middle of the way.
    pub views: u32,
    /// The whole arc that the camera covers about the vertical through the fruit's center, 0 to 360°: 180 are ±90°.
    /// The distance from the fruit and its place in the image are kept. At 360° the way is closed, and no place is
    /// taken twice.
    pub arc_deg: f64,
    /// The whole arc that the camera covers up and down, 0 to 180°: on its way around the fruit it goes down, up and
    /// down again by half of this, one and a half waves of a sine, as a hand does.
    pub arc_up_deg: f64,
    /// Standard deviation of the error with which the camera's rotation is known, about each of its axes, 0 to 10°.
    /// The errors of views are independent; the view in the middle has none, since it is the frame.
    pub pose_noise_deg: f64,
    /// Standard deviation of the error with which the camera's position is known, along each axis, 0 to 5 cm.
    pub pose_noise_cm: f64,
    /// The edge of the fusion's voxel grid, 0.001 to 5 cm.
    pub voxel_cm: f64,
    /// The camera's poses, which replace number and arcs where there are any: at most 200, in any frame. Only their
    /// relative places count: the cloud's frame is that of the middle one, the last of the first half.
    pub poses: Vec<CameraPose>,
}

impl Default for ScanSettings {
    /// One view. For several, the default is an arc of ±90°, an error of the poses of 0.2° and 0.1 cm, which
    /// puts points at 45 cm about 0.2 cm off, as the poses of `KinFu` do, and a voxel of
    /// 0.2 cm: that of a `KinFu` volume of 512 voxels along a meter.
    fn default() -> Self {
        Self {
            views: 1,
            arc_deg: 180.0,
            arc_up_deg: 0.0,
            pose_noise_deg: 0.2,
            pose_noise_cm: 0.1,
            voxel_cm: 0.2,
            poses: Vec::new(),
        }
    }
}

/// The pose of a camera: `point = orientation · point_in_camera + position_cm`. The camera looks along its z
/// axis; its y axis is down in the image.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CameraPose {
    /// The camera's position.
    pub position_cm: DVec3,
    /// The camera's rotation, a quaternion x, y, z, w, which need not be of unit length.
    pub orientation: DQuat,
}

/// A rigid motion, `point_in_frame = rotation · point_in_camera + position`.
#[derive(Debug, Clone, Copy)]
pub(super) struct View {
    pub(super) rotation: DMat3,
    pub(super) position_cm: DVec3,
}

impl View {
    pub(super) fn to_frame(self, point_in_camera: DVec3) -> DVec3 {
        self.rotation * point_in_camera + self.position_cm
    }

    /// The pose as the scanner knows it, with errors in standard normal deviations.
    fn with_errors(self, [turn, shift]: [DVec3; 2], settings: &ScanSettings) -> Self {
        let turn = DQuat::from_scaled_axis(turn * settings.pose_noise_deg.to_radians());
        Self {
            rotation: self.rotation * DMat3::from_quat(turn),
            position_cm: self.position_cm + shift * settings.pose_noise_cm,
        }
    }
}

impl ScanSettings {
    /// Whether there are several views, which are fused.
    pub fn is_fused(&self) -> bool {
        self.count() > 1
    }

    /// The number of depth images.
    pub fn count(&self) -> usize {
        if self.poses.is_empty() {
            self.views as usize
        } else {
            self.poses.len()
        }
    }

    /// Checks the range of every setting, which NaN is out of.
    pub(super) fn check(&self) -> Result<(), SimulateError> {
        let views = (1.0, MOST_VIEWS as f64);
        within("views", self.views.into(), views, "1 to 200")?;
        within("arc_deg", self.arc_deg, (0.0, 360.0), "0 to 360")?;
        within("arc_up_deg", self.arc_up_deg, (0.0, 180.0), "0 to 180")?;
        within("pose_noise_deg", self.pose_noise_deg, (0.0, 10.0), "0 to 10")?;
        within("pose_noise_cm", self.pose_noise_cm, (0.0, 5.0), "0 to 5")?;
        within("voxel_cm", self.voxel_cm, (1e-3, 5.0), "0.001 to 5")?;
        within(
            "poses",
            self.poses.len() as f64,
            (0.0, MOST_VIEWS as f64),
            "at most 200",
        )?;
        for pose in &self.poses {
            each_within("position_cm", pose.position_cm, (-1e4, 1e4), "-10000 to 10000")?;
            let length = pose.orientation.length();
            within(
                "orientation",
                length,
                (1e-3, 1e3),
                "a quaternion that is not zero",
            )?;
        }
        Ok(())
    }

    /// Computes the true pose of each view in the frame of the middle of the way, where the fruit is at `center_cm`.
    pub(super) fn views(&self, center_cm: DVec3) -> Vec<View> {
        if let Some(middle) = self.poses.get(self.poses.len().saturating_sub(1) / 2) {
            let to_frame = middle.orientation.normalize().inverse();
            let view = |pose: &CameraPose| View {
                rotation: DMat3::from_quat(to_frame * pose.orientation.normalize()),
                position_cm: to_frame * (pose.position_cm - middle.position_cm),
            };
            return self.poses.iter().map(view).collect();
        }
        (0..self.count())
            .map(|i| {
                let along = self.along(i);
                let right = DMat3::from_rotation_y((-self.arc_deg * along).to_radians());
                let up_deg = self.arc_up_deg / 2.0 * (3.0 * PI * along).sin();
                let rotation = right * DMat3::from_rotation_x(-up_deg.to_radians());
                View {
                    rotation,
                    position_cm: center_cm - rotation * center_cm,
                }
            })
            .collect()
    }

    /// The place of a view on the way, −½ to ½. On a closed way the two ends are one place.
    fn along(&self, view: usize) -> f64 {
        let (view, count) = (view as f64, self.count() as f64);
        if self.count() == 1 {
            0.0
        } else if self.arc_deg < 360.0 {
            view / (count - 1.0) - 0.5
        } else {
            (view - (count / 2.0).floor()) / count
        }
    }

    /// The poses as the scanner knows them.
    pub(super) fn known(&self, views: &[View], seed: u64) -> Vec<View> {
        let mut rng = stream(seed, Stream::CameraPoses);
        views
            .iter()
            .map(|view| {
                let mut draw = || DVec3::from_array(std::array::from_fn(|_| rng.sample(StandardNormal)));
                let errors = [draw(), draw()];
                let is_frame = view.rotation == DMat3::IDENTITY && view.position_cm == DVec3::ZERO;
                if is_frame {
                    *view
                } else {
                    view.with_errors(errors, self)
                }
            })
            .collect()
    }
}
