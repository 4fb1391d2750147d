//! The points: every preset for surfaces as it is, and `best` and `fast` with other spatial filters.

use atrous::config::Preset;
use atrous::graph::{Feedback, Graph, Guides};
use atrous::nodes::{Accumulation, Atrous, Demodulate, Estimator, GradientAtrous, Import, Kernel, Modulate, Variance};
use atrous::{presets, Config, Declaration, Error, Tuning};

/// A spatial filter: what a point changes of a preset.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Spatial {
    pub kernel: Kernel,
    pub levels: u32,
    /// Whether the deviation is blurred over 3×3 pixels before luminance is compared by it.
    pub smooth: bool,
}

/// A point.
#[derive(Clone, Debug)]
pub struct Filter {
    pub name: String,
    /// The preset that it is, or that it was made of.
    pub preset: Preset,
    /// `None`: the preset as it is.
    spatial: Option<Spatial>,
}

/// What the presets have that are varied.
const OWN: [(Preset, Spatial); 2] = [
    (Preset::Best, Spatial { kernel: Kernel::Box, levels: 4, smooth: true }),
    (Preset::Fast, Spatial { kernel: Kernel::Hexagon, levels: 5, smooth: true }),
];

const PRESETS: [Preset; 5] = [Preset::Svgf, Preset::Asvgf, Preset::Percentile, Preset::Fast, Preset::Best];

pub fn all() -> Vec<Filter> {
    let preset = |preset: Preset| Filter { name: preset.name().to_owned(), preset, spatial: None };
    let mut all: Vec<_> = PRESETS.map(preset).into();
    for (preset, own) in OWN {
        for (kernel, taps) in [(Kernel::Spline, 25), (Kernel::Box, 9), (Kernel::Hexagon, 7)] {
            for (levels, smooth) in (3..=5).flat_map(|levels| [true, false].map(|smooth| (levels, smooth))) {
                let spatial = Spatial { kernel, levels, smooth };
                let name = format!("{preset} {taps}×{levels}{}", if smooth { "" } else { " sharp" });
                all.extend((spatial != own).then_some(Filter { name, preset, spatial: Some(spatial) }));
            }
        }
    }
    all
}

impl Filter {
    pub fn tuning(&self) -> Tuning {
        Tuning::for_preset(self.preset)
    }

    /// The graph for a host that a configuration describes.
    pub fn declare(&self, host: &Config) -> Result<Declaration, Error> {
        let config = Config { preset: self.preset, levels: None, ..*host };
        match self.spatial {
            Some(spatial) => varied(&config, spatial),
            None => config.declare(),
        }
    }
}

/// [`presets::best`] or [`presets::fast`] of one signal, with another spatial filter.
fn varied(config: &Config, spatial: Spatial) -> Result<Declaration, Error> {
    let mut g = Graph::new(config.allocated_extent).conventions(config.conventions).frames_in_flight(config.frames_in_flight);
    let guides = g.import(Import { surface_id: config.surface_id, object_normal: config.object_normal });
    let Spatial { kernel, levels, smooth } = spatial;
    let atrous = Atrous { kernel, levels, smooth_deviation: smooth, ..Atrous::default() };
    match config.preset {
        Preset::Best => best(&mut g, &guides, config, atrous),
        _ => fast(&mut g, &guides, atrous),
    }
    g.finish()
}

fn best(g: &mut Graph, guides: &Guides, config: &Config, atrous: Atrous) {
    let gradients = presets::gradient_samples(g, guides, config);
    let noisy = g.radiance("noisy_radiance");
    let gradient = gradients.map(|source| {
        let gradient = g.gradient_and_ratio(guides, &noisy, source);
        g.gradient_atrous(guides, &gradient, GradientAtrous::default())
    });
    let samples = gradients.and_then(|gradients| gradients.samples());
    let irradiance = g.demodulate(guides, &noisy, Demodulate { gradient, samples, ..Demodulate::default() });
    let percentiles = g.block_percentiles(guides, &irradiance, config.block_sort);
    let irradiance = g.firefly(guides, &irradiance, &percentiles);
    let history = g.history(&irradiance, Feedback::Accumulated);
    let confidence = match &gradient {
        Some(gradient) => {
            let difference = g.block_difference(guides, &irradiance, &history);
            let tested = g.scope("tested", |g| g.change_test(&difference));
            g.adaptive_alpha_or(gradient, &tested)
        }
        None => g.host_confidence(),
    };
    let light_ratio = gradient.and_then(|gradient| gradient.light_ratio());
    let accumulation = Accumulation { confidence: Some(confidence), sharp: true, light_ratio, ..Accumulation::default() };
    let accumulated = g.temporal_accumulation(guides, &irradiance, &history, accumulation);
    let variance = Variance { estimator: Estimator::Fading, averaged: true, ..Variance::default() };
    let estimate = g.variance(guides, &accumulated, &history, variance);
    let filtered = g.atrous(guides, &estimate, Atrous { shared_deviation: true, ..atrous });
    let denoised = g.modulate(guides, &filtered.into(), Modulate::default());
    g.output("denoised_radiance", &denoised);
    g.output("history_confidence", &confidence);
}

fn fast(g: &mut Graph, guides: &Guides, atrous: Atrous) {
    let noisy = g.radiance("noisy_radiance");
    let irradiance = g.demodulate(guides, &noisy, Demodulate::default());
    let history = g.history(&irradiance, Feedback::Filtered);
    let difference = g.block_difference(guides, &irradiance, &history);
    let confidence = g.change_test(&difference);
    let accumulation = Accumulation { confidence: Some(confidence), ..Accumulation::default() };
    let accumulated = g.temporal_accumulation(guides, &irradiance, &history, accumulation);
    let estimate = g.variance(guides, &accumulated, &history, Variance::default());
    let filtered = g.atrous(guides, &estimate, Atrous { feedback: Some(history), ..atrous });
    let denoised = g.modulate(guides, &filtered.into(), Modulate::default());
    g.output("denoised_radiance", &denoised);
    g.output("history_confidence", &confidence);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// So that a change of a preset is not forgotten here.
    #[test]
    fn what_a_preset_has_gives_the_passes_of_the_preset() {
        for (preset, own) in OWN {
            let config = Config { preset, ..Config::new([64, 36]) };
            let passes = |declaration: Declaration| format!("{:?} {:?}", declaration.passes(), declaration.resources());
            let [varied, whole] = [varied(&config, own), config.declare()].map(|declared| passes(declared.expect("a graph")));
            assert_eq!(varied, whole, "{preset}");
            let other = Spatial { levels: 3, ..own };
            assert_ne!(passes(super::varied(&config, other).expect("a graph")), whole, "{preset}");
        }
    }
}
