//! Divides the noisy radiance by the albedo, and stops what is not finite.

use super::{by_signals, Builder, Frame, Guides, Signal, HOST_COLOUR};
use crate::contract::Phase;
use crate::shaders;

pub(crate) fn demodulate(b: &mut Builder, frame: Frame, guides: Guides, signals: &[Signal]) {
    let albedo = b.input("albedo", HOST_COLOUR, true);
    let mut uses = vec![frame.constants.uniform(), frame.statistics.updated(), guides.guide.sampled(), albedo.sampled()];
    for signal in signals {
        uses.extend([signal.noisy.sampled(), signal.ping.written()]);
    }
    let shader = by_signals(signals, &shaders::DEMODULATE_SIGNALS_1, &shaders::DEMODULATE_SIGNALS_2);
    b.dispatch("demodulate", Phase::AfterLighting, shader, 0, uses);
}
