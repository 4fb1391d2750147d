//! What filters frames: the GPU, or the CPU twin. Frames come in order, since both keep a history.

use crate::error::Result;
use crate::frame::{FrameInputs, Texels};
use atrous::executor::{HeadlessDevice, HeadlessOptions, Session, SessionOptions};
use atrous::{Config, Lifetime, Shape};
use std::sync::Arc;

/// What a pixel's history looked like, per signal.
#[derive(Clone, Debug, Default)]
pub struct MomentsView {
    /// `""` where there is one signal, else `_direct` or `_indirect`.
    pub suffix: &'static str,
    /// Frames accumulated.
    pub history_length: Vec<f32>,
    /// Standard deviation of the luminance.
    pub deviation: Vec<f32>,
    /// 0 with history; 1 off screen, 2 background or id, 3 depth, 4 normal, 5 reset.
    pub reason: Vec<u8>,
}

/// Result of a frame.
#[derive(Clone, Debug, Default)]
pub struct FrameOutputs {
    /// Denoised radiance, with albedo and emission.
    pub radiance: Vec<[f32; 3]>,
    /// Views, where they were asked for.
    pub views: Vec<MomentsView>,
}

/// Filters frames in order.
pub trait Backend {
    /// What it runs on.
    fn name(&self) -> String;
    /// Filters the next frame.
    fn denoise(&mut self, frame: &FrameInputs, views: bool) -> Result<FrameOutputs>;
}

/// The passes on a Vulkan device.
pub struct GpuBackend {
    session: Session,
    name: String,
    /// Input images, and whether they are optional.
    inputs: Vec<(&'static str, bool)>,
    moments: Vec<(&'static str, &'static str)>,
    has_transforms: bool,
    /// Surfaces and volume, which together are the picture.
    results: Vec<&'static str>,
}

const TRANSFORMS: &str = "instance_transforms";

impl GpuBackend {
    /// Opens a device, by index or part of its name.
    pub fn new(device: Option<String>, config: &Config) -> Result<Self> {
        let gpu = Arc::new(HeadlessDevice::new(&HeadlessOptions { device, ..HeadlessOptions::default() })?);
        let name = gpu.name().to_owned();
        let session = Session::new(gpu, config, SessionOptions::default())?;
        let declaration = config.declare()?;
        let image = |shape: &Shape| matches!(shape, Shape::Image { .. });
        let inputs = declaration.resources().iter().filter(|r| image(&r.shape)).filter_map(|r| match r.lifetime {
            Lifetime::Input { optional } => Some((r.name, optional)),
            _ => None,
        });
        let results =
            ["denoised_radiance", "denoised_volume"].into_iter().filter(|name| declaration.find(name).is_some()).collect();
        let known = [("moments", ""), ("moments_direct", "_direct"), ("moments_indirect", "_indirect")];
        let moments = known.into_iter().filter(|m| declaration.find(m.0).is_some()).collect();
        Ok(Self {
            inputs: inputs.collect(),
            moments,
            results,
            has_transforms: declaration.find(TRANSFORMS).is_some(),
            session,
            name,
        })
    }
}

impl Backend for GpuBackend {
    fn name(&self) -> String {
        self.name.clone()
    }

    fn denoise(&mut self, frame: &FrameInputs, views: bool) -> Result<FrameOutputs> {
        for &(name, optional) in &self.inputs {
            match (name, &frame.surface_id, frame.images.get(name)) {
                ("surface_id", Some(ids), _) => self.session.upload_ids(name, ids)?,
                (_, _, Some(texels)) => self.session.upload(name, texels)?,
                // A required one that is absent is named by the executor.
                _ if optional => self.session.unbind(name)?,
                _ => {}
            }
        }
        if self.has_transforms {
            match &frame.instance_transforms {
                Some(transforms) => self.session.upload_buffer(TRANSFORMS, bytemuck::cast_slice(transforms))?,
                None => self.session.unbind(TRANSFORMS)?,
            }
        }
        self.session.run(&frame.params, &frame.tuning)?;
        let mut radiance = vec![[0.0; 3]; frame.noisy.len()];
        for name in &self.results {
            add(&mut radiance, &self.session.download(name)?);
        }
        let mut outputs = FrameOutputs { radiance, views: Vec::new() };
        if views {
            for &(name, suffix) in &self.moments {
                outputs.views.push(unpack_moments(suffix, &self.session.download(name)?));
            }
        }
        Ok(outputs)
    }
}

/// Adds a part of the picture.
pub fn add(radiance: &mut [[f32; 3]], part: &[[f32; 4]]) {
    for (sum, texel) in radiance.iter_mut().zip(part) {
        *sum = std::array::from_fn(|c| sum[c] + texel[c]);
    }
}

/// `moments`: mean, standard deviation and N as half floats, and the reason, in four 16-bit integers.
fn unpack_moments(suffix: &'static str, texels: &Texels) -> MomentsView {
    let half = |v: f32| half::f16::from_bits(v as u16).to_f32();
    MomentsView {
        suffix,
        history_length: texels.iter().map(|t| half(t[2])).collect(),
        deviation: texels.iter().map(|t| half(t[1])).collect(),
        reason: texels.iter().map(|t| t[3] as u8).collect(),
    }
}
