//! Presets: each a short list of nodes.

mod asvgf;
mod eaw;
mod gradients;
mod percentile;
mod stabilize;
mod svgf;

pub(crate) use asvgf::asvgf;
pub(crate) use eaw::eaw;
pub(crate) use percentile::percentile;
pub(crate) use stabilize::stabilize;
pub(crate) use svgf::svgf;

use crate::config::{Config, PostProcess};
use crate::contract::{Lifetime, ResourceId};
use crate::nodes::{self, Builder, Frame, Guides, Shown, Signal, HDR};

/// What every preset ends with.
fn post_process(b: &mut Builder, frame: Frame, guides: Guides, config: &Config, denoised: ResourceId) {
    if config.post_process == PostProcess::None {
        return;
    }
    let display = b.image("display", HDR, Lifetime::Output);
    if config.post_process == PostProcess::ToneMapTaa {
        let tone_mapped = b.image("tone_mapped", HDR, Lifetime::Transient);
        nodes::tone_map(b, frame, denoised, tone_mapped);
        nodes::taa(b, frame, guides, tone_mapped, display);
    } else {
        nodes::tone_map(b, frame, denoised, display);
    }
}

/// The last pass, where the configuration wants it.
fn debug_view(b: &mut Builder, frame: Frame, guides: Guides, config: &Config, shown: Shown) {
    if config.debug_view {
        nodes::debug_view(b, frame, guides, shown);
    }
}

/// Outliers leave before the history, where the configuration wants it. Returns the percentiles of every signal, or nothing.
fn firefly_filter(b: &mut Builder, frame: Frame, guides: Guides, config: &Config, signals: &[Signal]) -> Vec<ResourceId> {
    if !config.firefly_filter {
        return Vec::new();
    }
    let percentiles = nodes::block_percentiles(b, frame, guides, signals, config.block_sort);
    nodes::firefly(b, frame, guides, signals, &percentiles);
    percentiles
}
