//! Presets: each a short list of nodes.

mod asvgf;
mod eaw;
mod gradients;
mod percentile;
mod stabilize;
mod svgf;
mod volume;

pub(crate) use asvgf::asvgf;
pub(crate) use eaw::eaw;
pub(crate) use percentile::percentile;
pub(crate) use stabilize::stabilize;
pub(crate) use svgf::svgf;
pub(crate) use volume::volume;

use crate::config::{Config, PostProcess};
use crate::contract::{Declaration, Lifetime, ResourceId};
use crate::nodes::{self, Builder, Frame, Guides, Signal, HDR};

/// What every preset ends with: the volume, where there is one, and the post-process over the sum of `surfaces` and volume.
fn finish(mut b: Builder, frame: Frame, guides: Guides, config: &Config, surfaces: Option<ResourceId>) -> Declaration {
    let volume = config.has_volume().then(|| volume::volume_filter(&mut b, frame, guides, config));
    let denoised: Vec<ResourceId> = surfaces.into_iter().chain(volume).collect();
    match config.post_process {
        PostProcess::None => {}
        PostProcess::ToneMap => {
            let display = b.image("display", HDR, Lifetime::Output);
            nodes::tone_map(&mut b, frame, &denoised, display);
        }
        PostProcess::ToneMapTaa => {
            let display = b.image("display", HDR, Lifetime::Output);
            let tone_mapped = b.image("tone_mapped", HDR, Lifetime::Transient);
            nodes::tone_map(&mut b, frame, &denoised, tone_mapped);
            nodes::taa(&mut b, frame, guides, tone_mapped, display);
        }
    }
    b.finish()
}

/// Outliers leave before the history, where the configuration wants it.
fn firefly_filter(b: &mut Builder, frame: Frame, guides: Guides, config: &Config, signals: &[Signal]) {
    if config.firefly_filter {
        let percentiles = nodes::block_percentiles(b, frame, guides, signals, config.block_sort);
        nodes::firefly(b, frame, guides, signals, &percentiles);
    }
}
