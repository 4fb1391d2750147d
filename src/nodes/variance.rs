//! Estimates the standard deviation of luminance: from the pixel's own past where it is long enough, else from its surroundings. \[SVGF\] 4.2.

use super::{by_signals, Builder, Frame, Guides, Signal};
use crate::contract::Phase;
use crate::shaders;

pub(crate) fn variance(b: &mut Builder, frame: Frame, guides: Guides, signals: &[Signal]) {
    let mut uses = vec![frame.constants.uniform(), guides.guide.sampled(), guides.depth_gradient.sampled()];
    for signal in signals {
        uses.extend([signal.ping.sampled(), signal.moments.sampled(), signal.pong.written()]);
    }
    let shader = by_signals(signals, &shaders::VARIANCE_SIGNALS_1, &shaders::VARIANCE_SIGNALS_2);
    b.dispatch("variance", Phase::AfterLighting, shader, 0, uses);
}
