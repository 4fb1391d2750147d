//! Blends the visibility of lights with its past, and measures their penumbrae. \[Mehta et al. 2012\], \[SVGF\] 4.1.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::pass;
use crate::contract::Input;
use crate::graph::{Graph, Guides, VisibilityAccumulated, VisibilitySamples};
use crate::nodes::visibility_samples::{of_all_directions, radius_of};
use crate::shaders;

impl Graph {
    /// Accumulates the visibility of lights in a history of its own: mean, deviation, history length and distance of the occluder in
    /// 32 bits for each, and 32 more in colour. The optional inputs `occluder_id` with `instance_transforms`, or `occluder_motion`, and
    /// the places of lights in [`crate::FrameParams`] follow shadows that move.
    pub fn visibility_accumulation(&mut self, guides: &Guides, samples: &VisibilitySamples) -> VisibilityAccumulated {
        let node = self.node("visibility_accumulation", "");
        let lights = samples.lights();
        let history = self.words_of_lights(["visibility_history", "visibility_history_colours"], lights);
        let module = match (lights.count > 1, lights.coloured) {
            (false, false) => &shaders::VISIBILITY_ACCUMULATION_MANY_0_COLOUR_0,
            (false, true) => &shaders::VISIBILITY_ACCUMULATION_MANY_0_COLOUR_1,
            (true, false) => &shaders::VISIBILITY_ACCUMULATION_MANY_1_COLOUR_0,
            (true, true) => &shaders::VISIBILITY_ACCUMULATION_MANY_1_COLOUR_1,
        };
        let mut pass = pass(&node, module)
            .lights(lights.count)
            .constant("AMBIENT", u32::from(lights.ambient))
            .value("light_radius", radius_of(lights))
            .bind("guide", guides.guide)
            .previous("previous_guide", guides.guide)
            .bind("surface_motion", guides.surface_motion)
            .bind("visibility_samples", samples.image())
            .previous("previous_visibility_history", history[0])
            .bind("instance_transforms", self.input(Input::INSTANCE_TRANSFORMS))
            .bind("visibility_history", history[0]);
        if let ([_, samples], [_, history]) = (samples.images(), history.as_slice()) {
            pass = pass
                .bind("sample_colours", *samples)
                .previous("previous_history_colours", *history)
                .bind("history_colours", *history);
        }
        let of_lights = [Input::OCCLUDER_DISTANCE, Input::OCCLUDER_ID, Input::OCCLUDER_MOTION];
        for of_light in of_lights.iter().flat_map(|of| &of[..lights.count as usize]) {
            if !lights.ambient {
                pass = pass.bind(of_light.name, self.input(*of_light));
            } else if !of_light.optional {
                pass = pass.bind(of_light.name, self.input(of_all_directions(*of_light)));
            }
        }
        self.add(pass);
        self.port_of_words(&history, lights)
    }
}
