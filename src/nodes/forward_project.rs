//! Picks a pixel in every stratum of the previous frame and finds it in this one, for the host to shade again. \[ASVGF\] 3.1, 3.3.

use super::{Builder, Frame, Guides, Strata, HOST_COLOUR, HOST_ID, PACKED_32, PACKED_64};
use crate::config::Config;
use crate::contract::{Lifetime, Phase, ResourceId};
use crate::shaders;

/// Three passes: clear the claims, let the candidates of the previous frame claim strata, write down who won. Returns `gradient_samples`.
pub(crate) fn forward_project(b: &mut Builder, frame: Frame, guides: Guides, strata: Strata, config: &Config) -> ResourceId {
    let claims = b.stratum_image("gradient_claims", strata, PACKED_32, Lifetime::Transient);
    let candidates = b.stratum_image("gradient_candidates", strata, PACKED_64, Lifetime::History);
    let samples = b.stratum_image("gradient_samples", strata, PACKED_64, Lifetime::Output);
    let mut shared = vec![
        frame.constants.uniform(),
        frame.statistics.updated(),
        guides.guide.sampled(),
        guides.guide.previous(),
        guides.depth_gradient.sampled(),
        candidates.previous(),
        b.instance_transforms().storage(),
    ];
    if config.forward_motion {
        shared.push(b.input("forward_motion", HOST_COLOUR, false).sampled());
    }
    b.clear("forward_project_clear", Phase::BeforeLighting, claims);
    let shader = match config.forward_motion {
        false => &shaders::FORWARD_PROJECT_RESOLVE_0_FORWARD_MOTION_0,
        true => &shaders::FORWARD_PROJECT_RESOLVE_0_FORWARD_MOTION_1,
    };
    let claim = shared.iter().copied().chain([claims.updated()]).collect();
    b.dispatch_strata("forward_project_claim", Phase::BeforeLighting, shader, strata, 0, claim);
    let mut resolve: Vec<_> = shared.into_iter().chain([claims.sampled(), samples.written(), candidates.written()]).collect();
    if config.surface_id {
        resolve.push(b.input("surface_id", HOST_ID, false).sampled());
    }
    let shader = match (config.forward_motion, config.surface_id) {
        (false, false) => &shaders::FORWARD_PROJECT_RESOLVE_1_FORWARD_MOTION_0_SURFACE_ID_0,
        (false, true) => &shaders::FORWARD_PROJECT_RESOLVE_1_FORWARD_MOTION_0_SURFACE_ID_1,
        (true, false) => &shaders::FORWARD_PROJECT_RESOLVE_1_FORWARD_MOTION_1_SURFACE_ID_0,
        (true, true) => &shaders::FORWARD_PROJECT_RESOLVE_1_FORWARD_MOTION_1_SURFACE_ID_1,
    };
    b.dispatch_strata("forward_project_resolve", Phase::BeforeLighting, shader, strata, 0, resolve);
    samples
}
