//! Estimates the standard deviation of luminance: from the pixel's own past where it is long enough, else from its surroundings. \[SVGF\] 4.2.

use super::{by_signals, Builder, Frame, Guides, Signal, Volume};
use crate::contract::Phase;
use crate::shaders;

/// Which estimate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Estimate {
    /// 7×7 pixels while the past is short [SVGF].
    Switched,
    /// 5×5 pixels, fading [PSVGF].
    Fading,
}

pub(crate) fn variance(b: &mut Builder, frame: Frame, guides: Guides, signals: &[Signal], estimate: Estimate) {
    let mut uses = vec![frame.constants.uniform(), guides.guide.sampled(), guides.depth_gradient.sampled()];
    for signal in signals {
        uses.extend([signal.ping.sampled(), signal.moments.sampled(), signal.pong.written()]);
    }
    let shader = match estimate {
        Estimate::Switched => by_signals(signals, &shaders::VARIANCE_SIGNALS_1, &shaders::VARIANCE_SIGNALS_2),
        Estimate::Fading => by_signals(signals, &shaders::VARIANCE_SIGNALS_1_FADE_1, &shaders::VARIANCE_SIGNALS_2_FADE_1),
    };
    b.dispatch("variance", Phase::AfterLighting, shader, 0, uses);
}

/// The fading estimate of a volume.
pub(crate) fn volume_variance(b: &mut Builder, frame: Frame, guides: Guides, volume: &Volume) {
    let Signal { ping, moments, pong, .. } = volume.signal;
    let uses = vec![frame.constants.uniform(), guides.guide.sampled(), ping.sampled(), moments.sampled(), pong.written()];
    b.dispatch("variance_volume", Phase::AfterLighting, &shaders::VARIANCE_SIGNALS_1_FADE_1_VOLUME_1, 0, uses);
}
