//! The filter of a volume: fog, smoke, light shafts. \[PSVGF\], volumes.

use super::finish;
use crate::config::Config;
use crate::contract::{Declaration, ResourceId};
use crate::nodes::{self, Builder, Frame, Guides, Shown, Signal, Volume};

/// A volume without surfaces to filter.
pub(crate) fn volume(config: &Config) -> Declaration {
    // Object-space normals serve the history of surfaces alone.
    let config = &Config { object_normal: false, ..*config };
    let mut b = Builder::new(config.allocated_extent);
    let frame = nodes::start_frame(&mut b);
    let guides = nodes::import(&mut b, frame, config);
    finish(b, frame, guides, config, None)
}

/// What the passes of a volume leave.
pub(super) struct FilteredVolume {
    /// `denoised_volume`.
    pub denoised: ResourceId,
    signal: [Signal; 1],
    percentiles: Vec<ResourceId>,
}

impl FilteredVolume {
    /// For a debug view of a volume without surfaces.
    pub fn shown(&self) -> Shown<'_> {
        Shown {
            signals: &self.signal,
            undivided: true,
            moments: true,
            deviation: true,
            percentiles: &self.percentiles,
            ..Shown::default()
        }
    }
}

/// The passes of a volume, behind those of any preset for surfaces, whose guide they read.
///
/// One declaration for both, rather than two denoisers of which one takes the other's guide as an input: the host schedules one list of passes,
/// begins one frame, and the guide has one owner.
pub(super) fn volume_filter(b: &mut Builder, frame: Frame, guides: Guides, config: &Config) -> FilteredVolume {
    let volume = Volume::declare(b);
    let motion = nodes::volume_motion(b, frame, guides, &volume);
    nodes::volume_points(b, frame, &volume);
    let percentiles = config.firefly_filter.then(|| {
        let percentiles = nodes::volume_percentiles(b, frame, &volume, config.block_sort);
        nodes::volume_firefly(b, frame, &volume, percentiles);
        percentiles
    });
    nodes::volume_accumulation(b, frame, guides, &volume, motion);
    nodes::volume_variance(b, frame, guides, &volume);
    let denoised = nodes::volume_atrous(b, frame, guides, &volume, config.levels);
    FilteredVolume { denoised, signal: [volume.signal], percentiles: percentiles.into_iter().collect() }
}
