//! A temporal accumulation over the output of any other denoiser, driven by the gradients of the noisy radiance (A-RAE, \[ASVGF\] 4).

use super::{finish, firefly_filter, gradients};
use crate::config::Config;
use crate::contract::Declaration;
use crate::nodes::{self, Adaptation, Builder, Shown, Signal, HOST_COLOUR};

/// `noisy_radiance` is compared, `other_denoised_radiance` is accumulated: divided by the albedo like every signal, so that textures stay.
pub(crate) fn stabilize(config: &Config) -> Declaration {
    let mut b = Builder::new(config.allocated_extent);
    let frame = nodes::start_frame(&mut b);
    let guides = nodes::import(&mut b, frame, config);
    let source = gradients::before_lighting(&mut b, frame, guides, config);
    let stabilized = [Signal::declare_stabilized(&mut b)];
    let compared = source.map(|_| Signal { noisy: b.input("noisy_radiance", HOST_COLOUR, false), ..stabilized[0] });
    let change = gradients::after_lighting(&mut b, frame, guides, config, source, compared.as_slice());
    nodes::demodulate(&mut b, frame, guides, &stabilized);
    let percentiles = firefly_filter(&mut b, frame, guides, config, &stabilized);
    nodes::temporal_accumulation(&mut b, frame, guides, &stabilized, Adaptation::Alpha(change.confidence));
    let accumulated = vec![stabilized[0].history];
    let denoised = nodes::modulate(&mut b, frame, guides, &stabilized, &accumulated);
    let shown = Shown {
        signals: &stabilized,
        moments: true,
        confidence: Some(change.confidence),
        gradient: change.gradient,
        percentiles: &percentiles,
        ..Shown::default()
    };
    finish(b, frame, guides, config, Some((denoised, shown)))
}
