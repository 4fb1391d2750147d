//! Edge-avoiding à-trous wavelets [EAW]: one frame, no history.

use super::{finish, firefly_filter};
use crate::config::Config;
use crate::contract::Declaration;
use crate::nodes::{self, Builder, Shown, Signal};

pub(crate) fn eaw(config: &Config) -> Declaration {
    // Object-space normals serve the history alone.
    let config = &Config { object_normal: false, ..*config };
    let mut b = Builder::new(config.allocated_extent);
    let frame = nodes::start_frame(&mut b);
    let guides = nodes::import(&mut b, frame, config);
    let signals = Signal::declare_without_history(&mut b, config.signals);
    nodes::demodulate(&mut b, frame, guides, &signals);
    let percentiles = firefly_filter(&mut b, frame, guides, config, &signals);
    let filtered = nodes::eaw(&mut b, frame, guides, &signals, config.levels);
    let denoised = nodes::modulate(&mut b, frame, guides, &signals, &filtered);
    let shown = Shown { signals: &signals, percentiles: &percentiles, ..Shown::default() };
    finish(b, frame, guides, config, Some((denoised, shown)))
}
