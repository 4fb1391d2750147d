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
fn names(input: &str, motion_depth: MotionDepth) -> (&str, &'static [&'static str]) {
    match Input::by_name(input).and_then(|input| input.layer) {
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

const VISIBILITY: &str = layer_of(Input::NOISY_VISIBILITY);
const UNSHADOWED: &str = layer_of(Input::UNSHADOWED_DIRECT);
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
    /// The layer of an input. Components that a texture lacks are written as 0, since a shader reads them so.
    pub(crate) fn of_input(input: &str, conventions: &Conventions, mut planes: Vec<Plane>, pixels: usize) -> Self {
        let (name, components) = names(input, conventions.motion_depth);
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
    let is_beside = |l: &Layer| matches!(l.name.as_str(), EMISSION | VOLUME | UNSHADOWED);
    let is_alone = !layers.iter().any(is_beside);
    let mut filtered = layers.iter_mut().filter(|l| l.is_filtered());
    let first = filtered.next();
    // Where a host's own confidence replaces all gradients, there is nothing but the picture of the other denoiser.
    let is_dark = first.is_none();
    if let (Some(only), None, true) = (first, filtered.next(), is_alone) {
        only.name = "noisy".to_owned();
        return;
    }
    let counts = |l: &&Layer| l.is_filtered() || (is_beside(l) && l.name != UNSHADOWED) || (is_dark && l.name == OTHER_DENOISED);
    let total = |i: usize| {
        let mut lights = layers.iter().filter(counts).filter_map(|l| l.planes.get(i));
        let first: Vec<f32> = lights.next().map_or(Vec::new(), |(_, p)| p.values_as_f32().collect());
        let sum = lights.fold(first, |sum, (_, p)| sum.into_iter().zip(p.values_as_f32()).map(|(a, b)| a + b).collect());
        FlatSamples::F32(sum)
    };
    // The light whose visibility is apart, as the sample has it.
    let plane = |layer: &str, i: usize| layers.iter().find(|l| l.name == layer).and_then(|l| l.planes.get(i));
    let shadowed = |i: usize| -> Option<Vec<f32>> {
        let (seen, light) = (&plane(VISIBILITY, 0)?.1, &plane(UNSHADOWED, i)?.1);
        Some(seen.values_as_f32().zip(light.values_as_f32()).map(|(v, l)| v.clamp(0.0, 1.0) * l).collect())
    };
    let total = |i: usize| match (total(i), shadowed(i)) {
        (FlatSamples::F32(sum), Some(light)) => FlatSamples::F32(sum.into_iter().zip(light).map(|(a, b)| a + b).collect()),
        (sum, _) => sum,
    };
    let planes = ["R", "G", "B"].into_iter().enumerate().map(|(i, c)| (c, total(i))).collect();
    layers.push(Layer { name: "noisy".to_owned(), planes });
}
