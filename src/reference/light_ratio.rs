//! How far a history is true again once it is scaled by the ratio of light.

/// Light grows by this factor at most.
pub(crate) const LARGEST_RATIO: f32 = 64.0;

/// Share of the brightest component, below which a component has no ratio of its own.
const RATIO_FLOOR: f32 = 1e-3;

/// Light that is added to both sides of a ratio.
pub(crate) fn floor_of_ratio(before: [f32; 3]) -> f32 {
    RATIO_FLOOR * before.into_iter().fold(0.0, f32::max) + 1e-6
}

/// Relative spreads of a ratio among the samples of a place: below the first it is none, above the second there is no ratio. Samples may
/// differ, as long as their mean is known.
const SAMPLE_SPREADS: [f32; 2] = [0.2, 0.5];

/// The same between strata.
const STRATUM_SPREADS: [f32; 2] = [0.1, 0.3];

/// 1, true, to 0, by the spread among the samples of a place.
pub(crate) fn sample_coherence(spread: f32) -> f32 {
    coherence_of(spread, SAMPLE_SPREADS)
}

/// 1, true, to 0, by the difference between strata.
pub(crate) fn stratum_coherence(difference: f32) -> f32 {
    coherence_of(difference, STRATUM_SPREADS)
}

fn coherence_of(spread: f32, [none, all]: [f32; 2]) -> f32 {
    ((all - spread) / (all - none)).clamp(0.0, 1.0)
}
