//! Channels of the inputs in a file: the names of this project's data sets, which `atrous-denoise` knows.

use crate::config::{Conventions, MotionDepth};
use crate::contract::texel::Plane;
use crate::contract::Input;
use exr::image::FlatSamples;

/// A layer of a file: its name, and planes with theirs.
pub(crate) struct Layer {
    pub name: String,
    pub planes: Vec<(&'static str, FlatSamples)>,
}

/// Layer and components of an input. A graph of a host may have inputs of its own, which are colours.
fn names(input: &str, motion_depth: MotionDepth, coloured: bool) -> (&str, &'static [&'static str]) {
    let is_grey = !coloured && Input::NOISY_VISIBILITY.iter().any(|of_light| of_light.name == input);
    match Input::by_name(input).and_then(|input| input.layer) {
        Some(layer) if is_grey => (layer.names[0], &["Z"]),
        Some(layer) if input == Input::MOTION.name && motion_depth == MotionDepth::None => (layer.names[0], &layer.components[..2]),
        Some(layer) => (layer.names[0], layer.components),
        None => (input, &["R", "G", "B"]),
    }
}

/// The layer of an input that has one.
const fn layer_of(input: Input) -> &'static str {
    match input.layer {
        Some(layer) => layer.names[0],
        None => input.name,
    }
}

/// The visibility of each light, and the light without what is in the way.
const LIGHTS: [[&str; 2]; 4] = {
    let (seen, light) = (Input::NOISY_VISIBILITY, Input::UNSHADOWED_DIRECT);
    [
        [layer_of(seen[0]), layer_of(light[0])],
        [layer_of(seen[1]), layer_of(light[1])],
        [layer_of(seen[2]), layer_of(light[2])],
        [layer_of(seen[3]), layer_of(light[3])],
    ]
};
const VOLUME: &str = layer_of(Input::NOISY_VOLUME);
const EMISSION: &str = layer_of(Input::EMISSION);
const OTHER_DENOISED: &str = layer_of(Input::OTHER_DENOISED_RADIANCE);

/// The light that is filtered, without the emission.
const FILTERED: [&str; 5] = [
    layer_of(Input::NOISY_RADIANCE),
    layer_of(Input::NOISY_DIRECT),
    layer_of(Input::NOISY_INDIRECT),
    layer_of(Input::NOISY_DIFFUSE),
    layer_of(Input::NOISY_SPECULAR),
];

impl Layer {
    /// The layer of an input. Components that a texture lacks are written as 0, since a shader reads them so. `coloured`: whether
    /// visibility has more than one.
    pub(crate) fn of_input(input: &str, conventions: &Conventions, coloured: bool, mut planes: Vec<Plane>, pixels: usize) -> Self {
        let (name, components) = names(input, conventions.motion_depth, coloured);
        if input == Input::ROUGHNESS.name {
            planes.drain(..planes.len().min(conventions.roughness_channel as usize));
        }
        let mut planes = planes.into_iter().map(|plane| match plane {
            Plane::Half(samples) => FlatSamples::F16(samples),
            Plane::Float(samples) => FlatSamples::F32(samples),
            Plane::Uint(samples) => FlatSamples::U32(samples),
        });
        let mut plane = || planes.next().unwrap_or_else(|| FlatSamples::F32(vec![0.0; pixels]));
        Self { name: name.to_owned(), planes: components.iter().map(|c| (*c, plane())).collect() }
    }

    fn is_filtered(&self) -> bool {
        FILTERED.contains(&self.name.as_str())
    }
}

/// Adds `noisy`, the light of all layers together, as the picture shows it. A single layer of light
/// is it already.
pub(crate) fn add_total(layers: &mut Vec<Layer>) {
    let is_unshadowed = |l: &Layer| LIGHTS.iter().any(|[_, unshadowed]| *unshadowed == l.name);
    let is_beside = |l: &Layer| matches!(l.name.as_str(), EMISSION | VOLUME) || is_unshadowed(l);
    let is_alone = !layers.iter().any(is_beside);
    let mut filtered = layers.iter_mut().filter(|l| l.is_filtered());
    let first = filtered.next();
    // Where a host's own confidence replaces all gradients, there is nothing but the picture of the other denoiser.
    let is_dark = first.is_none();
    if let (Some(only), None, true) = (first, filtered.next(), is_alone) {
        only.name = "noisy".to_owned();
        return;
    }
    let counts = |l: &&Layer| l.is_filtered() || (is_beside(l) && !is_unshadowed(l)) || (is_dark && l.name == OTHER_DENOISED);
    let total = |i: usize| {
        let mut lights = layers.iter().filter(counts).filter_map(|l| l.planes.get(i));
        let first: Vec<f32> = lights.next().map_or(Vec::new(), |(_, p)| p.values_as_f32().collect());
        let sum = lights.fold(first, |sum, (_, p)| sum.into_iter().zip(p.values_as_f32()).map(|(a, b)| a + b).collect());
        FlatSamples::F32(sum)
    };
    // The lights whose visibility is apart, as the samples have them.
    let plane = |layer: &str, i: usize| layers.iter().find(|l| l.name == layer).and_then(|l| l.planes.get(i));
    let shadowed = |[seen, light]: [&str; 2], i: usize| -> Option<Vec<f32>> {
        let (seen, light) = (&plane(seen, i).or_else(|| plane(seen, 0))?.1, &plane(light, i)?.1);
        Some(seen.values_as_f32().zip(light.values_as_f32()).map(|(v, l)| v.clamp(0.0, 1.0) * l).collect())
    };
    let add = |sum: FlatSamples, light: Vec<f32>| FlatSamples::F32(sum.values_as_f32().zip(light).map(|(a, b)| a + b).collect());
    let total = |i: usize| LIGHTS.into_iter().filter_map(|light| shadowed(light, i)).fold(total(i), add);
    let planes = ["R", "G", "B"].into_iter().enumerate().map(|(i, c)| (c, total(i))).collect();
    layers.push(Layer { name: "noisy".to_owned(), planes });
}
