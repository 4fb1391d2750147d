//! Spatiotemporal variance-guided filtering \[SVGF\].

use crate::config::{Config, PostProcess};
use crate::contract::{Declaration, Lifetime};
use crate::nodes::{self, Builder, Signal, HDR};

pub(crate) fn svgf(config: &Config) -> Declaration {
    let mut b = Builder::new(config.allocated_extent);
    let frame = nodes::start_frame(&mut b);
    let guides = nodes::import(&mut b, frame, config);
    let signals = Signal::declare(&mut b, config.signals);
    nodes::demodulate(&mut b, frame, guides, &signals);
    nodes::temporal_accumulation(&mut b, frame, guides, &signals);
    nodes::variance(&mut b, frame, guides, &signals);
    let filtered = nodes::atrous(&mut b, frame, guides, &signals, config.levels);
    let denoised = nodes::modulate(&mut b, frame, guides, &signals, &filtered);
    if config.post_process != PostProcess::None {
        let display = b.image("display", HDR, Lifetime::Output);
        if config.post_process == PostProcess::ToneMapTaa {
            let tone_mapped = b.image("tone_mapped", HDR, Lifetime::Transient);
            nodes::tone_map(&mut b, frame, denoised, tone_mapped);
            nodes::taa(&mut b, frame, guides, tone_mapped, display);
        } else {
            nodes::tone_map(&mut b, frame, denoised, display);
        }
    }
    b.finish()
}
