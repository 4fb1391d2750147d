//! Multiplies the albedo back, adds the signals and the emission.

use super::{by_signals, Builder, Filtered, Frame, Guides, Signal, HDR, HOST_COLOUR};
use crate::contract::{Lifetime, Phase, ResourceId};
use crate::shaders;

pub(crate) fn modulate(b: &mut Builder, frame: Frame, guides: Guides, signals: &[Signal], filtered: &Filtered) -> ResourceId {
    let albedo = b.input("albedo", HOST_COLOUR, true);
    let emission = b.input("emission", HOST_COLOUR, true);
    let denoised = b.image("denoised_radiance", HDR, Lifetime::Output);
    let mut uses = vec![
        frame.constants.uniform(),
        frame.statistics.updated(),
        guides.guide.sampled(),
        albedo.sampled(),
        emission.sampled(),
        denoised.written(),
    ];
    uses.extend(filtered.iter().map(|f| f.sampled()));
    let shader = by_signals(signals, &shaders::MODULATE_SIGNALS_1, &shaders::MODULATE_SIGNALS_2);
    b.dispatch("modulate", Phase::AfterLighting, shader, 0, uses);
    denoised
}
