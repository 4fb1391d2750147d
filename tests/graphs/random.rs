//! Random graphs that make sense: a seed says which nodes there are, and with which parameters.

use super::dice::Dice;
use atrous::config::{Conventions, EawWeights, Sampling};
use atrous::graph::{
    Accumulated, Confidence, Estimate, Feedback, Gradient, GradientSamples, Graph, Guides, History, Irradiance, Radiance, Value,
    Visibility,
};
use atrous::nodes::*;
use atrous::presets::{specular, Specular};
use atrous::{Config, Declaration, Setup};

/// The declaration of a seed.
pub fn declare(seed: u32, extent: [u32; 2]) -> Declaration {
    declare_with(seed, extent, Conventions::default())
}

/// [`declare`] for a host with these conventions.
pub fn declare_with(seed: u32, extent: [u32; 2], conventions: Conventions) -> Declaration {
    let mut dice = Dice::new(seed);
    let mut g = Graph::of(Setup { frames_in_flight: 1 + dice.below(3), conventions, ..Setup::new(extent) });
    // `material_class`, `albedo`, and the exposure below, without a throw of the dice, so that other seeds stay what they were.
    let guides = g.import(Import {
        surface_id: dice.coin(),
        object_normal: dice.coin(),
        material_class: seed % 5 == 2,
        albedo: seed % 4 != 1,
    });
    if seed % 3 == 2 {
        let light = g.radiance("noisy_radiance");
        g.filter_exposure(&[light]);
    }
    let mut surfaces = surfaces(&mut g, &mut dice, &guides, "denoised_radiance");
    if dice.coin() {
        g.scope("again", |g| self::surfaces(g, &mut dice, &guides, "denoised_again"));
    }
    if dice.coin() {
        ambient_occlusion(&mut g, &mut dice, &guides);
    }
    if seed % 3 == 1 {
        let lights = Lights { count: 1 + seed / 3 % 4, coloured: dice.coin(), ambient: false };
        let samples = g.visibility_samples(&guides, lights);
        let accumulated = g.visibility_accumulation(&guides, &samples);
        let visibility = g.visibility_filter(&guides, &accumulated, 1 + seed / 3 % 4);
        surfaces.radiance = g.shadowed_light(&surfaces.radiance, &visibility);
        for (light, image) in visibility.images().iter().enumerate() {
            g.output(&format!("denoised_visibility_of_{light}"), &Visibility::of(*image));
        }
    }
    let fog = dice.coin().then(|| volume(&mut g, &mut dice, &guides));
    if dice.coin() {
        let radiance = fog.as_ref().map_or(surfaces.radiance, |fog| g.pair(&surfaces.radiance, &fog.radiance));
        let radiance =
            if dice.coin() { g.temporal_upscale(&guides, &radiance, TemporalUpscale { tone_mapped: true }) } else { radiance };
        let display = g.tone_map(&radiance);
        g.output("display", &display);
    }
    if dice.coin() {
        let shown = fog.filter(|_| dice.coin()).map_or(surfaces.intermediates, |fog| fog.intermediates);
        let view = g.debug_view(&guides, &shown);
        g.output("debug_view", &view);
    }
    g.finish().expect("a graph that makes sense")
}

/// What a filter leaves.
struct Branch {
    radiance: Radiance,
    intermediates: Intermediates,
}

/// How far history is still true, and what says so.
#[derive(Default)]
struct Change {
    confidence: Option<Confidence>,
    gradient: Option<Gradient>,
    samples: Option<GradientSamples>,
}

#[derive(Clone, Copy, PartialEq)]
enum Rule {
    None,
    ChangeTest,
    Percentiles,
    Gradients,
    HostConfidence,
}

