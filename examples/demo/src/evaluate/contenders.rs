//! The filters that are compared: the presets as a host gets them, and two more that comparisons of the papers want.

use atrous::config::{Preset, Signals};
use atrous::graph::{Feedback, Graph, Irradiance};
use atrous::nodes::{Accumulation, Eaw, Import, Modulate, Variance};
use atrous::{presets, Config, Declaration};
use atrous_demo::DenoiserOptions;

/// A filter with its name in tables.
pub struct Contender {
    /// Name in tables.
    pub name: &'static str,
    /// The denoiser.
    pub options: DenoiserOptions,
}

/// Name of the noisy picture in tables.
pub const NOISY: &str = "noisy";
/// EAW of the irradiance that was accumulated, which \[SVGF\] and \[ASVGF\] compare with.
pub const EAW_ACCUMULATED: &str = "EAW, accumulated";
/// SVGF on the light that all others have.
pub const SVGF: &str = "SVGF";
/// A-SVGF.
pub const ASVGF: &str = "A-SVGF";
/// The filter of choice, with reflections apart.
pub const BEST: &str = "best";

/// All of them, in the order of tables. A-SVGF, which has lighting of its own, is not the last: then the noisy picture is the one that all
/// others had.
pub fn all() -> Vec<Contender> {
    let of = |name, preset| Contender { name, options: DenoiserOptions::new(preset) };
    let together = |contender: Contender| Contender {
        options: DenoiserOptions { signals: Signals::Together, ..contender.options },
        ..contender
    };
    let mut accumulated = of(EAW_ACCUMULATED, Preset::Eaw);
    accumulated.options.graph = Some(eaw_accumulated);
    vec![
        of("EAW", Preset::Eaw),
        accumulated,
        together(of(SVGF, Preset::Svgf)),
        of("SVGF, direct and indirect apart", Preset::Svgf),
        of(ASVGF, Preset::Asvgf),
        of("percentile", Preset::Percentile),
        of("fast", Preset::Fast),
        together(of("best, one signal", Preset::Best)),
        of(BEST, Preset::Best),
    ]
}

fn eaw_accumulated(config: &Config) -> Result<Declaration, atrous::Error> {
    let mut g = Graph::new(config.allocated_extent).conventions(config.conventions).frames_in_flight(config.frames_in_flight);
    let guides = g.import(Import { surface_id: config.surface_id, ..Import::default() });
    let noisy = presets::noisy(&mut g, config.signals);
    let irradiance = g.demodulate(&guides, &noisy, Default::default());
    // As in SVGF, so that the spatial filter is all that differs.
    let history = g.history(&irradiance, Feedback::Filtered);
    let accumulated = g.temporal_accumulation(&guides, &irradiance, &history, Accumulation::default());
    let estimate = g.variance(&guides, &accumulated, &history, Variance::default());
    let spatial = Eaw { levels: config.levels(), weights: config.eaw_weights, feedback: Some(history), ..Eaw::default() };
    let filtered = g.eaw(&guides, &Irradiance::of(estimate.image()), spatial);
    let denoised = g.modulate(&guides, &filtered, Modulate::default());
    g.output("denoised_radiance", &denoised);
    if config.volume {
        let fog = presets::volume(&mut g, &guides, config);
        g.output("denoised_volume", &fog.radiance);
    }
    g.finish()
}
