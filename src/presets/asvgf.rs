//! Adaptive temporal filtering by temporal gradients \[ASVGF\].

use super::{finish, firefly_filter, gradients};
use crate::config::Config;
use crate::contract::Declaration;
use crate::nodes::{self, Adaptation, Builder, Estimate, Kernel, Shown, Signal};

pub(crate) fn asvgf(config: &Config) -> Declaration {
    let mut b = Builder::new(config.allocated_extent);
    let frame = nodes::start_frame(&mut b);
    let guides = nodes::import(&mut b, frame, config);
    let source = gradients::before_lighting(&mut b, frame, guides, config);
    let signals = Signal::declare(&mut b, config.signals);
    let change = gradients::after_lighting(&mut b, frame, guides, config, source, &signals);
    nodes::demodulate(&mut b, frame, guides, &signals);
    let percentiles = firefly_filter(&mut b, frame, guides, config, &signals);
    nodes::temporal_accumulation(&mut b, frame, guides, &signals, Adaptation::Alpha(change.confidence));
    nodes::variance(&mut b, frame, guides, &signals, Estimate::Switched);
    let filtered = nodes::atrous(&mut b, frame, guides, &signals, config.levels, Kernel::Box);
    let denoised = nodes::modulate(&mut b, frame, guides, &signals, &filtered);
    let shown = Shown {
        signals: &signals,
        moments: true,
        deviation: true,
        confidence: Some(change.confidence),
        gradient: change.gradient,
        percentiles: &percentiles,
        ..Shown::default()
    };
    finish(b, frame, guides, config, Some((denoised, shown)))
}
