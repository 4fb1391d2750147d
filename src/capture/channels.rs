//! Which channels an input becomes: the names of this project's data sets, which `examples/denoise` knows.

use crate::config::MotionDepth;
use exr::image::FlatSamples;

/// A layer of a file: its name, and planes with theirs.
pub(crate) struct Layer {
    pub name: &'static str,
    pub planes: Vec<(&'static str, FlatSamples)>,
}

const RGB: &[&str] = &["R", "G", "B"];
const XYZ: &[&str] = &["X", "Y", "Z"];

/// Layer and components of an input.
fn names(input: &'static str, motion_depth: MotionDepth) -> (&'static str, &'static [&'static str]) {
    match input {
        "depth" => ("depth", &["Z"]),
        "normal" => ("normal", XYZ),
        "object_normal" => ("object_normal", XYZ),
        "motion" if motion_depth == MotionDepth::None => ("mv", &["X", "Y"]),
        "motion" => ("mv", XYZ),
        "surface_id" => ("id", &["I"]),
        "roughness" => ("roughness", &["Y"]),
        "scattering_depth" => ("scattering_depth", &["Z"]),
        "albedo" => ("albedo", RGB),
        "emission" => ("emission", RGB),
        "noisy_direct" => ("direct", RGB),
        "noisy_indirect" => ("indirect", RGB),
        "noisy_radiance" => (LIGHTING, RGB),
        other => (other, RGB),
    }
}

/// The light that is filtered where it is one signal, without the emission.
const LIGHTING: &str = "lighting";

impl Layer {
    /// What a texture lacks in components a shader reads as 0, so that is what is written.
    pub fn of_input(input: &'static str, motion_depth: MotionDepth, planes: Vec<FlatSamples>, pixels: usize) -> Self {
        let (name, components) = names(input, motion_depth);
        let mut planes = planes.into_iter();
        let mut plane = || planes.next().unwrap_or_else(|| FlatSamples::F32(vec![0.0; pixels]));
        Self { name, planes: components.iter().map(|c| (*c, plane())).collect() }
    }

    fn is_light(&self) -> bool {
        matches!(self.name, LIGHTING | "direct" | "indirect" | "emission")
    }
}

/// Adds `noisy`, the light of all layers together: what the picture shows. One layer of light alone is it already.
pub(crate) fn add_total(layers: &mut Vec<Layer>) {
    let mut lights = layers.iter_mut().filter(|l| l.is_light());
    if let (Some(only), None) = (lights.next(), lights.next()) {
        only.name = "noisy";
        return;
    }
    let total = |i: usize| {
        let mut lights = layers.iter().filter(|l| l.is_light()).filter_map(|l| l.planes.get(i));
        let first: Vec<f32> = lights.next().map_or(Vec::new(), |(_, p)| p.values_as_f32().collect());
        let sum = lights.fold(first, |sum, (_, p)| sum.into_iter().zip(p.values_as_f32()).map(|(a, b)| a + b).collect());
        FlatSamples::F32(sum)
    };
    let planes = RGB.iter().enumerate().map(|(i, c)| (*c, total(i))).collect();
    layers.push(Layer { name: "noisy", planes });
}
