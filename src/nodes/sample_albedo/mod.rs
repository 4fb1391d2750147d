//! Divides the light of gradient samples by the albedo of the points that it comes from. The node `demodulate` adds it.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::pass;
use crate::contract::{Grid, Lifetime};
use crate::graph::{GradientSamples, Graph, Guides, Image, Irradiance, HDR};
use crate::nodes::demodulate::Divisor;
use crate::shaders;

impl Graph {
    /// In place, behind the pass that divided by the albedo of the pixels themselves.
    pub(super) fn sample_albedo(&mut self, guides: &Guides, irradiance: &Irradiance, divisor: Divisor, samples: &GradientSamples) {
        let label = self.label_of(irradiance);
        let node = self.node("sample_albedo", &label);
        let size = samples.stratum_size;
        let labels = match divisor.of_each {
            true => irradiance.images().iter().map(|image| self.label(*image).to_owned()).collect(),
            false => vec![label],
        };
        let kept = labels.iter().map(|label| self.named_image("candidate_albedo", label, HDR, size, Lifetime::History));
        let kept: Vec<Image> = kept.collect();
        let pass = pass(&node, &shaders::SAMPLE_ALBEDO)
            .grid(Grid::Strata(size))
            .constant("STRATUM_SIZE", size)
            .bind("guide", guides.guide)
            .bind("gradient_samples", samples.image)
            .bind("candidates", samples.candidates)
            .constant("SPECULAR", u32::from(divisor.of_each))
            .constant("COAT", u32::from(divisor.of_coat))
            .each_previous("previous_candidate_albedo", &kept)
            .each("candidate_albedo", &kept)
            .each("irradiance", irradiance.images());
        self.add(divisor.bind(pass));
    }
}
