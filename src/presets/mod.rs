//! Presets: each a short list of nodes.

mod asvgf;
mod eaw;
mod gradients;
mod percentile;
mod stabilize;
mod svgf;
mod volume;

use asvgf::asvgf;
use eaw::eaw;
use percentile::percentile;
use stabilize::stabilize;
use svgf::svgf;
use volume::volume;
use volume::FilteredVolume;

use crate::config::{Config, PostProcess, Preset};
use crate::contract::{Declaration, Lifetime, ResourceId};
use crate::error::Error;
use crate::nodes::{self, Builder, Frame, Guides, Shown, Signal, HDR};

impl Config {
    /// Declares every resource and pass, without a device.
    ///
    /// # Errors
    /// As [`Config::validate`].
    pub fn declare(&self) -> Result<Declaration, Error> {
        self.validate()?;
        Ok(match self.preset {
            Preset::Svgf => svgf(self),
            Preset::Percentile => percentile(self),
            Preset::Eaw => eaw(self),
            Preset::Asvgf => asvgf(self),
            Preset::Stabilize => stabilize(self),
            Preset::Volume => volume(self),
        })
    }
}

/// What every preset ends with: the volume, where there is one, the post-process over the sum of surfaces and volume, and the debug view.
/// `surfaces`: where they were denoised, and what can be shown of them.
fn finish(mut b: Builder, frame: Frame, guides: Guides, config: &Config, surfaces: Option<(ResourceId, Shown)>) -> Declaration {
    let volume = config.has_volume().then(|| volume::volume_filter(&mut b, frame, guides, config));
    let denoised: Vec<ResourceId> =
        surfaces.iter().map(|(denoised, _)| *denoised).chain(volume.as_ref().map(|volume| volume.denoised)).collect();
    if config.post_process != PostProcess::None {
        post_process(&mut b, frame, guides, config, &denoised);
    }
    if config.debug_view {
        let of_volume = volume.as_ref().map(FilteredVolume::shown);
        if let Some(shown) = surfaces.map(|(_, shown)| shown).or(of_volume) {
            nodes::debug_view(&mut b, frame, guides, shown);
        }
    }
    b.finish()
}

fn post_process(b: &mut Builder, frame: Frame, guides: Guides, config: &Config, denoised: &[ResourceId]) {
    let display = b.image("display", HDR, Lifetime::Output);
    if config.post_process == PostProcess::ToneMapTaa {
        let tone_mapped = b.image("tone_mapped", HDR, Lifetime::Transient);
        nodes::tone_map(b, frame, denoised, tone_mapped);
        nodes::taa(b, frame, guides, tone_mapped, display);
    } else {
        nodes::tone_map(b, frame, denoised, display);
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
