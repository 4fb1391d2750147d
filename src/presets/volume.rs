//! The filter of a volume: fog, smoke, light shafts. \[PSVGF\], volumes.

use super::finish;
use crate::config::Config;
use crate::contract::{Declaration, ResourceId};
use crate::nodes::{self, Builder, Frame, Guides, Volume};

/// A volume without surfaces to filter.
pub(crate) fn volume(config: &Config) -> Declaration {
    // Object-space normals serve the history of surfaces alone.
    let config = &Config { object_normal: false, ..*config };
    let mut b = Builder::new(config.allocated_extent);
    let frame = nodes::start_frame(&mut b);
    let guides = nodes::import(&mut b, frame, config);
    finish(b, frame, guides, config, None)
}

/// The passes of a volume, behind those of any preset for surfaces, whose guide they read. Returns `denoised_volume`.
///
/// One declaration for both, rather than two denoisers of which one takes the other's guide as an input: the host schedules one list of passes,
/// begins one frame, and the guide has one owner.
pub(super) fn volume_filter(b: &mut Builder, frame: Frame, guides: Guides, config: &Config) -> ResourceId {
    let volume = Volume::declare(b);
    let motion = nodes::volume_motion(b, frame, guides, &volume);
    nodes::volume_points(b, frame, &volume);
    if config.firefly_filter {
        let percentiles = nodes::volume_percentiles(b, frame, &volume, config.block_sort);
        nodes::volume_firefly(b, frame, &volume, percentiles);
    }
    nodes::volume_accumulation(b, frame, guides, &volume, motion);
    nodes::volume_variance(b, frame, guides, &volume);
    nodes::volume_atrous(b, frame, guides, &volume, config.levels)
}
