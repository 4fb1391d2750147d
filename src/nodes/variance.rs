//! Estimates the standard deviation of luminance: from the pixel's own past where it is long enough, else from its surroundings.
//! \[SVGF\] 4.2.

pub(crate) mod twin;

use super::by_signals;
use crate::graph::{Estimate, Graph, Guides, History, Irradiance, Pass, Value, VolumeEstimate, VolumeRadiance, HDR};
use crate::shaders;

/// The estimator of the variance of a pixel with a short past.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Estimator {
    /// Estimate over 7×7 pixels while the past is short \[SVGF\].
    #[default]
    Switched,
    /// Estimate over 5×5 pixels, with a share that fades as the past grows \[PSVGF\].
    Fading,
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
    /// Puts the standard deviation of luminance into the alpha of one or two signals.
    pub fn variance(&mut self, guides: &Guides, accumulated: &Irradiance, history: &History, variance: Variance) -> Estimate {
        let node = self.node("variance", &self.label_of(accumulated));
        let estimate: Estimate = self.image_each(accumulated, "filter_pong", HDR, 1);
        let pass = Pass::new(&node, by_signals(accumulated, &shaders::VARIANCE_SIGNALS_1, &shaders::VARIANCE_SIGNALS_2))
            .constant("FADE", u32::from(variance.estimator == Estimator::Fading))
            .value("spatial_variance_frames", variance.spatial_variance_frames)
            .bind("guide", guides.guide)
            .bind("depth_gradient", guides.depth_gradient)
            .each("accumulated", accumulated.images())
            .each("moments", &self.current_moments(history))
            .each("estimated", estimate.images());
        self.add(pass);
        self.renewed(&estimate)
    }

    /// Puts the standard deviation of luminance into the alpha of a volume's radiance, by the fading estimate.
    pub fn volume_variance(&mut self, guides: &Guides, accumulated: &VolumeRadiance, history: &History) -> VolumeEstimate {
        let node = self.node("variance", &self.label_of(accumulated));
        let estimate: VolumeEstimate = self.image_each(accumulated, "filter_pong", HDR, 1);
        let pass = Pass::new(&node, &shaders::VARIANCE_SIGNALS_1)
            .constant("FADE", 1)
            .constant("VOLUME", 1)
            .bind("guide", guides.guide)
            .bind("depth_gradient", guides.depth_gradient)
            .each("accumulated", accumulated.images())
            .each("moments", &self.current_moments(history))
            .each("estimated", estimate.images());
        self.add(pass);
        self.renewed(&estimate)
    }
}
