//! Measures the change in luminance of the same samples from the previous frame to this one, per stratum. \[ASVGF\] eq. 2, 3, 13.

pub(crate) mod twin;

use crate::contract::{Grid, Lifetime};
use crate::graph::{Gradient, GradientSamples, Graph, Guides, Image, Pass, Radiance, HDR, HOST_COLOUR, PACKED_32, PACKED_64};
use crate::shaders;

/// Source of temporal gradients.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub enum Gradients {
    /// One pixel a stratum is a sample of the previous frame, shaded again by the host.
    ForwardProjected(GradientSamples),
    /// The host's image `reshaded_radiance`: paths of the previous frame in the scene of this one.
    Reshaded {
        /// Side of a stratum, 2 to 4 pixels.
        stratum_size: u32,
    },
    /// The host's image `sparse_gradient`: δ and Δ, one texel a stratum.
    Sparse {
        /// Side of a stratum, 2 to 4 pixels.
        stratum_size: u32,
    },
}

impl Gradients {
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
    /// Gradients of the noisy radiance of one or two signals, and the guide that steers their reconstruction.
    pub fn gradient(&mut self, guides: &Guides, noisy: &Radiance, source: Gradients) -> Gradient {
        let node = self.node("gradient", "");
        let size = check_stratum_size(self, &node, source.stratum_size());
        let image = self.named_image("gradient", "", HDR, size, Lifetime::Transient);
        let guide = self.named_image("gradient_guide", "", PACKED_64, size, Lifetime::Transient);
        let is_sparse = matches!(source, Gradients::Sparse { .. });
        let module = if is_sparse { &shaders::GRADIENT_LUMINANCE_0 } else { &shaders::GRADIENT_LUMINANCE_1 };
        let mut pass = Pass::new(&node, module)
            .grid(Grid::Strata(size))
            .constant("STRATUM_SIZE", size)
            .bind("guide", guides.guide)
            .bind("albedo", self.input("albedo", HOST_COLOUR, 1, true))
            .each("noisy", noisy.images())
            .bind("gradient", image)
            .bind("gradient_guide", guide);
        if !is_sparse {
            // The luminance of this frame's samples is kept for the next frame, with that of the albedo.
            let luminance = self.named_image("noisy_luminance", "", PACKED_32, 1, Lifetime::History);
            pass = pass.bind("noisy_luminance", luminance).previous("previous_luminance", luminance);
        }
        let pass = self.bind_source(pass, guides, source, size);
        self.add(pass);
        Gradient { image: self.refreshed(image), guide: self.refreshed(guide), stratum_size: size }
    }

    fn bind_source(&mut self, pass: Pass, guides: &Guides, source: Gradients, size: u32) -> Pass {
        match source {
            Gradients::ForwardProjected(samples) => pass.constant("SOURCE", 0).bind("gradient_samples", samples.image),
            Gradients::Reshaded { .. } => pass
                .constant("SOURCE", 1)
                .bind("reshaded_radiance", self.gradient_input("reshaded_radiance", 1))
                .previous("previous_guide", guides.guide)
                .bind("surface_motion", guides.surface_motion)
                .bind("depth_gradient", guides.depth_gradient),
            Gradients::Sparse { .. } => {
                pass.constant("SOURCE", 2).bind("sparse_gradient", self.gradient_input("sparse_gradient", size))
            }
        }
    }

    fn gradient_input(&mut self, name: &str, divisor: u32) -> Image {
        self.input(name, HOST_COLOUR, divisor, true)
    }
}
