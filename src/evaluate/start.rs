//! The axes that an annotator may start from.

use crate::annotate::{Ends, EndsError, Method};
use crate::fruit::Fruit;
use crate::geometry::{strays, without};
use crate::method::{Analysis, AxisEstimate, AxisSource};

/// The reason why there is no axis to start from. A clause.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum StartError {
    /// No peduncle is known, or it has no axis.
    #[error("there is no peduncle's axis to start from")]
    NoPeduncle,
    /// The method found no axis.
    #[error("there is no computed axis to start from")]
    NoAxis,
    /// The annotation method has no axis to start from.
    #[error("an axis set by hand starts from nothing")]
    Nothing,
    /// The fruit has no extent along the axis.
    #[error("the fruit has no extent along the axis to start from: {0}")]
    Ends(#[from] EndsError),
}

/// Returns the axis that an annotator starts from, as long as the fruit's body: that of the peduncle
/// ([`Method::FromPeduncle`]) or the computed one ([`Method::FromComputed`]). The computed axis has no sense of
/// direction: it is turned toward the peduncle if one is known, else up in the camera's frame, which is −y.
///
/// # Errors
/// Returns an error if there is no such axis.
pub fn start_axis(
    fruit: &Fruit,
    analysis: &Analysis,
    references: &[AxisEstimate],
    method: Method,
) -> Result<Ends, StartError> {
    let (origin, direction) = match method {
        Method::FromPeduncle => {
            let axis = references.iter().find(|axis| axis.source == AxisSource::Peduncle);
            let axis = axis.ok_or(StartError::NoPeduncle)?;
            (axis.origin, axis.direction)
        }
        Method::FromComputed => {
            let axis = analysis.axis.as_ref().ok_or(StartError::NoAxis)?;
            let toward_peduncle = match &fruit.peduncle {
                Some(peduncle) => (peduncle.mean - axis.origin).dot(axis.direction),
                None => -axis.direction.y,
            };
            (axis.origin, axis.direction * toward_peduncle.signum())
        }
        Method::ByHand | Method::Imported => return Err(StartError::Nothing),
    };
    // Strays would lengthen it.
    let body = fruit.body();
    let strays = strays(body.positions());
    let kept: Vec<_> = without(&strays, body.len())
        .map(|i| body.positions()[i])
        .collect();
    Ok(Ends::spanning(&kept, origin, direction)?)
}
