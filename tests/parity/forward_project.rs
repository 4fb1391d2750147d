//! `forward_project`: equal to the bit.

use super::Captured;
use atrous::reference::{
    forward_project_claim, forward_project_resolve, ForwardProjectInputs, Image, InstanceTransform, PreviousCandidates,
};
use atrous::UseFrame;

/// What both passes read.
struct Read {
    guide: Image<[u16; 4]>,
    depth_gradient: Image<u32>,
    previous_guide: Image<[u16; 4]>,
    candidates: Image<[u16; 4]>,
    forward_motion: Option<Image<[f32; 4]>>,
    transforms: Option<Vec<InstanceTransform>>,
}

impl Read {
    fn new(c: &Captured) -> Self {
        Self {
            guide: c.packed("guide", UseFrame::Current),
            depth_gradient: c.uints("depth_gradient", UseFrame::Current),
            previous_guide: c.packed("guide", UseFrame::Previous),
            candidates: c.packed_of("gradient_candidates", UseFrame::Previous, c.strata()),
            forward_motion: c.optional_host("forward_motion"),
            transforms: c.instance_transforms(),
        }
    }

    fn inputs(&self, c: &Captured) -> ForwardProjectInputs<'_> {
        ForwardProjectInputs {
            guide: &self.guide,
            depth_gradient: &self.depth_gradient,
            previous: Some(PreviousCandidates { guide: &self.previous_guide, candidates: &self.candidates }),
            instance_transforms: self.transforms.as_deref(),
            forward_motion: self.forward_motion.as_ref(),
            stratum_size: c.config.stratum_size,
        }
    }
}

pub fn check_claims(c: &Captured) {
    let read = Read::new(c);
    let mut twin = Image::new(c.strata(), 0);
    forward_project_claim(&c.frame.constants, c.tuning, &read.inputs(c), &mut twin);
    assert_eq!(c.written_uints_of("gradient_claims", c.strata()), twin);
}

pub fn check(c: &Captured) {
    let (strata, read) = (c.strata(), Read::new(c));
    let claims = super::captured::image_of(c.bytes("gradient_claims", UseFrame::Current), strata);
    let surface_id = c.has("surface_id").then(|| c.uints("surface_id", UseFrame::Current));
    let twin = forward_project_resolve(&c.frame.constants, c.tuning, &read.inputs(c), &claims, surface_id.as_ref());
    c.assert_same_strata("gradient_samples", &c.written_packed_of("gradient_samples", strata), &twin.gradient_samples);
    c.assert_same_strata("gradient_candidates", &c.written_packed_of("gradient_candidates", strata), &twin.gradient_candidates);
}
