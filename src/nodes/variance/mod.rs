//! Estimates the standard deviation of luminance: from the pixel's own past if it is long enough,
//! else from its surroundings. \[SVGF\] 4.2.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::{by_signals, pass, UNREAD};
use crate::choice::choices;
use crate::graph::{
    Accumulated, Estimate, Feedback, Graph, Guides, History, Image, Pass, Port, Value, VolumeAccumulated, VolumeEstimate, HDR,
};
use crate::shaders;

choices! {
    /// The estimator of the variance of a pixel with a short past.
    #[derive(Default)]
    #[non_exhaustive]
    pub enum Estimator {
        /// Estimate over 7×7 pixels while the past is short \[SVGF\].
        #[default]
        Switched = 0 => "switched",
        /// Estimate over 5×5 pixels, with a share that fades as the past grows \[PSVGF\].
        Fading = 1 => "fading",
        /// The past of the pixel alone, for a graph that accumulates and does not filter. The deviation
        /// of a pixel without a past is 0.
        Temporal = 2 => "temporal",
        /// Of the accumulated mean instead of a sample: from the past and from 5×5 pixels, whose smooth
        /// structure does not count. It is never below the noise that neighbouring means still show.
        OfMean = 3 => "of_mean",
    }
}

/// Parameters of the node `variance`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Variance {
    /// Default: [`Estimator::Switched`].
    pub estimator: Estimator,
    /// Pixels with a shorter history look at their surroundings. Default: [`crate::Tuning::spatial_variance_frames`].
    pub spatial_variance_frames: Value,
}

impl Graph {
    /// The standard deviation of luminance in the alpha of one or two signals. Their moments go into `history`, and with
    /// [`Feedback::Accumulated`] so does the estimate itself.
    pub fn variance(&mut self, guides: &Guides, accumulated: &Accumulated, history: &History, variance: Variance) -> Estimate {
        self.estimates(accumulated, history, |node, signals| {
            pass(node, by_signals(signals, &shaders::VARIANCE_SIGNALS_1, &shaders::VARIANCE_SIGNALS_2))
                .constant("ESTIMATOR", variance.estimator as u32)
                .constant("FILLED", u32::from(accumulated.has_filled_holes()))
                // Of two signals it would halve the waves of a GPU, and specular light, which needs it, has a pass of its own.
                .constant("MARKED", u32::from(variance.estimator == Estimator::OfMean && signals.signals() == 1))
                .value("spatial_variance_frames", variance.spatial_variance_frames)
                .value("volume_sigma_z", UNREAD)
                .bind("guide", guides.guide)
        })
    }

    /// The standard deviation of luminance in the alpha of a volume's radiance, by the fading estimate. Its moments go into
    /// `history`.
    pub fn volume_variance(&mut self, guides: &Guides, accumulated: &VolumeAccumulated, history: &History) -> VolumeEstimate {
        self.estimates(accumulated, history, |node, _| {
            pass(node, &shaders::VARIANCE_SIGNALS_1)
                .constant("ESTIMATOR", Estimator::Fading as u32)
                .constant("VOLUME", 1)
                .value("sigma_n", UNREAD)
                .value("sigma_z", UNREAD)
                .bind("guide", guides.guide)
        })
    }

    /// One pass, or one for each signal where estimates are transients: an image that one pass read is dead when the next one writes.
    fn estimates<K, L>(&mut self, accumulated: &Port<K>, history: &History, describe: impl Fn(&str, &Port<K>) -> Pass) -> Port<L> {
        let kept = Port::of_images(history.colour()).filter(|_| history.feedback == Feedback::Accumulated);
        let signals = if kept.is_some() { accumulated.signals() } else { 1 };
        let estimate = kept.unwrap_or_else(|| self.image_each(accumulated, "estimate", HDR, 1));
        let new_luminance: Vec<Image> = history.new_luminance().iter().map(|image| self.refreshed(*image)).collect();
        let images = accumulated.images().chunks(signals).zip(estimate.images().chunks(signals));
        let luminance = new_luminance.chunks(signals).zip(history.luminance_history().chunks(signals));
        for ((read, written), (new, moments)) in images.zip(luminance) {
            let part = Port::of_images(read).unwrap_or(*accumulated);
            let node = self.node("variance", &self.label_of(&part));
            let pass = describe(&node, &part).each("irradiance", read).each("new_luminance", new);
            self.add(pass.each("luminance_history", moments).each("estimate", written));
        }
        self.renewed(&estimate)
    }
}
