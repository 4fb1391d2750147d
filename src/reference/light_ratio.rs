//! How far a history is true again once it is scaled by the ratio of light.

/// The relative spread of a ratio, among samples or between strata, below which it is rounding.
const COHERENT: f32 = 0.1;

/// The spread above which there is no ratio.
pub(crate) const INCOHERENT: f32 = 0.3;

/// 1, true, to 0.
pub(crate) fn coherence_of(spread: f32) -> f32 {
    ((INCOHERENT - spread) / (INCOHERENT - COHERENT)).clamp(0.0, 1.0)
}
