//! The settings of an analysis, independent of the cloud.

use serde::{Deserialize, Serialize};

use super::{Fruit, PeduncleChoice};
use crate::estimate::EstimateSettings;
use crate::geometry::Unit;
use crate::method::{NormalSource, Params, Preset};

/// The settings of an analysis, before anything is known of the cloud. [`Request::params`] completes them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Request {
    /// The unit of the coordinates; `None` for the one that the file states, or else a guess.
    pub unit: Option<Unit>,
    /// The source of the peduncle.
    pub peduncle: PeduncleChoice,
    /// Whether the peduncle's points are left out of the analysis.
    pub without_peduncle: bool,
    /// The source of normals; `None` for the file's, or else an estimate.
    pub normals: Option<NormalSource>,
    /// All other parameters. Their unit and source of normals are replaced by [`Request::params`].
    pub params: Params,
    /// The estimators to run beside the analysis; none by default.
    #[serde(default, skip_serializing_if = "is_empty")]
    pub estimates: EstimateSettings,
}

/// Whether no estimator is asked for. Such requests are stored as before there were any.
fn is_empty(settings: &EstimateSettings) -> bool {
    settings.estimators.is_empty()
}

impl Default for Request {
    /// The paper as intended: unit, peduncle and normals as far as the files tell them.
    fn default() -> Self {
        Self {
            unit: None,
            peduncle: PeduncleChoice::Auto,
            without_peduncle: false,
            normals: None,
            params: Params::new(Preset::AsIntended, Unit::Centimeter),
            estimates: EstimateSettings::default(),
        }
    }
}

impl Request {
    /// The parameters for this fruit, with its unit and its source of normals.
    pub fn params(&self, fruit: &Fruit) -> Params {
        let available = || match fruit.cloud().normals() {
            Some(_) => NormalSource::File,
            None => NormalSource::Estimate,
        };
        Params {
            unit: fruit.unit,
            normals: self.normals.unwrap_or_else(available),
            ..self.params.clone()
        }
    }
}
