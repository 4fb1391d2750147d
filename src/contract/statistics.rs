//! The counters of bad input.

/// Number of counters in `statistics`; see `glsl/include/statistics.glsl`.
pub(crate) const STATISTICS_COUNT: u64 = 12;
