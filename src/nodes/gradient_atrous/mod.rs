//! Spreads the gradients over strata without a sample, and removes their noise. \[ASVGF\] 3.4, eq.
//! 7 to 12.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::pass;
use crate::contract::Grid;
use crate::graph::{Gradient, Graph, Guides, Image, LightRatio};
use crate::shaders;

/// Iterations of the reconstruction, as in the paper.
const ITERATIONS: u32 = 5;

impl Graph {
    /// Reconstructed gradients, in five passes; with the ratio of light, where [`Self::gradient_and_ratio`] measured it.
    pub fn gradient_atrous(&mut self, guides: &Guides, gradient: &Gradient) -> Gradient {
        let node = self.node("gradient_atrous", "");
        let size = gradient.stratum_size;
        let images = ["gradient_even", "gradient_odd"].map(|name| self.strata_image(name, size));
        let lights = gradient.light.map(|_| {
            [["light_before_even", "light_before_odd"], ["light_now_even", "light_now_odd"]]
                .map(|names| names.map(|name| self.strata_image(name, size)))
        });
        let module = if lights.is_some() { &shaders::GRADIENT_ATROUS_RATIO_1 } else { &shaders::GRADIENT_ATROUS_RATIO_0 };
        let (mut from, mut light) = (gradient.image, gradient.light);
        for level in 0..ITERATIONS {
            let parity = (level % 2) as usize;
            let to = images[parity];
            let mut pass = pass(&node, module)
                .named(format!("{node}_{level}"))
                .level(level)
                .grid(Grid::Strata(size))
                .constant("STRATUM_SIZE", size)
                .bind("guide", guides.guide)
                .bind("gradient_guide", gradient.guide)
                .bind("gradient_in", from)
                .bind("gradient_out", to);
            let light_to: Option<[Image; 2]> = lights.map(|images| images.map(|pair| pair[parity]));
            if let (Some([before, now]), Some([before_to, now_to])) = (light, light_to) {
                pass = pass.constant("LAST", u32::from(level + 1 == ITERATIONS));
                pass = pass.bind("before_in", before).bind("now_in", now).bind("before_out", before_to).bind("now_out", now_to);
            }
            self.add(pass);
            from = self.refreshed(to);
            light = light_to.map(|images| images.map(|image| self.refreshed(image)));
        }
        let light_ratio = light.map(|[image, _]| LightRatio { image, stratum_size: size });
        Gradient { image: from, light: None, light_ratio, ..*gradient }
    }
}
