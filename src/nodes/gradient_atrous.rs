//! Spreads the gradients over strata without a sample, and takes their noise. \[ASVGF\] 3.4, eq. 7 to 12.

pub(crate) mod twin;

use crate::contract::{Grid, Lifetime};
use crate::graph::{Gradient, Graph, Guides, Pass, HDR};
use crate::shaders;

/// Iterations of the reconstruction, as in the paper.
const ITERATIONS: u32 = 5;

impl Graph {
    /// Reconstructed gradients, in five passes.
    pub fn gradient_atrous(&mut self, guides: &Guides, gradient: &Gradient) -> Gradient {
        let node = self.node("gradient_atrous", "");
        let images = ["gradient_even", "gradient_odd"]
            .map(|name| self.named_image(name, "", HDR, gradient.stratum_size, Lifetime::Transient));
        let mut from = gradient.image;
        for level in 0..ITERATIONS {
            let to = images[(level % 2) as usize];
            let pass = Pass::new(&node, &shaders::GRADIENT_ATROUS)
                .named(format!("{node}_{level}"))
                .level(level)
                .grid(Grid::Strata(gradient.stratum_size))
                .constant("STRATUM_SIZE", gradient.stratum_size)
                .bind("gradient_guide", gradient.guide)
                .bind("depth_gradient", guides.depth_gradient)
                .bind("gradient_in", from)
                .bind("gradient_out", to);
            self.add(pass);
            from = self.refreshed(to);
        }
        Gradient { image: from, ..*gradient }
    }
}
