//! Spreads the gradients over strata without a sample, and takes their noise. \[ASVGF\] 3.4, eq. 7 to 12.

use super::gradient::GradientImages;
use super::{Builder, Frame, Guides, Strata};
use crate::contract::{Phase, ResourceId};
use crate::shaders;

const NAMES: [&str; 5] = ["gradient_atrous_0", "gradient_atrous_1", "gradient_atrous_2", "gradient_atrous_3", "gradient_atrous_4"];

/// Five passes. Returns the image with the last.
pub(crate) fn gradient_atrous(b: &mut Builder, frame: Frame, guides: Guides, strata: Strata, images: GradientImages) -> ResourceId {
    let (mut from, mut to) = (images.ping, images.pong);
    for (level, name) in (0..).zip(NAMES) {
        let uses =
            vec![frame.constants.uniform(), images.guide.sampled(), guides.depth_gradient.sampled(), from.sampled(), to.written()];
        b.dispatch_strata(name, Phase::AfterLighting, &shaders::GRADIENT_ATROUS, strata, level, uses);
        (from, to) = (to, from);
    }
    from
}
