//! Picks a pixel in every stratum of the previous frame and finds it in this one, for your path
//! tracer to shade again. \[ASVGF\] 3.1, 3.3.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::gradient::check_stratum_size;
use super::pass;
use crate::contract::{Grid, Input, Lifetime, Phase};
use crate::graph::{GradientSamples, Graph, Guides, PACKED_32, PACKED_64};
use crate::shaders;

/// Parameters of the node `forward_project`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ForwardProject {
    /// Side of a stratum, 2 to 4 pixels. Default: 3.
    pub stratum_size: u32,
    /// Whether you have an image `forward_motion`, for deforming surfaces. Default: false.
    pub forward_motion: bool,
    /// Whether you have an image `surface_id`, by which `instance_transforms` are found. Default:
    /// true.
    pub surface_id: bool,
}

impl Default for ForwardProject {
    fn default() -> Self {
        Self { stratum_size: 3, forward_motion: false, surface_id: true }
    }
}

impl Graph {
    /// Samples that your path tracer shades again. Three passes: clear the claims, let the
    /// candidates of the previous frame claim strata, write down the winners.
    ///
    /// Make the result an output: `graph.output_samples("gradient_samples", &samples)`.
    pub fn forward_project(&mut self, guides: &Guides, project: ForwardProject) -> GradientSamples {
        let node = self.node("forward_project", "");
        let size = check_stratum_size(self, &node, project.stratum_size);
        let claims = self.named_image("gradient_claims", "", PACKED_32, size, Lifetime::Transient);
        let candidates = self.named_image("gradient_candidates", "", PACKED_64, size, Lifetime::History);
        let samples = self.named_image("projected_samples", "", PACKED_64, size, Lifetime::Transient);
        let forward_motion = project.forward_motion.then(|| self.input(Input::FORWARD_MOTION));
        let surface_id = project.surface_id.then(|| self.input(Input::SURFACE_ID));
        let transforms = self.input(Input::INSTANCE_TRANSFORMS);
        let module = |resolve: bool| match (resolve, project.forward_motion) {
            (false, false) => &shaders::FORWARD_PROJECT_RESOLVE_0_FORWARD_MOTION_0,
            (false, true) => &shaders::FORWARD_PROJECT_RESOLVE_0_FORWARD_MOTION_1,
            (true, false) => &shaders::FORWARD_PROJECT_RESOLVE_1_FORWARD_MOTION_0,
            (true, true) => &shaders::FORWARD_PROJECT_RESOLVE_1_FORWARD_MOTION_1,
        };
        let pass = |resolve: bool, name: &str| {
            pass(&node, module(resolve))
                .named(format!("{node}_{name}"))
                .phase(Phase::BeforeLighting)
                .grid(Grid::Strata(size))
                .constant("STRATUM_SIZE", size)
                .bind("guide", guides.guide)
                .previous("previous_guide", guides.guide)
                .previous("previous_candidates", candidates)
                .bind("instance_transforms", transforms)
                .bind_some("forward_motion", forward_motion)
        };
        self.clear_claims(&node, Phase::BeforeLighting, claims, size);
        self.add(pass(false, "claim").bind("claims", self.refreshed(claims)));
        let resolve = pass(true, "resolve")
            .bind("claims", self.refreshed(claims))
            .bind("gradient_samples", samples)
            .bind("candidates", candidates)
            .bind_some("surface_id", surface_id);
        self.add(resolve);
        GradientSamples { image: self.refreshed(samples), candidates: self.refreshed(candidates), stratum_size: size }
    }
}
