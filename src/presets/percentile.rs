//! Percentile-based adaptive SVGF [PSVGF].

use super::finish;
use crate::config::{AdaptiveRule, Config};
use crate::contract::Declaration;
use crate::nodes::{self, Adaptation, Builder, Estimate, Kernel, Shown, Signal};

pub(crate) fn percentile(config: &Config) -> Declaration {
    let mut b = Builder::new(config.allocated_extent);
    let frame = nodes::start_frame(&mut b);
    let guides = nodes::import(&mut b, frame, config);
    let signals = Signal::declare(&mut b, config.signals);
    nodes::demodulate(&mut b, frame, guides, &signals);
    let percentiles = nodes::block_percentiles(&mut b, frame, guides, &signals, config.block_sort);
    nodes::firefly(&mut b, frame, guides, &signals, &percentiles);
    let confidence = match config.adaptive_rule {
        AdaptiveRule::Percentiles => nodes::percentile_rule(&mut b, frame, guides, &signals, &percentiles),
        AdaptiveRule::ChangeTest => {
            let difference = nodes::block_difference(&mut b, frame, guides, &signals);
            nodes::change_test(&mut b, frame, &signals, &difference)
        }
    };
    nodes::temporal_accumulation(&mut b, frame, guides, &signals, Adaptation::Repaired(confidence));
    nodes::variance(&mut b, frame, guides, &signals, Estimate::Fading);
    // The 3x3 box costs 9 taps of 25 and pays for the statistics; on the flickering box it is no worse.
    let filtered = nodes::atrous(&mut b, frame, guides, &signals, config.levels, Kernel::Box);
    let denoised = nodes::modulate(&mut b, frame, guides, &signals, &filtered);
    let shown = Shown {
        signals: &signals,
        moments: true,
        deviation: true,
        confidence: Some(confidence),
        percentiles: &percentiles,
        ..Shown::default()
    };
    finish(b, frame, guides, config, Some((denoised, shown)))
}
