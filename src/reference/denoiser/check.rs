//! What a frame must be before it touches the history.

use super::*;
use crate::config::GradientSource;

pub(super) fn check(config: &Config, frame: &FrameContext, inputs: &DenoiserInputs) -> Result<(), Error> {
    let allocated = config.allocated_extent;
    for render in [frame.constants.render_extent, frame.constants.previous_render_extent] {
        if (0..2).any(|i| render[i] > allocated[i]) {
            return Err(Error::RenderExtent { render, allocated });
        }
    }
    let signals = match (config.preset, config.signals) {
        (Preset::Volume, _) => 0,
        (Preset::Stabilize, _) | (_, Signals::Together) => 1,
        (_, Signals::Apart) => 2,
    };
    // A host that knows what changed need not show the noisy picture to a preset that does not filter it.
    let unused = config.preset == Preset::Stabilize && config.gradient_source == GradientSource::Confidence;
    if inputs.noisy.len() != signals && !unused {
        let (given, needed) = (format!("{} images", inputs.noisy.len()), format!("{signals}, as Config::signals says"));
        return Err(Error::Size { resource: "noisy".into(), given, needed });
    }
    if config.has_volume() && inputs.volume.is_none() {
        return Err(Error::NotBound("noisy_volume".into()));
    }
    let gradients = &inputs.gradients;
    let needs_forward_motion = config.reshades() && config.forward_motion;
    for (name, image, is_needed) in [
        ("forward_motion", gradients.forward_motion, needs_forward_motion),
        ("other_denoised_radiance", gradients.other_denoised_radiance, config.preset == Preset::Stabilize),
    ] {
        if is_needed && image.is_none() {
            return Err(Error::NotBound(name.into()));
        }
    }
    let strata = allocated.map(|side| side.div_ceil(config.stratum_size));
    let sparse = gradients.sparse_gradient.filter(|_| config.gradient_source == GradientSource::Sparse);
    extents(inputs)
        .map(|(name, extent)| (name, extent, allocated, "the allocated extent"))
        .chain(sparse.map(|image| ("sparse_gradient", image.extent(), strata, "one texel a stratum")))
        .find(|(_, extent, needed, _)| extent != needed)
        .map_or(Ok(()), |(name, [w, h], [width, height], what)| {
            let (given, needed) = (format!("{w} x {h} texels"), format!("{width} x {height}, {what}"));
            Err(Error::Size { resource: name.into(), given, needed })
        })
}

/// Every image with a texel a pixel.
fn extents<'a>(inputs: &'a DenoiserInputs) -> impl Iterator<Item = (&'static str, [u32; 2])> + 'a {
    let (guides, gradients) = (&inputs.guides, &inputs.gradients);
    let noisy = inputs.noisy.iter().map(|image| ("noisy", Some(*image)));
    let images = [
        ("depth", Some(guides.depth)),
        ("normal", Some(guides.normal)),
        ("motion", guides.motion),
        ("object_normal", guides.object_normal),
        ("roughness", guides.roughness),
        ("albedo", inputs.albedo),
        ("emission", inputs.emission),
        ("forward_motion", gradients.forward_motion),
        ("reshaded_radiance", gradients.reshaded_radiance),
        ("confidence", gradients.confidence),
        ("other_denoised_radiance", gradients.other_denoised_radiance),
        ("noisy_volume", inputs.volume.map(|volume| volume.noisy_volume)),
        ("scattering_depth", inputs.volume.and_then(|volume| volume.scattering_depth)),
    ];
    let ids = guides.surface_id.map(|image| ("surface_id", image.extent()));
    images.into_iter().chain(noisy).filter_map(|(name, image)| Some((name, image?.extent()))).chain(ids)
}
