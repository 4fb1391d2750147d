//! What the denoiser knows of each pixel, as a picture. Not a stage of a filter: nothing reads it.

use super::{Builder, Frame, Guides, Signal, HDR, HOST_COLOUR};
use crate::contract::{Lifetime, Phase, ResourceId};
use crate::shaders;

/// What a preset has beside the guides.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Shown<'a> {
    /// Lighting components; at least one.
    pub signals: &'a [Signal],
    /// They are not divided by the albedo.
    pub undivided: bool,
    /// `moments*` are written.
    pub moments: bool,
    /// `irradiance_history*` hold the standard deviation.
    pub deviation: bool,
    /// `history_confidence`.
    pub confidence: Option<ResourceId>,
    /// The reconstructed gradients.
    pub gradient: Option<ResourceId>,
    /// One image a signal, where there are percentiles.
    pub percentiles: &'a [ResourceId],
}

/// One shader for every preset: where an image does not exist, another of its kind is bound in its place, and the shader is told so. The
/// alternative are 15 variants.
pub(crate) fn debug_view(b: &mut Builder, frame: Frame, guides: Guides, shown: Shown) {
    let Some(first) = shown.signals.first() else { return };
    let signal = |i: usize, wanted: bool| shown.signals.get(i).filter(|_| wanted);
    let albedo = (!shown.undivided).then(|| b.input("albedo", HOST_COLOUR, true));
    let images = [
        (Some(guides.guide), guides.guide),
        (Some(guides.surface_motion), guides.guide),
        (signal(0, shown.moments).map(|s| s.moments), guides.guide),
        (signal(1, shown.moments).map(|s| s.moments), guides.guide),
        (shown.percentiles.first().copied(), guides.guide),
        (shown.percentiles.get(1).copied(), guides.guide),
        (signal(0, shown.deviation).map(|s| s.history), first.noisy),
        (signal(1, shown.deviation).map(|s| s.history), first.noisy),
        (shown.confidence, first.noisy),
        (shown.gradient, first.noisy),
        (Some(first.noisy), first.noisy),
        (signal(1, true).map(|s| s.noisy), first.noisy),
        (albedo, first.noisy),
    ];
    let output = b.image("debug_view", HDR, Lifetime::Output);
    let mut uses = vec![frame.constants.uniform(), frame.statistics.storage()];
    let mut available = 0b11;
    for (image, stand_in) in images {
        available |= u32::from(image.is_some()) << uses.len();
        uses.push(image.unwrap_or(stand_in).sampled());
    }
    available |= 1 << uses.len();
    uses.push(output.written());
    b.dispatch_debug_view("debug_view", Phase::PostProcess, &shaders::DEBUG_VIEW, available, uses);
}
