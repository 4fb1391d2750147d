//! Takes in the visibility of lights, and the distances of their occluders.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::pass;
use crate::contract::{Input, Lifetime};
use crate::graph::{Graph, Guides, Image, Port, VisibilitySamples, PACKED_128, PACKED_32};
use crate::shaders;

/// Lights whose visibility is filtered in the same passes.
pub(crate) const MOST_LIGHTS: u32 = 4;

/// Parameters of [`Graph::visibility_samples`].
#[derive(Clone, Copy, Debug)]
pub struct Lights {
    /// Number of lights, 1 to 4. Default: 1.
    pub count: u32,
    /// Whether their visibility has red, green and blue. Default: false.
    pub coloured: bool,
}

impl Default for Lights {
    fn default() -> Self {
        Self { count: 1, coloured: false }
    }
}

impl Graph {
    /// Valid samples of the visibility of lights. Inputs: `noisy_visibility`, 0 (occluded) to 1 (lit), and `occluder_distance`; of
    /// further lights the same with `_1` to `_3` behind.
    pub fn visibility_samples(&mut self, guides: &Guides, lights: Lights) -> VisibilitySamples {
        let node = self.node("visibility_samples", "");
        let Lights { count, coloured } = lights;
        if !(1..=MOST_LIGHTS).contains(&count) {
            self.fail(&node, "count", format!("{count} lights were given; allowed is 1 to {MOST_LIGHTS}"));
        }
        let count = count.clamp(1, MOST_LIGHTS);
        let samples = self.words_of_lights(["visibility_samples", "visibility_sample_colours"], count, coloured);
        let module = match (count > 1, coloured) {
            (false, false) => &shaders::VISIBILITY_SAMPLES_MANY_0_COLOUR_0,
            (false, true) => &shaders::VISIBILITY_SAMPLES_MANY_0_COLOUR_1,
            (true, false) => &shaders::VISIBILITY_SAMPLES_MANY_1_COLOUR_0,
            (true, true) => &shaders::VISIBILITY_SAMPLES_MANY_1_COLOUR_1,
        };
        let mut pass = pass(&node, module)
            .lights(count)
            .bind("guide", guides.guide)
            .bind("visibility_samples", samples[0])
            .bind_some("sample_colours", samples.get(1).copied());
        for input in [Input::NOISY_VISIBILITY, Input::OCCLUDER_DISTANCE].iter().flat_map(|of| &of[..count as usize]) {
            pass = pass.bind(input.name, self.input(*input));
        }
        self.add(pass);
        self.port_of_words(&samples, count)
    }

    /// Images with a word for each light, and in colour a second one with green and blue.
    pub(crate) fn words_of_lights(&mut self, names: [&str; 2], lights: u32, coloured: bool) -> Vec<Image> {
        let format = if lights > 1 { PACKED_128 } else { PACKED_32 };
        let names = &names[..1 + usize::from(coloured)];
        names.iter().map(|name| self.named_image(name, "", format, 1, Lifetime::Transient)).collect()
    }

    /// A port of such images, with the content that they have now.
    pub(crate) fn port_of_words<K>(&self, images: &[Image], lights: u32) -> Port<K> {
        let images: Vec<Image> = images.iter().map(|image| self.refreshed(*image)).collect();
        Port::of_images(&images).unwrap_or_else(|| Port::of(Image::NONE)).with_lights(lights)
    }
}
