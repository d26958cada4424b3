//! A sweet pepper before a depth camera.

mod body;
mod color;
mod drawn;
mod leaf;
mod peduncle;
mod settings;

use self::drawn::Drawn;
use super::depth_camera::Measured;
use super::random::{Stream, stream};
use super::{SimulateError, Simulated};
use crate::geometry::Cloud;

pub use self::color::FruitColor;
pub use self::settings::PepperSettings;

impl PepperSettings {
    /// The same settings with everything drawn that was open.
    ///
    /// # Errors
    /// Returns an error if a setting is out of range.
    pub fn drawn(&self) -> Result<Self, SimulateError> {
        self.check()?;
        Ok(Drawn::new(self)?.into_settings())
    }

    /// Draws the settings that are open, builds the fruit, and measures it by the camera.
    ///
    /// The cloud is in centimeters in the camera's frame, a point for each pixel that measured one,
    /// row by row, with colors and the labels of [`Cloud`], but without normals, which a camera does not measure.
    /// A leaf is cropped to the rectangle of the image that the fruit takes up, as a detector's box would.
    ///
    /// # Errors
    /// Returns an error if a setting is out of range, or the camera sees nothing of the fruit.
    pub fn simulate(&self) -> Result<Simulated, SimulateError> {
        self.check()?;
        let drawn = Drawn::new(self)?;
        let camera = &self.camera;
        let mut scene = drawn.fruit_in_camera();
        let mut image = camera.look(&scene);
        if image.covered() == 0 {
            return Err(SimulateError::NothingVisible);
        }
        let mut hidden_by_leaf = None;
        if self.leaf_cover > 0.0 {
            let (leaf, hidden) = drawn.leaf.covering(self.leaf_cover, camera, &image, &drawn.paint);
            let before = scene.triangles.len();
            scene.append(&leaf);
            let around_fruit = image.bounds();
            camera.look_on(&scene, before, &mut image);
            image.crop(around_fruit);
            hidden_by_leaf = Some(hidden);
        }
        let measured = camera.measure(&scene, &image, &mut stream(self.seed, Stream::Camera));
        if !measured.iter().any(|m| m.label == Cloud::FRUIT) {
            return Err(SimulateError::NothingVisible);
        }
        Ok(Simulated {
            cloud: cloud_of(&measured),
            truth: drawn.into_truth(hidden_by_leaf),
        })
    }
}

/// Makes a cloud of the measured points.
///
/// # Panics
/// Never: each point brings its own color and label.
fn cloud_of(measured: &[Measured]) -> Cloud {
    const LENGTHS: &str = "a color and a label for each point";
    // Clamped to bytes before they become whole.
    let byte = |channel: f32| channel.round().clamp(0.0, 255.0) as u8;
    let colors = measured.iter().map(|m| {
        let [r, g, b] = m.color.to_array().map(byte);
        [r, g, b, u8::MAX]
    });
    Cloud::new(measured.iter().map(|m| m.point_in_camera).collect())
        .with_colors(colors.collect())
        .expect(LENGTHS)
        .with_labels(measured.iter().map(|m| m.label).collect())
        .expect(LENGTHS)
}
