//! How much the luminance of the same samples changed from the previous frame to this one, per stratum. \[ASVGF\] eq. 2, 3, 13.

use super::{Builder, Frame, Guides, Signal, HDR, HOST_COLOUR, PACKED_32, PACKED_64};
use crate::contract::{Lifetime, Phase, ResourceId, Use};
use crate::shaders;

/// Blocks of pixels that each own a gradient.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Strata {
    /// Pixels a side.
    pub size: u32,
}

/// Where the gradients come from, with what was made for it before lighting.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Gradients {
    /// `gradient_samples`, re-shaded by the host.
    ForwardProjected(ResourceId),
    Reshaded,
    Sparse,
}

/// Gradients before and after an iteration of their reconstruction, and the guide that steers it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GradientImages {
    pub ping: ResourceId,
    pub pong: ResourceId,
    pub guide: ResourceId,
}

pub(crate) fn gradient(
    b: &mut Builder,
    frame: Frame,
    guides: Guides,
    signals: &[Signal],
    strata: Strata,
    source: Gradients,
) -> GradientImages {
    let images = GradientImages {
        ping: b.stratum_image("gradient_ping", strata, HDR, Lifetime::Transient),
        pong: b.stratum_image("gradient_pong", strata, HDR, Lifetime::Transient),
        guide: b.stratum_image("gradient_guide", strata, PACKED_64, Lifetime::Transient),
    };
    let albedo = b.input("albedo", HOST_COLOUR, true);
    let mut uses = vec![frame.constants.uniform(), guides.guide.sampled(), albedo.sampled()];
    uses.extend(signals.iter().map(|s| s.noisy.sampled()));
    uses.extend([images.ping.written(), images.guide.written()]);
    let one = signals.len() == 1;
    let shader = match source {
        Gradients::ForwardProjected(samples) => {
            uses.extend(luminance(b));
            uses.push(samples.sampled());
            [&shaders::GRADIENT_SIGNALS_2_SOURCE_0, &shaders::GRADIENT_SIGNALS_1_SOURCE_0][usize::from(one)]
        }
        Gradients::Reshaded => {
            uses.extend(luminance(b));
            uses.push(b.input("reshaded_radiance", HOST_COLOUR, true).sampled());
            uses.extend([guides.guide.previous(), guides.surface_motion.sampled(), guides.depth_gradient.sampled()]);
            [&shaders::GRADIENT_SIGNALS_2_SOURCE_1, &shaders::GRADIENT_SIGNALS_1_SOURCE_1][usize::from(one)]
        }
        Gradients::Sparse => {
            uses.push(b.stratum_input("sparse_gradient", strata, HOST_COLOUR, true).sampled());
            [&shaders::GRADIENT_SIGNALS_2_SOURCE_2, &shaders::GRADIENT_SIGNALS_1_SOURCE_2][usize::from(one)]
        }
    };
    b.dispatch_strata("gradient", Phase::AfterLighting, shader, strata, 0, uses);
    images
}

/// The luminance of this frame's samples is kept for the next frame, with that of the albedo.
fn luminance(b: &mut Builder) -> [Use; 2] {
    let noisy = b.image("noisy_luminance", PACKED_32, Lifetime::History);
    [noisy.written(), noisy.previous()]
}
