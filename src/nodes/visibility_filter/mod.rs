//! Filters the visibility of lights along surfaces, no wider than their penumbrae. \[Mehta et al. 2012\], \[SVGF\] 4.3.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::pass;
use crate::contract::Lifetime;
use crate::graph::{Graph, Guides, Image, Lights, Visibility, VisibilityAccumulated, CONFIDENCE, HDR};
use crate::nodes::visibility_samples::radius_of;
use crate::shaders::{self, Shader};

/// Levels that a filter of visibility may have.
const MOST_LEVELS: u32 = 6;

impl Graph {
    /// Filters the visibility of lights level by level, one pass each: 1 to 6. Four of them are good for a standard deviation of 9
    /// pixels, five for 18; a level that a pixel's penumbrae do not need leaves it as it is.
    pub fn visibility_filter(&mut self, guides: &Guides, accumulated: &VisibilityAccumulated, levels: u32) -> Visibility {
        let node = self.node("visibility_filter", "");
        let lights @ Lights { count, coloured, .. } = accumulated.lights();
        let format = if coloured { HDR } else { CONFIDENCE };
        let filtered: Vec<Image> = (0..count)
            .map(|light| {
                let label = if light > 0 { light.to_string() } else { String::new() };
                self.named_image("filtered_visibility", &label, format, 1, Lifetime::Transient)
            })
            .collect();
        if !(1..=MOST_LEVELS).contains(&levels) {
            self.fail(&node, "levels", format!("{levels} levels were given; allowed is 1 to {MOST_LEVELS}"));
            return self.port_of_words(&filtered, lights);
        }
        let mut scratch = [const { Vec::new() }; 2];
        let mut from = accumulated.images().to_vec();
        for level in 0..levels {
            let is_last = level + 1 == levels;
            let index = (level % 2) as usize;
            if !is_last && scratch[index].is_empty() {
                let names = [["visibility_even", "visibility_even_colours"], ["visibility_odd", "visibility_odd_colours"]][index];
                scratch[index] = self.words_of_lights(names, lights);
            }
            let to = if is_last { &filtered } else { &scratch[index] };
            let mut pass = pass(&node, module(is_last, count > 1, coloured))
                .named(format!("{node}_{level}"))
                .level(level)
                .lights(count)
                .value("light_radius", radius_of(lights))
                .constant("FIRST", u32::from(level == 0))
                .bind("guide", guides.guide)
                .bind("visibility_history", accumulated.image())
                .bind("filter_in", from[0])
                .bind_some("filter_in_colours", from.get(1).copied());
            let outputs = if is_last { OUTPUTS } else { &["filter_out", "filter_out_colours"] };
            for (binding, image) in outputs.iter().zip(to) {
                pass = pass.bind(binding, *image);
            }
            self.add(pass);
            from = to.iter().map(|image| self.refreshed(*image)).collect();
        }
        self.port_of_words(&from, lights)
    }
}

/// Bindings of the results, one for each light.
pub(crate) const OUTPUTS: &[&str] =
    &["denoised_visibility", "denoised_visibility_1", "denoised_visibility_2", "denoised_visibility_3"];

fn module(is_last: bool, many: bool, coloured: bool) -> &'static Shader {
    match (is_last, many, coloured) {
        (false, false, false) => &shaders::VISIBILITY_FILTER_LAST_0_MANY_0_COLOUR_0,
        (false, false, true) => &shaders::VISIBILITY_FILTER_LAST_0_MANY_0_COLOUR_1,
        (false, true, false) => &shaders::VISIBILITY_FILTER_LAST_0_MANY_1_COLOUR_0,
        (false, true, true) => &shaders::VISIBILITY_FILTER_LAST_0_MANY_1_COLOUR_1,
        (true, false, false) => &shaders::VISIBILITY_FILTER_LAST_1_MANY_0_COLOUR_0,
        (true, false, true) => &shaders::VISIBILITY_FILTER_LAST_1_MANY_0_COLOUR_1,
        (true, true, false) => &shaders::VISIBILITY_FILTER_LAST_1_MANY_1_COLOUR_0,
        (true, true, true) => &shaders::VISIBILITY_FILTER_LAST_1_MANY_1_COLOUR_1,
    }
}
