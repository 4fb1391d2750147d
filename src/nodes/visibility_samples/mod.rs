//! Takes in the visibility of lights, and the distances of their occluders.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::pass;
use crate::contract::{Input, Lifetime};
pub use crate::graph::Lights;
use crate::graph::{Graph, Guides, Image, Port, Value, VisibilitySamples, PACKED_128, PACKED_32};
use crate::shaders;

/// Lights whose visibility is filtered in the same passes.
pub(crate) const MOST_LIGHTS: u32 = 4;

impl Graph {
    /// Valid samples of the visibility of lights. Inputs: `noisy_visibility`, 0 (occluded) to 1 (lit), and `occluder_distance`; of
    /// further lights the same with `_1` to `_3` behind. Of all directions: `noisy_ambient` and `ambient_distance`.
    pub fn visibility_samples(&mut self, guides: &Guides, lights: Lights) -> VisibilitySamples {
        let node = self.node("visibility_samples", "");
        let most = if lights.ambient { 1 } else { MOST_LIGHTS };
        if !(1..=most).contains(&lights.count) {
            self.fail(&node, "count", format!("{} lights were given; allowed is 1 to {most}", lights.count));
        }
        let lights = Lights { count: lights.count.clamp(1, most), ..lights };
        let samples = self.words_of_lights(["visibility_samples", "visibility_sample_colours"], lights);
        let module = match (lights.count > 1, lights.coloured) {
            (false, false) => &shaders::VISIBILITY_SAMPLES_MANY_0_COLOUR_0,
            (false, true) => &shaders::VISIBILITY_SAMPLES_MANY_0_COLOUR_1,
            (true, false) => &shaders::VISIBILITY_SAMPLES_MANY_1_COLOUR_0,
            (true, true) => &shaders::VISIBILITY_SAMPLES_MANY_1_COLOUR_1,
        };
        let mut pass = pass(&node, module)
            .lights(lights.count)
            .bind("guide", guides.guide)
            .bind("visibility_samples", samples[0])
            .bind_some("sample_colours", samples.get(1).copied());
        for of in [Input::NOISY_VISIBILITY, Input::OCCLUDER_DISTANCE] {
            for of_light in &of[..lights.count as usize] {
                let input = if lights.ambient { of_all_directions(*of_light) } else { *of_light };
                pass = pass.bind(of_light.name, self.input(input));
            }
        }
        self.add(pass);
        self.port_of_words(&samples, lights)
    }

    /// Images with a word for each light, and in colour a second one with green and blue.
    pub(crate) fn words_of_lights(&mut self, names: [&str; 2], lights: Lights) -> Vec<Image> {
        let format = if lights.count > 1 { PACKED_128 } else { PACKED_32 };
        let names = &names[..1 + usize::from(lights.coloured)];
        names.iter().map(|name| self.named_image(name, "", format, 1, Lifetime::Transient)).collect()
    }

    /// A port of such images, with the content that they have now.
    pub(crate) fn port_of_words<K>(&self, images: &[Image], lights: Lights) -> Port<K> {
        let images: Vec<Image> = images.iter().map(|image| self.refreshed(*image)).collect();
        Port::of_images(&images).unwrap_or_else(|| Port::of(Image::NONE)).with_lights(lights)
    }
}

/// The input of ambient occlusion that stands for one of a light.
pub(crate) fn of_all_directions(of_light: Input) -> Input {
    match of_light.name == Input::NOISY_VISIBILITY[0].name {
        true => Input::NOISY_AMBIENT,
        false => Input::AMBIENT_DISTANCE,
    }
}

/// The source of the push constant `light_radius`.
pub(crate) fn radius_of(lights: Lights) -> Value {
    if lights.ambient {
        Value::Tunable("ambient_radius")
    } else {
        Value::Own
    }
}
