//! The filter of a volume: fog, smoke, light shafts. \[PSVGF\], volumes.

use super::Denoised;
use crate::config::Config;
use crate::graph::{Feedback, Graph, Guides, Radiance};
use crate::nodes::{Intermediates, Modulate, Usual, VolumeAtrous};

/// The passes of a volume, alone or after those of any preset for surfaces, whose guides they read.
/// \[PSVGF\]
///
/// Both share one graph: you schedule one list of passes and begin one frame, and the guide has one
/// owner. It reads `levels` (at least 2, since the first one writes the history) and
/// `firefly_filter` of the configuration.
pub fn volume(g: &mut Graph, guides: &Guides, config: &Config) -> Denoised {
    let volume = g.volume();
    let motion = g.volume_motion(guides, &volume);
    let mut radiance = g.volume_points(&volume);
    let usual = config.firefly_filter.then(|| {
        let percentiles = g.volume_percentiles(guides, &radiance);
        Usual { percentiles, limits: g.firefly_limits_of_frame(&radiance, &percentiles) }
    });
    if let Some(Usual { limits, .. }) = &usual {
        radiance = g.volume_firefly(guides, &radiance, limits);
    }
    let history = g.history(&radiance, Feedback::Filtered);
    let accumulated = g.volume_accumulation(guides, &radiance, &history, &motion);
    let estimate = g.volume_variance(guides, &accumulated, &history);
    let atrous = VolumeAtrous { levels: config.levels().max(2), feedback: Some(history), keeps_exposure: config.float_output };
    let filtered: Radiance = g.volume_atrous(guides, &estimate, atrous).into();
    let filtered = g.upsample_volume(guides, &filtered);
    // Its levels are of halves, and those hold it in the exposure of the filter alone.
    let modulate = Modulate { albedo: false, emission: false, float_output: true, ..Modulate::default() };
    let radiance = if config.float_output { g.modulate(guides, &filtered.cast(), modulate) } else { filtered };
    let intermediates =
        Intermediates { albedo: false, history: Some(history), deviation: true, usual, ..Intermediates::new(&volume.noisy()) };
    Denoised { radiance, intermediates }
}
