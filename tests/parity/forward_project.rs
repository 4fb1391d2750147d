//! `forward_project`: equal to the bit.

use super::{Captured, Claims};
use atrous::reference::{forward_project, ForwardProjectInputs, PreviousCandidates};
use atrous::UseFrame;

/// The pass that claims strata: its result is compared when it was resolved.
pub fn keep_claims(c: &Captured) -> Claims {
    let claimed = c.written_uints_of("gradient_claims", c.strata()).texels().iter().filter(|key| **key != 0).count();
    Claims { claimed, guide: None }
}

/// The pass that writes the samples down.
pub fn check(c: &Captured, claims: &Claims) {
    let strata = c.strata();
    let (guide, previous_guide) = (c.packed("guide", UseFrame::Current), c.packed("guide", UseFrame::Previous));
    let candidates = c.packed_of("gradient_candidates", UseFrame::Previous, strata);
    let surface_id = c.has("surface_id").then(|| c.uints("surface_id", UseFrame::Current));
    let forward_motion = c.optional_host("forward_motion");
    let transforms = c.instance_transforms();
    let inputs = ForwardProjectInputs {
        guide: &guide,
        depth_gradient: &c.uints("depth_gradient", UseFrame::Current),
        surface_id: surface_id.as_ref(),
        previous: Some(PreviousCandidates { guide: &previous_guide, candidates: &candidates }),
        instance_transforms: transforms.as_deref(),
        forward_motion: forward_motion.as_ref(),
    };
    let twin = forward_project(&c.frame.constants, &inputs);
    c.assert_same_strata("gradient_samples", &c.written_packed_of("gradient_samples", strata), &twin.gradient_samples);
    c.assert_same_strata("gradient_candidates", &c.written_packed_of("gradient_candidates", strata), &twin.gradient_candidates);
    let samples = twin.gradient_samples.texels().iter().filter(|t| t[2] != 0).count();
    assert_eq!(samples, claims.claimed, "a claim without a sample");
}
