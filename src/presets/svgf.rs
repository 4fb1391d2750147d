//! Spatiotemporal variance-guided filtering \[SVGF\].

use super::{finish, firefly_filter};
use crate::config::Config;
use crate::contract::Declaration;
use crate::nodes::{self, Adaptation, Builder, Estimate, Kernel, Shown, Signal};

pub(crate) fn svgf(config: &Config) -> Declaration {
    let mut b = Builder::new(config.allocated_extent);
    let frame = nodes::start_frame(&mut b);
    let guides = nodes::import(&mut b, frame, config);
    let signals = Signal::declare(&mut b, config.signals);
    nodes::demodulate(&mut b, frame, guides, &signals);
    let percentiles = firefly_filter(&mut b, frame, guides, config, &signals);
    nodes::temporal_accumulation(&mut b, frame, guides, &signals, Adaptation::None);
    nodes::variance(&mut b, frame, guides, &signals, Estimate::Switched);
    let filtered = nodes::atrous(&mut b, frame, guides, &signals, config.levels, Kernel::Spline);
    let denoised = nodes::modulate(&mut b, frame, guides, &signals, &filtered);
    let shown = Shown { signals: &signals, moments: true, deviation: true, percentiles: &percentiles, ..Shown::default() };
    finish(b, frame, guides, config, Some((denoised, shown)))
}
