//! The probability that an axis is right, from the lead over its rivals and the misfit of its body.

/// The lead of an axis without a rival.
const NO_RIVAL: f64 = 60.0;

/// Returns the probability that the axis is within 15° of the true one, 0 to 1, by a logistic model. `lead` is the cost's
/// over the best axis more than 20° away, `None` without one; `rms` is that of the misfits in units of the fruit's size.
pub(super) fn confidence(lead: Option<f64>, rms: f64) -> f64 {
    let lead = lead.unwrap_or(NO_RIVAL).max(0.0);
    let logit = 2.233 + 0.778 * lead.ln_1p() - 146.0 * rms;
    1.0 / (1.0 + (-logit).exp())
}

/// Whether an axis should not be relied on.
pub(super) fn is_ambiguous(lead: Option<f64>, confidence: f64) -> bool {
    confidence < 0.8 || lead.is_some_and(|lead| lead < 3.0)
}