/// A filter of the host's radiance, one or two signals.
fn surfaces(g: &mut Graph, dice: &mut Dice, guides: &Guides, output: &str) -> Branch {
    let noisy = if dice.coin() {
        g.radiance("noisy_radiance")
    } else {
        let (direct, indirect) = (g.radiance("noisy_direct"), g.radiance("noisy_indirect"));
        g.pair(&direct, &indirect)
    };
    let albedo = dice.coin();
    if dice.below(6) == 0 {
        return without_history(g, dice, guides, &noisy, albedo, output);
    }
    let rule =
        dice.one_of(&[Rule::None, Rule::ChangeTest, Rule::Percentiles, Rule::Gradients, Rule::Gradients, Rule::HostConfidence]);
    let mut change = change_of_light(g, dice, guides, &noisy, rule, output);
    let Change { gradient, samples, .. } = change;
    let sampling = match rule {
        Rule::None | Rule::HostConfidence => dice.one_of(&[Sampling::OneOf2x2, Sampling::OneOf4x4]),
        // Without a throw of the dice, so that other seeds stay what they were.
        _ => dice.clone().one_of(&[Sampling::Full, Sampling::OneOf2x2, Sampling::OneOf4x4]),
    };
    let demodulate = Demodulate { albedo: divisor(albedo), gradient, samples, sampling };
    let irradiance = g.demodulate(guides, &noisy, demodulate);
    let (irradiance, usual) = without_fireflies(g, dice, guides, irradiance, rule == Rule::Percentiles);
    let irradiance = g.fill_holes(guides, &irradiance, sampling);
    let feedback = dice.one_of(&[Feedback::Filtered, Feedback::Accumulated]);
    let history = g.history(&irradiance, feedback);
    match (rule, &usual) {
        (Rule::ChangeTest, _) => {
            let difference = g.block_difference(guides, &irradiance, &history);
            change.confidence = Some(g.change_test(&difference));
        }
        (Rule::Percentiles, Some(usual)) => change.confidence = Some(g.percentile_rule(guides, &usual.percentiles, &history)),
        _ => {}
    }
    let alpha = dice.one_of(&[Value::Own, Value::Fixed(0.05), Value::Tunable("volume_alpha")]);
    let accumulation = Accumulation { confidence: change.confidence, repair: dice.coin(), alpha, ..Accumulation::default() };
    let accumulated = g.temporal_accumulation(guides, &irradiance, &history, accumulation);
    let filter = Filter { guides, history, feedback, other: &format!("{output}_by_the_other_kernel"), albedo };
    let (filtered, deviation) = filter.add(g, dice, &accumulated);
    let (filtered, specular) = beside_specular(g, dice, guides, filtered, change.confidence);
    // Without a throw of the dice, so that other seeds stay what they were.
    let detail = (feedback == Feedback::Accumulated && !specular && dice.clone().coin()).then_some(history);
    // Never mixed: the light that comes is not divided by the coat.
    let radiance = g.modulate(
        guides,
        &filtered,
        Modulate { albedo, mixed: false, specular, emission: dice.coin(), float_output: dice.coin(), detail },
    );
    g.output(output, &radiance);
    if let Some(confidence) = change.confidence.filter(|_| dice.coin()) {
        g.output(&format!("{output}_confidence"), &confidence);
    }
    let Change { confidence, gradient, .. } = change;
    let intermediates =
        Intermediates { albedo, history: Some(history), deviation, confidence, gradient, usual, ..Intermediates::new(&noisy) };
    Branch { radiance, intermediates }
}

fn divisor(albedo: bool) -> Albedo {
    if albedo {
        Albedo::Diffuse
    } else {
        Albedo::None
    }
}

/// One signal in two has specular light beside it.
fn beside_specular(
    g: &mut Graph,
    dice: &mut Dice,
    guides: &Guides,
    filtered: Irradiance,
    confidence: Option<Confidence>,
) -> (Irradiance, bool) {
    if filtered.signals() != 1 || !dice.coin() {
        return (filtered, false);
    }
    let feedback = dice.one_of(&[Feedback::Filtered, Feedback::Accumulated]);
    let parameters = Specular { feedback, confidence, ..Specular::default() };
    let kernel = dice.one_of(&Kernel::ALL);
    let spatial = Atrous { kernel, levels: levels(dice), luminance_weight: LuminanceWeight::OfMeans, ..Atrous::default() };
    let specular = specular(g, guides, &Config::new([8, 8]), parameters, spatial).0;
    (g.pair(&filtered, &specular), true)
}

