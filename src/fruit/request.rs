//! What is asked of a cloud, before anything is known of it.

use serde::{Deserialize, Serialize};

use super::{Fruit, PeduncleChoice};
use crate::geometry::{Cloud, Unit};
use crate::method::{NormalSource, Params, Preset};

/// What to do with a cloud, before anything is known of it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Request {
    /// The unit of its coordinates; `None` as the file states it, else guessed.
    pub unit: Option<Unit>,
    /// Where its peduncle is.
    pub peduncle: PeduncleChoice,
    /// Whether the peduncle's points are left out of the analysis.
    pub without_peduncle: bool,
    /// Where normals come from; `None` from the file where it has them.
    pub normals: Option<NormalSource>,
    /// Everything else. Its unit and source of normals are not looked at.
    pub params: Params,
}

impl Default for Request {
    /// Returns the preset "as intended", with the unit, the peduncle and the normals that the file has.
    fn default() -> Self {
        Self {
            unit: None,
            peduncle: PeduncleChoice::Auto,
            without_peduncle: false,
            normals: None,
            params: Params::new(Preset::AsIntended, Unit::Centimeter),
        }
    }
}

impl Request {
    /// The parameters for this fruit: what was left open is settled.
    pub fn params(&self, fruit: &Fruit) -> Params {
        let of_file = |cloud: &Cloud| match cloud.normals() {
            Some(_) => NormalSource::File,
            None => NormalSource::Estimate,
        };
        Params {
            unit: fruit.unit,
            normals: self.normals.unwrap_or_else(|| of_file(fruit.cloud())),
            ..self.params.clone()
        }
    }
}
