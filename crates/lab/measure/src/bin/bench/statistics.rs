//! The middle and both ends of samples.

use serde::{Deserialize, Serialize};

/// Median, 95th percentile and the least.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Spread {
    pub median: f64,
    pub p95: f64,
    /// 0 in figures of a version that did not write it.
    #[serde(default)]
    pub least: f64,
}

impl Spread {
    /// Those of at least one sample.
    pub fn of(samples: &[f64]) -> Self {
        let mut sorted = samples.to_vec();
        sorted.sort_by(f64::total_cmp);
        // The nearest rank: a value that was measured.
        let rank = |share: f64| sorted.get(((share * sorted.len() as f64).ceil() as usize).max(1) - 1).copied().unwrap_or(f64::NAN);
        Self { median: rank(0.5), p95: rank(0.95), least: rank(0.0) }
    }

    /// Takes a constant part off; never below 0.
    pub fn less(self, constant: f64) -> Self {
        let [median, p95, least] = [self.median, self.p95, self.least].map(|value| (value - constant).max(0.0));
        Self { median, p95, least }
    }
}