/// \[EAW\], of which some paint in holes.
fn without_history(g: &mut Graph, dice: &mut Dice, guides: &Guides, noisy: &Radiance, albedo: bool, output: &str) -> Branch {
    let sampling = dice.one_of(&[Sampling::Full, Sampling::OneOf2x2]);
    let irradiance = g.demodulate(guides, noisy, Demodulate { albedo: divisor(albedo), sampling, ..Demodulate::default() });
    let (irradiance, usual) = without_fireflies(g, dice, guides, irradiance, false);
    let weights = EawWeights::first(1 + dice.below(3));
    let filtered = g.eaw(guides, &irradiance, Eaw { levels: levels(dice), weights, sampling, ..Eaw::default() });
    let radiance =
        g.modulate(guides, &filtered, Modulate { albedo, emission: dice.coin(), float_output: dice.coin(), ..Modulate::default() });
    g.output(output, &radiance);
    Branch { radiance, intermediates: Intermediates { albedo, usual, ..Intermediates::new(noisy) } }
}

/// What comes before the history: gradients of each source, or what the host knows.
fn change_of_light(g: &mut Graph, dice: &mut Dice, guides: &Guides, noisy: &Radiance, rule: Rule, output: &str) -> Change {
    if rule == Rule::HostConfidence {
        return Change { confidence: Some(g.host_confidence()), ..Change::default() };
    }
    if rule != Rule::Gradients {
        return Change::default();
    }
    // The image `sparse_gradient` has one size, so every branch has strata of one size.
    let stratum_size = dice.same(2, 3);
    let source = match dice.below(3) {
        0 => {
            let project = ForwardProject { stratum_size, forward_motion: dice.coin(), surface_id: dice.coin() };
            let samples = g.forward_project(guides, project);
            g.output_samples(&format!("{output}_samples"), &samples);
            Gradients::ForwardProjected(samples)
        }
        1 => Gradients::Reshaded { stratum_size },
        _ => Gradients::Sparse { stratum_size },
    };
    let gradient = g.gradient(guides, noisy, source);
    let gradient = if dice.coin() { g.gradient_atrous(guides, &gradient) } else { gradient };
    let samples = source.samples();
    Change { confidence: Some(g.history_confidence(&gradient, None)), gradient: Some(gradient), samples }
}

fn without_fireflies(
    g: &mut Graph,
    dice: &mut Dice,
    guides: &Guides,
    irradiance: Irradiance,
    wanted: bool,
) -> (Irradiance, Option<Usual>) {
    if !wanted && dice.coin() {
        return (irradiance, None);
    }
    let percentiles = g.block_percentiles(guides, &irradiance);
    let limits = match dice.coin() {
        true => g.firefly_limits(guides, &irradiance, &percentiles),
        false => g.firefly_limits_of_frame(&irradiance, &percentiles),
    };
    let irradiance = if dice.coin() { g.firefly(guides, &irradiance, &limits) } else { irradiance };
    (irradiance, Some(Usual { percentiles, limits }))
}

fn levels(dice: &mut Dice) -> u32 {
    if dice.below(8) == 0 {
        10
    } else {
        1 + dice.below(5)
    }
}

/// What a spatial filter hangs on.
struct Filter<'a> {
    guides: &'a Guides,
    history: History,
    feedback: Feedback,
    /// Name of the output of a second filter, where there is one.
    other: &'a str,
    albedo: bool,
}

