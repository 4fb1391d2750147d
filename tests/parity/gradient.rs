//! `gradient`, `gradient_atrous` and `adaptive_alpha`.

use super::compare::{Tolerance, HALF};
use super::{each, Captured};
use atrous::config::GradientSource;
use atrous::reference::{
    adaptive_alpha, gradient, gradient_atrous, AdaptiveAlphaInput, GradientAtrousInputs, GradientInput, GradientInputs,
};
use atrous::UseFrame;

pub fn check(c: &Captured) {
    let strata = c.strata();
    let noisy: Vec<_> = c.noisy().iter().map(|name| c.host(name)).collect();
    let albedo = c.optional_host("albedo");
    let keeps_luminance = c.config.gradient_source != GradientSource::Sparse;
    let previous_luminance = keeps_luminance.then(|| c.uints("noisy_luminance", UseFrame::Previous));
    let samples = c.has("gradient_samples").then(|| c.packed_of("gradient_samples", UseFrame::Current, strata));
    let reshaded_radiance = c.optional_host("reshaded_radiance");
    let is_reshaded = c.config.gradient_source == GradientSource::Reshaded;
    let reshaded = is_reshaded.then(|| {
        let (previous_guide, surface_motion) =
            (c.packed("guide", UseFrame::Previous), c.packed("surface_motion", UseFrame::Current));
        (previous_guide, surface_motion, c.uints("depth_gradient", UseFrame::Current))
    });
    let sparse = c.has("sparse_gradient").then(|| c.host_of("sparse_gradient", strata));
    let source = match (&samples, &reshaded) {
        (Some(gradient_samples), _) => GradientInput::ForwardProjected { gradient_samples },
        (_, Some((previous_guide, surface_motion, depth_gradient))) => GradientInput::Reshaded {
            reshaded_radiance: reshaded_radiance.as_ref(),
            previous_guide: Some(previous_guide),
            surface_motion,
            depth_gradient,
        },
        _ => GradientInput::Sparse(sparse.as_ref()),
    };
    let inputs = GradientInputs {
        guide: &c.packed("guide", UseFrame::Current),
        noisy: &each(&noisy),
        albedo: albedo.as_ref(),
        previous_luminance: previous_luminance.as_ref(),
        source,
    };
    let twin = gradient(&c.frame.constants, c.tuning, c.config.stratum_size, &inputs);
    // A half of the luminance may be rounded either way, and a gradient is the difference of two.
    let tolerance = Tolerance { relative: 3e-3, absolute: 3e-3, outliers: if is_reshaded { 2e-3 } else { 0.0 } };
    c.compare_strata("gradient_ping", &c.written_halves_of("gradient_ping", strata), &twin.gradient, tolerance);
    c.assert_same_strata("gradient_guide", &c.written_packed_of("gradient_guide", strata), &twin.gradient_guide);
    if keeps_luminance {
        let as_halves = |packed: u32| [packed as u16, (packed >> 16) as u16].map(|b| half::f16::from_bits(b).to_f32());
        super::compare::texels("noisy_luminance", c, &c.written_uints("noisy_luminance"), &twin.noisy_luminance, HALF, as_halves);
    }
}

pub fn check_atrous(c: &Captured, level: u32) {
    let strata = c.strata();
    let (from, to) = if level & 1 == 0 { ("gradient_ping", "gradient_pong") } else { ("gradient_pong", "gradient_ping") };
    let inputs = GradientAtrousInputs {
        gradient_guide: &c.packed_of("gradient_guide", UseFrame::Current, strata),
        depth_gradient: &c.uints("depth_gradient", UseFrame::Current),
        gradient: &c.halves_of(from, UseFrame::Current, strata),
    };
    let twin = gradient_atrous(&c.frame.constants, c.tuning, c.config.stratum_size, level, &inputs);
    let tolerance = Tolerance { relative: 3e-3, absolute: 5e-4, ..HALF };
    c.compare_strata(&format!("{to} of level {level}"), &c.written_halves_of(to, strata), &twin, tolerance);
}

pub fn check_alpha(c: &Captured) {
    let strata = c.strata();
    let gradient = c.has("gradient_pong").then(|| c.halves_of("gradient_pong", UseFrame::Current, strata));
    let confidence = c.optional_host("confidence");
    let input = match (&gradient, &confidence) {
        (Some(gradient), _) => AdaptiveAlphaInput::Gradient { gradient, stratum_size: c.config.stratum_size },
        (_, Some(confidence)) => AdaptiveAlphaInput::Confidence(confidence),
        _ => panic!("neither a gradient nor a confidence"),
    };
    let twin = adaptive_alpha(&c.frame.constants, c.tuning, c.config.allocated_extent, input);
    super::compare::texels("history_confidence", c, &c.written_floats("history_confidence"), &twin, HALF, |v| [v]);
}
