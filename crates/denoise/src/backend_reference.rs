//! The CPU twin behind the same trait: slow, and the measure of what the GPU should give.

use crate::backend::{add, view_picture, Backend, FrameOutputs};
use crate::error::Result;
use crate::frame::FrameInputs;
use crate::frame_images::Texels;
use atrous::config::{GradientSource, Preset, Signals};
use atrous::reference::{Denoiser, DenoiserInputs, GradientSources, Image, ImportInputs, VolumeInputs};
use atrous::{Config, Error, FrameState};

/// The stages on the CPU.
pub struct ReferenceBackend {
    config: Config,
    state: FrameState,
    denoiser: Denoiser,
}

impl ReferenceBackend {
    /// Without history.
    pub fn new(config: &Config) -> Result<Self> {
        Ok(Self { config: *config, state: FrameState::default(), denoiser: Denoiser::new(*config)? })
    }

    fn signals(&self) -> &'static [&'static str] {
        let shows_nothing = self.config.gradient_source == GradientSource::Confidence;
        match self.config.signals {
            _ if self.config.preset == Preset::Volume => &[],
            _ if self.config.preset == Preset::Stabilize && shows_nothing => &[],
            Signals::Apart => &["noisy_direct", "noisy_indirect"],
            _ => &["noisy_radiance"],
        }
    }
}

impl Backend for ReferenceBackend {
    fn name(&self) -> String {
        "the CPU reference".into()
    }

    fn denoise(&mut self, frame: &FrameInputs, views: bool) -> Result<FrameOutputs> {
        let extent = self.config.allocated_extent;
        let strata = extent.map(|side| side.div_ceil(self.config.stratum_size));
        let image = |name: &str| frame.images.get(name).map(|t: &Texels| Image::from_texels(extent, t.clone())).transpose();
        let needed = |name: &str| image(name).and_then(|i| i.ok_or_else(|| Error::NotBound(name.to_owned())));
        let noisy = self.signals().iter().map(|name| needed(name)).collect::<std::result::Result<Vec<_>, _>>()?;
        let noisy: Vec<&Image<[f32; 4]>> = noisy.iter().collect();
        let (depth, normal, motion, roughness) = (needed("depth")?, needed("normal")?, image("motion")?, image("roughness")?);
        let (albedo, emission, object_normal) = (image("albedo")?, image("emission")?, image("object_normal")?);
        let (forward_motion, confidence) = (image("forward_motion")?, image("confidence")?);
        let (reshaded, other) = (image("reshaded_radiance")?, image("other_denoised_radiance")?);
        let (noisy_volume, scattering_depth) = (image("noisy_volume")?, image("scattering_depth")?);
        let sparse = frame.images.get("sparse_gradient").map(|t| Image::from_texels(strata, t.clone())).transpose()?;
        let ids = frame.surface_id.clone().map(|ids| Image::from_texels(extent, ids)).transpose()?;
        let instance_transforms = frame.instance_transforms.as_deref();
        let inputs = DenoiserInputs {
            guides: ImportInputs {
                depth: &depth,
                normal: &normal,
                motion: motion.as_ref(),
                surface_id: ids.as_ref(),
                roughness: roughness.as_ref(),
                instance_transforms,
                object_normal: object_normal.as_ref(),
            },
            noisy: &noisy,
            albedo: albedo.as_ref(),
            emission: emission.as_ref(),
            gradients: GradientSources {
                forward_motion: forward_motion.as_ref(),
                reshaded_radiance: reshaded.as_ref(),
                sparse_gradient: sparse.as_ref(),
                confidence: confidence.as_ref(),
                other_denoised_radiance: other.as_ref(),
            },
            volume: noisy_volume
                .as_ref()
                .map(|noisy_volume| VolumeInputs { noisy_volume, scattering_depth: scattering_depth.as_ref() }),
        };
        let context = self.state.begin(&self.config, &frame.params, &frame.tuning)?;
        let outputs = self.denoiser.frame(&context, &inputs, views)?;
        let surfaces = Some(&outputs.denoised_radiance).filter(|_| self.config.preset != Preset::Volume);
        let mut radiance = vec![[0.0; 3]; frame.noisy.len()];
        for image in surfaces.into_iter().chain(&outputs.denoised_volume) {
            add(&mut radiance, image.texels());
        }
        let mut pictures = Vec::new();
        for view in self.config.declare()?.debug_views() {
            if let Some(image) = self.denoiser.debug_view(&context, &inputs, &outputs, view) {
                pictures.push((view, view_picture(extent, image.texels())?));
            }
        }
        Ok(FrameOutputs { radiance, views: pictures })
    }
}
