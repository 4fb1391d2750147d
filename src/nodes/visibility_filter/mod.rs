//! Filters the visibility of a light along surfaces, no wider than its penumbra. \[Mehta et al. 2012\], \[SVGF\] 4.3.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::pass;
use crate::contract::Lifetime;
use crate::graph::{Graph, Guides, Port, Visibility, VisibilityAccumulated, CONFIDENCE, PACKED_32};
use crate::shaders;

/// Levels that a filter of visibility may have.
const MOST_LEVELS: u32 = 6;

impl Graph {
    /// Filters the visibility of a light level by level, one pass each: 1 to 6. Four of them are good for a standard deviation of 9
    /// pixels, five for 18; a level that a pixel's penumbra does not need leaves it as it is.
    pub fn visibility_filter(&mut self, guides: &Guides, accumulated: &VisibilityAccumulated, levels: u32) -> Visibility {
        let node = self.node("visibility_filter", "");
        let filtered = self.named_image("filtered_visibility", "", CONFIDENCE, 1, Lifetime::Transient);
        if !(1..=MOST_LEVELS).contains(&levels) {
            self.fail(&node, "levels", format!("{levels} levels were given; allowed is 1 to {MOST_LEVELS}"));
            return Port::of(filtered);
        }
        let mut scratch = [None; 2];
        let mut from = accumulated.image();
        for level in 0..levels {
            let is_last = level + 1 == levels;
            let index = (level % 2) as usize;
            let to = match is_last {
                true => filtered,
                false => *scratch[index].get_or_insert_with(|| {
                    let name = ["visibility_even", "visibility_odd"][index];
                    self.named_image(name, "", PACKED_32, 1, Lifetime::Transient)
                }),
            };
            let (module, output) = match is_last {
                true => (&shaders::VISIBILITY_FILTER_LAST_1, "denoised_visibility"),
                false => (&shaders::VISIBILITY_FILTER_LAST_0, "filter_out"),
            };
            let pass = pass(&node, module)
                .named(format!("{node}_{level}"))
                .level(level)
                .constant("FIRST", u32::from(level == 0))
                .bind("guide", guides.guide)
                .bind("depth_gradient", guides.depth_gradient)
                .bind("visibility_history", accumulated.image())
                .bind("filter_in", from)
                .bind(output, to);
            self.add(pass);
            from = self.refreshed(to);
        }
        Port::of(from)
    }
}
