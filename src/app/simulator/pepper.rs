//! A simulated pepper as the source of a cloud.

use std::hash::{Hash, Hasher};
use std::path::Path;
use std::sync::Arc;

use sha2::{Digest, Sha256};

use crate::fruit::{CloudFile, ReadError};
use crate::geometry::Unit;
use crate::ply::PlyCloud;
use crate::simulate::PepperSettings;

/// The settings of a simulated pepper as the source of a cloud. Two are the same if their settings are.
#[derive(Debug, Clone)]
pub struct SimulatedPepper {
    settings: Arc<PepperSettings>,
    /// The settings as text, which can be compared and hashed.
    text: Arc<str>,
}

impl SimulatedPepper {
    pub(super) fn new(settings: Arc<PepperSettings>) -> Self {
        Self {
            // Without a failure: settings are plain numbers.
            text: serde_json::to_string(&*settings).unwrap_or_default().into(),
            settings,
        }
    }

    /// Whether it was made of these very settings, and not of equal ones.
    pub(super) fn is_of(&self, settings: &Arc<PepperSettings>) -> bool {
        Arc::ptr_eq(&self.settings, settings)
    }

    /// Its settings.
    pub fn settings(&self) -> &PepperSettings {
        &self.settings
    }

    /// Simulates it: the cloud as a file at `path` would hold it, and its truth as text.
    ///
    /// # Errors
    /// Returns an error if the camera sees nothing of the fruit.
    pub(in crate::app) fn read(&self, path: &Path) -> Result<(CloudFile, Option<Arc<str>>), ReadError> {
        let simulated = self.settings.simulate().map_err(|error| ReadError {
            path: path.to_owned(),
            kind: error.into(),
        })?;
        // Without a failure: a truth is plain numbers.
        let truth = serde_json::to_string(&simulated.truth).ok().map(Into::into);
        let file = CloudFile {
            path: path.to_owned(),
            // The settings make the bytes that a file would have.
            sha256: hex::encode(Sha256::digest(self.text.as_bytes())),
            ply: PlyCloud {
                cloud: simulated.cloud,
                dropped_not_finite: 0,
                stated_unit: Some(Unit::Centimeter),
                notes: Vec::new(),
            },
        };
        Ok((file, truth))
    }
}

impl PartialEq for SimulatedPepper {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.text, &other.text) || self.text == other.text
    }
}

impl Eq for SimulatedPepper {}

impl Hash for SimulatedPepper {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.text.hash(state);
    }
}
