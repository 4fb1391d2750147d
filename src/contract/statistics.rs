//! The counters of bad input.

/// How many values `statistics` counts; see `glsl/include/statistics.glsl`.
pub(crate) const STATISTICS_COUNT: u64 = 8;
