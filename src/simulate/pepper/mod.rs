//! A sweet pepper before a depth camera.

mod body;
mod color;
mod drawn;
mod leaf;
mod peduncle;
mod settings;

use self::drawn::Drawn;
use super::scan::Scene;
use super::{SimulateError, Simulated};

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
    /// The cloud is in centimeters in the camera's frame, with colors and the labels of [`Cloud`]. Of one view it has a
    /// point for each pixel that measured one, row by row, and no normals, which a camera does not measure. Of
    /// several it has a point for each occupied voxel, with normals turned towards the cameras that saw it, in the frame
    /// of the middle view. A leaf keeps its place between the middle view and the fruit; in each view it is cropped to
    /// the rectangle of the image that the fruit takes up, as a detector's box would.
    ///
    /// [`Cloud`]: crate::geometry::Cloud
    ///
    /// # Errors
    /// Returns an error if a setting is out of range, or the camera sees nothing of the fruit.
    pub fn simulate(&self) -> Result<Simulated, SimulateError> {
        self.check()?;
        let drawn = Drawn::new(self)?;
        let camera = &self.camera;
        let mut scene = Scene::new(drawn.fruit_in_camera());
        let mut hidden_by_leaf = None;
        if self.leaf_cover > 0.0 {
            let image = scene.fruit_in_middle_view(camera);
            if image.covered() == 0 {
                return Err(SimulateError::NothingVisible);
            }
            let (leaf, hidden) = drawn.leaf.covering(self.leaf_cover, camera, &image, &drawn.paint);
            scene.add_leaf(&leaf);
            hidden_by_leaf = Some(hidden);
        }
        let scanned = scene.scan(camera, &self.scan, drawn.center_cm, self.seed)?;
        let mut truth = drawn.into_truth(hidden_by_leaf);
        truth.coverage = scanned.coverage;
        Ok(Simulated {
            cloud: scanned.cloud,
            truth,
        })
    }
}
