//! Measures the change in luminance of the same samples from the previous frame to this one, per stratum. \[ASVGF\] eq. 2, 3, 13.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::pass;
use crate::contract::{Grid, Input, Lifetime};
use crate::graph::{Gradient, GradientSamples, Graph, Guides, Image, KeptLuminance, Pass, Radiance};
use crate::graph::{HDR, PACKED_32, PACKED_64};
use crate::shaders;

/// Source of temporal gradients.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub enum Gradients {
    /// One pixel per stratum is a sample of the previous frame, re-shaded by your path tracer.
    ForwardProjected(GradientSamples),
    /// Your image `reshaded_radiance`: paths of the previous frame in the scene of this one.
    Reshaded {
        /// Side of a stratum, 2 to 4 pixels.
        stratum_size: u32,
    },
    /// Your image `sparse_gradient`: δ and Δ, one texel per stratum.
    Sparse {
        /// Side of a stratum, 2 to 4 pixels.
        stratum_size: u32,
    },
}

impl Gradients {
    /// The re-shaded pixels of the noisy radiance, for [`crate::nodes::Demodulate::samples`].
    pub fn samples(&self) -> Option<GradientSamples> {
        match *self {
            Self::ForwardProjected(samples) => Some(samples),
            Self::Reshaded { .. } | Self::Sparse { .. } => None,
        }
    }

    fn stratum_size(&self) -> u32 {
        match *self {
            Self::ForwardProjected(GradientSamples { stratum_size, .. }) => stratum_size,
            Self::Reshaded { stratum_size } | Self::Sparse { stratum_size } => stratum_size,
        }
    }
}

/// A side that strata can have; a wrong one is noted as an error of the node.
pub(super) fn check_stratum_size(graph: &mut Graph, node: &str, size: u32) -> u32 {
    if (2..=4).contains(&size) {
        return size;
    }
    graph.fail(node, "stratum_size", format!("{size} pixels were given; allowed is 2 to 4"));
    3
}

impl Graph {
    /// Gradients of the noisy radiance of one or two signals, and the guide that steers their
    /// reconstruction. Unless you give the gradients yourself, keep the luminance of this frame for
    /// the next one: [`crate::nodes::Demodulate::gradient`].
    pub fn gradient(&mut self, guides: &Guides, noisy: &Radiance, source: Gradients) -> Gradient {
        self.add_gradient(guides, noisy, source, false)
    }

    /// [`Self::gradient`], and the light of the samples in this frame and the previous one, from
    /// which [`Self::gradient_atrous`] makes the ratio. Where light rises or falls as a whole, the
    /// history can follow it instead of being dropped. Gradients of your own,
    /// [`Gradients::Sparse`], give no ratio.
    pub fn gradient_and_ratio(&mut self, guides: &Guides, noisy: &Radiance, source: Gradients) -> Gradient {
        self.add_gradient(guides, noisy, source, true)
    }

    fn add_gradient(&mut self, guides: &Guides, noisy: &Radiance, source: Gradients, ratio: bool) -> Gradient {
        let node = self.node("gradient", "");
        let size = check_stratum_size(self, &node, source.stratum_size());
        let image = self.strata_image("gradient", size);
        let guide = self.named_image("gradient_guide", "", PACKED_64, size, Lifetime::Transient);
        let mut pass = pass(&node, &shaders::GRADIENT)
            .grid(Grid::Strata(size))
            .constant("STRATUM_SIZE", size)
            .bind("guide", guides.guide)
            .bind_some("albedo", self.dividing_albedo())
            .each("noisy", noisy.images())
            .bind("gradient", image)
            .bind("gradient_guide", guide);
        let kept = (!matches!(source, Gradients::Sparse { .. })).then(|| {
            let candidates = source.samples().map(|samples| samples.candidates);
            let side = if candidates.is_some() { size } else { 1 };
            let mut kept = |name| self.history_in_place(name, "", PACKED_32, side, "give the gradients to `Demodulate::gradient`");
            let (image, red_blue) = (kept("noisy_luminance"), ratio.then(|| kept("noisy_red_blue")));
            KeptLuminance { image, red_blue, of: *noisy, side, candidates }
        });
        if let Some(kept) = &kept {
            pass = pass.previous("previous_luminance", kept.image);
        }
        let red_blue = kept.and_then(|kept| kept.red_blue);
        let light = red_blue.map(|_| ["light_before", "light_now"].map(|name| self.strata_image(name, size)));
        if let (Some(red_blue), Some([before, now])) = (red_blue, light) {
            pass = pass.previous("previous_red_blue", red_blue).bind("light_before", before).bind("light_now", now);
        }
        let pass = self.bind_source(pass, guides, source, size);
        self.add(pass);
        let light = light.map(|images| images.map(|image| self.refreshed(image)));
        let (image, guide) = (self.refreshed(image), self.refreshed(guide));
        Gradient { image, guide, stratum_size: size, kept, light, light_ratio: None }
    }

    /// Four half floats for every stratum.
    pub(super) fn strata_image(&mut self, name: &str, stratum_size: u32) -> Image {
        self.named_image(name, "", HDR, stratum_size, Lifetime::Transient)
    }

    fn bind_source(&mut self, pass: Pass, guides: &Guides, source: Gradients, size: u32) -> Pass {
        match source {
            Gradients::ForwardProjected(samples) => pass.constant("SOURCE", 0).bind("gradient_samples", samples.image),
            Gradients::Reshaded { .. } => pass
                .constant("SOURCE", 1)
                .bind("reshaded_radiance", self.input(Input::RESHADED_RADIANCE))
                .previous("previous_guide", guides.guide)
                .bind("surface_motion", guides.surface_motion),
            Gradients::Sparse { .. } => {
                pass.constant("SOURCE", 2).bind("sparse_gradient", self.input_per(Input::SPARSE_GRADIENT, size))
            }
        }
    }
}
