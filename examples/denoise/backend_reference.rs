//! The CPU twin behind the same trait: slow, and the measure of what the GPU should give.

use crate::backend::{Backend, FrameOutputs, MomentsView};
use crate::error::Result;
use crate::frame::{FrameInputs, Texels};
use atrous::config::Signals;
use atrous::reference::{unpack_moments, Image, ImportInputs, Svgf, SvgfInputs, SvgfViews};
use atrous::{Config, Error, FrameState, Tuning};

/// The stages on the CPU.
pub struct ReferenceBackend {
    config: Config,
    tuning: Tuning,
    state: FrameState,
    svgf: Svgf,
}

impl ReferenceBackend {
    /// Without history.
    pub fn new(config: &Config, tuning: Tuning) -> Result<Self> {
        Ok(Self { config: *config, tuning, state: FrameState::default(), svgf: Svgf::new(*config)? })
    }

    fn signals(&self) -> &'static [&'static str] {
        match self.config.signals {
            Signals::Together => &["noisy_radiance"],
            Signals::Apart => &["noisy_direct", "noisy_indirect"],
        }
    }
}

impl Backend for ReferenceBackend {
    fn name(&self) -> String {
        "the CPU reference".into()
    }

    fn denoise(&mut self, frame: &FrameInputs, views: bool) -> Result<FrameOutputs> {
        let extent = self.config.allocated_extent;
        let image = |name: &str| frame.images.get(name).map(|t: &Texels| Image::from_texels(extent, t.clone())).transpose();
        let needed = |name: &str| image(name).and_then(|i| i.ok_or_else(|| Error::NotBound(name.to_owned())));
        let noisy = self.signals().iter().map(|name| needed(name)).collect::<std::result::Result<Vec<_>, _>>()?;
        let noisy: Vec<&Image<[f32; 4]>> = noisy.iter().collect();
        let (depth, normal, motion, roughness) = (needed("depth")?, needed("normal")?, image("motion")?, image("roughness")?);
        let (albedo, emission) = (image("albedo")?, image("emission")?);
        let ids = frame.surface_id.clone().map(|ids| Image::from_texels(extent, ids)).transpose()?;
        let inputs = SvgfInputs {
            guides: ImportInputs {
                depth: &depth,
                normal: &normal,
                motion: motion.as_ref(),
                surface_id: ids.as_ref(),
                roughness: roughness.as_ref(),
                instance_transforms: None,
                object_normal: None,
            },
            noisy: &noisy,
            albedo: albedo.as_ref(),
            emission: emission.as_ref(),
        };
        let context = self.state.begin(&self.config, &frame.params, &self.tuning)?;
        let outputs = self.svgf.frame(&context, &inputs, views)?;
        Ok(FrameOutputs {
            radiance: outputs.denoised_radiance.texels().iter().map(|[r, g, b, _]| [*r, *g, *b]).collect(),
            views: outputs.views.map(|v| self.moments(&v)).unwrap_or_default(),
        })
    }
}

impl ReferenceBackend {
    fn moments(&self, views: &SvgfViews) -> Vec<MomentsView> {
        let suffixes: &[&'static str] = match self.config.signals {
            Signals::Together => &[""],
            Signals::Apart => &["_direct", "_indirect"],
        };
        let view = |(image, suffix): (&Image<[u16; 4]>, &&'static str)| {
            let moments: Vec<_> = image.texels().iter().map(|t| unpack_moments(*t)).collect();
            MomentsView {
                suffix,
                history_length: moments.iter().map(|m| m.history_length).collect(),
                deviation: moments.iter().map(|m| m.deviation).collect(),
                reason: moments.iter().map(|m| m.reason as u8).collect(),
            }
        };
        views.moments.iter().zip(suffixes).map(view).collect()
    }
}
