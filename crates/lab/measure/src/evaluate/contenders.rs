//! The filters that are compared: the presets as a host gets them, and two more that comparisons of the papers want.

use atrous::config::{EawWeights, Preset, Signals};
use atrous::graph::{Estimate, Feedback, Graph, Guides, History, Irradiance, Value};
use atrous::nodes::{Accumulation, Atrous, Eaw, Intermediates, Modulate, Variance};
use atrous::presets::{self, Denoised};
use atrous::{Config, Declaration};
use atrous_engine::denoiser::GraphOfConfig;
use atrous_engine::DenoiserOptions;

/// A filter with its name in tables.
pub struct Contender {
    /// Name in tables.
    pub name: &'static str,
    /// The denoiser.
    pub options: DenoiserOptions,
    /// Name of the filter before it whose picture it takes instead of the noisy one.
    pub over: Option<&'static str>,
}

impl Contender {
    /// A preset as a host gets it.
    pub fn new(name: &'static str, preset: Preset) -> Self {
        Self { name, options: DenoiserOptions::new(preset), over: None }
    }

    /// The same with a number set.
    ///
    /// # Errors
    /// A number that does not exist, or is out of range.
    pub fn with(mut self, number: &str, value: f32) -> crate::Result<Self> {
        self.options.tuning.set(number, value)?;
        Ok(self)
    }
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
/// The filter of choice on the light that all others have.
pub const ONE_SIGNAL: &str = "best, one signal";
/// The filter of choice, and the sun's visibility filtered by itself.
pub const BEST_AND_SUN: &str = "best, visibility apart";
/// Wavelets that stop at no edge, of accumulated light.
pub const PLAIN: &str = "plain à-trous, accumulated";
/// A bilateral filter by normals and depth alone, of accumulated light.
pub const JOINT: &str = "joint bilateral, accumulated";

/// Those of every scene, in the order of tables. A-SVGF, which has lighting of its own, is not the last: then the noisy picture is the one that
/// all others had.
pub fn all() -> Vec<Contender> {
    let together = |contender: Contender| Contender {
        options: contender.options.with(|config| config.signals = Signals::Together),
        ..contender
    };
    let graph = |name, preset, graph: GraphOfConfig| {
        let contender = together(Contender::new(name, preset));
        Contender { options: DenoiserOptions { graph: Some(graph), ..contender.options }, ..contender }
    };
    vec![
        Contender::new("EAW", Preset::Eaw),
        graph(PLAIN, Preset::Eaw, plain),
        graph(JOINT, Preset::Svgf, joint_bilateral),
        graph(EAW_ACCUMULATED, Preset::Eaw, eaw_accumulated),
        together(Contender::new(SVGF, Preset::Svgf)),
        Contender::new("SVGF, direct and indirect apart", Preset::Svgf),
        Contender::new(ASVGF, Preset::Asvgf),
        Contender::new("percentile", Preset::Percentile),
        Contender::new("fast", Preset::Fast),
        together(Contender::new(ONE_SIGNAL, Preset::Best)),
        Contender::new(BEST, Preset::Best),
    ]
}

/// Some of [`all`], in its order.
pub fn named(names: &[&str]) -> Vec<Contender> {
    all().into_iter().filter(|contender| names.contains(&contender.name)).collect()
}

/// Those of scenes with a sun, which is rendered apart from all other light for them.
pub fn of_sun() -> Vec<Contender> {
    vec![Contender::new(BEST_AND_SUN, Preset::Best)]
}

/// Wavelets without edge-stopping functions. Their history is not filtered: it would blur without end.
fn plain(config: &Config) -> Result<Declaration, atrous::Error> {
    accumulated(config, Feedback::Accumulated, |g, guides, estimate, _| {
        let spatial = Eaw { levels: config.levels(), weights: EawWeights::first(0), ..Eaw::default() };
        g.eaw(guides, &Irradiance::of(estimate.image()), spatial)
    })
}

/// The wavelets of SVGF with its weights by normal and depth, and none by luminance: level by level as wide as one of a hundred taps a side,
/// which is no public node.
fn joint_bilateral(config: &Config) -> Result<Declaration, atrous::Error> {
    accumulated(config, Feedback::Accumulated, |g, guides, estimate, _| {
        let spatial = Atrous { levels: config.levels(), sigma_l: Value::Fixed(1.0e6), ..Atrous::default() };
        g.atrous(guides, estimate, spatial).into()
    })
}

fn eaw_accumulated(config: &Config) -> Result<Declaration, atrous::Error> {
    // As in SVGF, so that the spatial filter is all that differs.
    accumulated(config, Feedback::Filtered, |g, guides, estimate, history| {
        let spatial = Eaw { levels: config.levels(), weights: config.eaw_weights, feedback: Some(history), ..Eaw::default() };
        g.eaw(guides, &Irradiance::of(estimate.image()), spatial)
    })
}

/// The accumulation of SVGF, with another filter behind it.
fn accumulated(
    config: &Config,
    feedback: Feedback,
    spatial: impl FnOnce(&mut Graph, &Guides, &Estimate, History) -> Irradiance,
) -> Result<Declaration, atrous::Error> {
    let filter = |g: &mut Graph, guides: &Guides, config: &Config| {
        let noisy = presets::noisy(g, config.signals);
        let irradiance = g.demodulate(guides, &noisy, Default::default());
        let history = g.history(&irradiance, feedback);
        let accumulated = g.temporal_accumulation(guides, &irradiance, &history, Accumulation::default());
        let estimate = g.variance(guides, &accumulated, &history, Variance::default());
        let filtered = spatial(g, guides, &estimate, history);
        Denoised { radiance: g.modulate(guides, &filtered, Modulate::default()), intermediates: Intermediates::new(&noisy) }
    };
    config.graph_with(filter)?.finish()
}
