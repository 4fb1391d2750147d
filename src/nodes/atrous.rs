//! The edge-avoiding à-trous wavelet transform, guided by variance. \[SVGF\] 4.3, eq. 1 to 5.

use super::{by_signals, Builder, Frame, Guides, Signal, Volume, HDR};
use crate::contract::{Lifetime, Phase, ResourceId};
use crate::shaders;

/// The kernel of a level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kernel {
    /// 5×5 B3 spline \[SVGF\].
    Spline,
    /// 3×3 box \[ASVGF\].
    Box,
}

/// Where the last level left each signal.
pub(crate) type Filtered = Vec<ResourceId>;

const NAMES: [&str; 10] =
    ["atrous_0", "atrous_1", "atrous_2", "atrous_3", "atrous_4", "atrous_5", "atrous_6", "atrous_7", "atrous_8", "atrous_9"];

/// One pass a level. Level 0 writes the history of the next frame; the levels after it alternate between two transients.
pub(crate) fn atrous(b: &mut Builder, frame: Frame, guides: Guides, signals: &[Signal], levels: u32, kernel: Kernel) -> Filtered {
    let shader = match kernel {
        Kernel::Spline => by_signals(signals, &shaders::ATROUS_SIGNALS_1, &shaders::ATROUS_SIGNALS_2),
        Kernel::Box => by_signals(signals, &shaders::ATROUS_SIGNALS_1_BOX_1, &shaders::ATROUS_SIGNALS_2_BOX_1),
    };
    let mut filtered: Filtered = signals.iter().map(|s| s.pong).collect();
    for (level, name) in (0..levels).zip(NAMES) {
        let mut uses = vec![frame.constants.uniform(), guides.guide.sampled(), guides.depth_gradient.sampled()];
        for (signal, from) in signals.iter().zip(&mut filtered) {
            let to = match level {
                0 => signal.history,
                l if l % 2 == 1 => signal.ping,
                _ => signal.pong,
            };
            uses.extend([from.sampled(), to.written()]);
            *from = to;
        }
        b.dispatch(name, Phase::AfterLighting, shader, level, uses);
    }
    filtered
}

const VOLUME_NAMES: [&str; 10] = [
    "atrous_volume_0",
    "atrous_volume_1",
    "atrous_volume_2",
    "atrous_volume_3",
    "atrous_volume_4",
    "atrous_volume_5",
    "atrous_volume_6",
    "atrous_volume_7",
    "atrous_volume_8",
    "atrous_volume_9",
];

/// The same for a volume. At least two levels, since the first one writes the history and the last one the output, which is returned.
pub(crate) fn volume_atrous(b: &mut Builder, frame: Frame, guides: Guides, volume: &Volume, levels: u32) -> ResourceId {
    let denoised = b.image("denoised_volume", HDR, Lifetime::Output);
    let last = levels.max(2) - 1;
    let mut from = volume.signal.pong;
    for (level, name) in (0..=last).zip(VOLUME_NAMES) {
        let to = match level {
            0 => volume.signal.history,
            l if l == last => denoised,
            l if l % 2 == 1 => volume.signal.ping,
            _ => volume.signal.pong,
        };
        let uses = vec![frame.constants.uniform(), guides.guide.sampled(), from.sampled(), to.written()];
        b.dispatch(name, Phase::AfterLighting, &shaders::ATROUS_SIGNALS_1_VOLUME_1, level, uses);
        from = to;
    }
    denoised
}
