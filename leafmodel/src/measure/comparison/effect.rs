//! The size of a difference.

/// Share of all samples whose interval does not hold the truth.
pub(super) const OUTSIDE: f64 = 0.05;

/// The size of a difference.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Effect {
    /// The estimate; positive if the second group has the larger values.
    pub value: f64,
    /// Ends of its 95 % interval.
    #[serde(rename = "interval_95")]
    pub interval: [f64; 2],
}
