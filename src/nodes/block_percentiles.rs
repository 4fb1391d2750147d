//! Two percentiles of luminance in every 8×8 pixels. [PSVGF], block percentiles.

use super::{Builder, Frame, Guides, Signal, Volume, PACKED_32};
use crate::config::BlockSort;
use crate::contract::{Lifetime, Phase, ResourceId};
use crate::shaders;

/// Pixels a side of a block, which is a workgroup.
pub(crate) const BLOCK_SIZE: u32 = 8;

/// One pass and one image for every signal.
pub(crate) fn block_percentiles(
    b: &mut Builder,
    frame: Frame,
    guides: Guides,
    signals: &[Signal],
    sort: BlockSort,
) -> Vec<ResourceId> {
    const NAMES: [&str; 3] = ["block_percentiles", "block_percentiles_direct", "block_percentiles_indirect"];
    let mut images = Vec::with_capacity(signals.len());
    for (signal, name) in signals.iter().zip(&NAMES[signals.len() - 1..]) {
        let percentiles = b.block_image(name, PACKED_32, Lifetime::Transient);
        let uses = vec![frame.constants.uniform(), guides.guide.sampled(), signal.ping.sampled(), percentiles.written()];
        b.dispatch(name, Phase::AfterLighting, &shaders::BLOCK_PERCENTILES_VOLUME_0, sort as u32, uses);
        images.push(percentiles);
    }
    images
}

/// The same for a volume, with the background.
pub(crate) fn volume_percentiles(b: &mut Builder, frame: Frame, volume: &Volume, sort: BlockSort) -> ResourceId {
    const NAME: &str = "block_percentiles_volume";
    let percentiles = b.block_image(NAME, PACKED_32, Lifetime::Transient);
    let uses = vec![frame.constants.uniform(), volume.signal.ping.sampled(), percentiles.written()];
    b.dispatch(NAME, Phase::AfterLighting, &shaders::BLOCK_PERCENTILES_VOLUME_1, sort as u32, uses);
    percentiles
}