impl Filter<'_> {
    /// À-trous, EAW in its place, or nothing. Says whether the history has the standard deviation.
    fn add(&self, g: &mut Graph, dice: &mut Dice, accumulated: &Accumulated) -> (Irradiance, bool) {
        let &Self { guides, history, feedback, .. } = self;
        let fed_back = (feedback == Feedback::Filtered).then_some(history);
        let estimate =
            |g: &mut Graph, estimator| g.variance(guides, accumulated, &history, Variance { estimator, ..Variance::default() });
        match dice.below(6) {
            0 if fed_back.is_none() => (estimate(g, Estimator::Temporal).into(), false),
            1 => {
                let eaw = Eaw { levels: levels(dice), feedback: fed_back, ..Eaw::default() };
                let accumulated = estimate(g, Estimator::Temporal).into();
                (g.eaw(guides, &accumulated, eaw), false)
            }
            _ => {
                let estimator = dice.one_of(&[Estimator::Switched, Estimator::Fading, Estimator::OfMean]);
                let estimate = estimate(g, estimator);
                let kernel = dice.one_of(&Kernel::ALL);
                let sigma_l = dice.one_of(&[Value::Own, Value::Fixed(1.5), Value::Tunable("volume_sigma_l")]);
                let luminance_weight = dice.one_of(&[LuminanceWeight::Published, LuminanceWeight::OfMeans]);
                let shape = Atrous { levels: levels(dice), kernel, luminance_weight, ..Atrous::default() };
                let atrous = Atrous { feedback: fed_back, sigma_l, ..shape };
                if dice.coin() {
                    self.other_kernel(g, dice, &estimate, kernel);
                }
                (g.atrous(guides, &estimate, atrous).into(), fed_back.is_some())
            }
        }
    }

    /// A second filter of the same estimate.
    fn other_kernel(&self, g: &mut Graph, dice: &mut Dice, estimate: &Estimate, kernel: Kernel) {
        let kernel = if kernel == Kernel::Box { Kernel::Spline } else { Kernel::Box };
        let radiance = g.scope("other", |g| {
            let filtered = g.atrous(self.guides, estimate, Atrous { levels: levels(dice), kernel, ..Atrous::default() });
            g.modulate(self.guides, &filtered.into(), Modulate { albedo: self.albedo, emission: false, ..Modulate::default() })
        });
        g.output(self.other, &radiance);
    }
}

/// A signal of its own, which no albedo divides.
fn ambient_occlusion(g: &mut Graph, dice: &mut Dice, guides: &Guides) {
    let noisy = g.radiance("noisy_ao");
    let irradiance = g.demodulate(guides, &noisy, Demodulate { albedo: Albedo::None, ..Demodulate::default() });
    let feedback = dice.one_of(&[Feedback::Filtered, Feedback::Accumulated]);
    let history = g.history(&irradiance, feedback);
    let accumulation =
        Accumulation { alpha: Value::Fixed(0.02), max_history_length: Value::Fixed(48.0), ..Accumulation::default() };
    let accumulated = g.temporal_accumulation(guides, &irradiance, &history, accumulation);
    let filter = Filter { guides, history, feedback, other: "denoised_ao_by_the_other_kernel", albedo: false };
    let (filtered, _) = filter.add(g, dice, &accumulated);
    let radiance = g.modulate(guides, &filtered, Modulate { albedo: false, emission: false, ..Modulate::default() });
    g.output("denoised_ao", &radiance);
}

fn volume(g: &mut Graph, dice: &mut Dice, guides: &Guides) -> Branch {
    let volume = g.volume();
    let motion = g.volume_motion(guides, &volume);
    let mut radiance = g.volume_points(&volume);
    let usual = dice.coin().then(|| {
        let percentiles = g.volume_percentiles(guides, &radiance);
        Usual { percentiles, limits: g.firefly_limits_of_frame(&radiance, &percentiles) }
    });
    if let Some(Usual { limits, .. }) = &usual {
        radiance = g.volume_firefly(guides, &radiance, limits);
    }
    let feedback = dice.one_of(&[Feedback::Filtered, Feedback::Accumulated]);
    let history = g.history(&radiance, feedback);
    let accumulated = g.volume_accumulation(guides, &radiance, &history, &motion);
    let estimate = g.volume_variance(guides, &accumulated, &history);
    let fed_back = (feedback == Feedback::Filtered).then_some(history);
    // The first level is the history, which cannot be an output.
    let levels = levels(dice).max(if fed_back.is_some() { 2 } else { 1 });
    let filtered =
        g.volume_atrous(guides, &estimate, VolumeAtrous { levels, feedback: fed_back, ..VolumeAtrous::default() }).into();
    g.output("denoised_volume", &filtered);
    let deviation = fed_back.is_some();
    let intermediates =
        Intermediates { albedo: false, history: Some(history), deviation, usual, ..Intermediates::new(&volume.noisy()) };
    Branch { radiance: filtered, intermediates }
}
