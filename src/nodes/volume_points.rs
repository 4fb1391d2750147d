//! Takes in the light that a volume scatters towards the camera, and where. [PSVGF], volumes.

use super::{Builder, Frame, Signal, HDR, HOST_COLOUR, HOST_SCALAR, PACKED_64};
use crate::contract::{Lifetime, Phase, ResourceId};
use crate::shaders;

/// The resources of the filter of a volume.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Volume {
    /// Radiance, which no albedo divides.
    pub signal: Signal,
    /// One point a pixel for the next frame: depth and contribution.
    pub points: ResourceId,
}

impl Volume {
    pub fn declare(b: &mut Builder) -> Self {
        let signal = Signal {
            noisy: b.input("noisy_volume", HOST_COLOUR, false),
            ping: b.image("filter_ping_volume", HDR, Lifetime::Transient),
            pong: b.image("filter_pong_volume", HDR, Lifetime::Transient),
            history: b.image("irradiance_history_volume", HDR, Lifetime::HistoryInPlace),
            moments: b.image("moments_volume", PACKED_64, Lifetime::History),
        };
        Self { signal, points: b.image("volume_points", PACKED_64, Lifetime::HistoryInPlace) }
    }
}

/// The points are written after `volume_motion` has read those of the previous frame.
pub(crate) fn volume_points(b: &mut Builder, frame: Frame, volume: &Volume) {
    let uses = vec![
        frame.constants.uniform(),
        frame.statistics.updated(),
        volume.signal.noisy.sampled(),
        b.input("scattering_depth", HOST_SCALAR, true).sampled(),
        volume.signal.ping.written(),
        volume.points.written(),
    ];
    b.dispatch("volume_points", Phase::AfterLighting, &shaders::VOLUME_POINTS, 0, uses);
}
