//! What filters frames: the GPU, or the CPU twin. Frames come in order, since both keep a history.

use crate::error::{Result, ToolError};
use crate::frame::FrameInputs;
use atrous::executor::{HeadlessDevice, HeadlessOptions, Session, SessionOptions};
use atrous::{Config, DebugView, Lifetime, Shape};
use atrous_picture::Picture;
use std::sync::Arc;

/// Result of a frame.
#[derive(Clone, Debug, Default)]
pub struct FrameOutputs {
    /// Denoised radiance, with albedo and emission.
    pub radiance: Vec<[f32; 3]>,
    /// What the preset knows of each pixel, where it was asked for.
    pub views: Vec<(DebugView, Picture)>,
}

/// Filters frames in order.
pub trait Backend {
    /// What it runs on.
    fn name(&self) -> String;
    /// Filters the next frame. Views need [`Config::debug_view`].
    fn denoise(&mut self, frame: &FrameInputs, views: bool) -> Result<FrameOutputs>;
}

/// The passes on a Vulkan device.
pub struct GpuBackend {
    session: Session,
    name: String,
    /// Input images, and whether they are optional.
    inputs: Vec<(String, bool)>,
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
            Lifetime::Input { optional } => Some((r.name.clone(), optional)),
            _ => None,
        });
        let results =
            ["denoised_radiance", "denoised_volume"].into_iter().filter(|name| declaration.find(name).is_some()).collect();
        Ok(Self { inputs: inputs.collect(), results, has_transforms: declaration.find(TRANSFORMS).is_some(), session, name })
    }
}

impl Backend for GpuBackend {
    fn name(&self) -> String {
        self.name.clone()
    }

    fn denoise(&mut self, frame: &FrameInputs, views: bool) -> Result<FrameOutputs> {
        for (name, optional) in &self.inputs {
            match (name.as_str(), &frame.surface_id, frame.images.get(name.as_str())) {
                ("surface_id", Some(ids), _) => self.session.upload_ids(name, ids)?,
                (_, _, Some(texels)) => self.session.upload(name, texels)?,
                // A required one that is absent is named by the executor.
                _ if *optional => self.session.unbind(name)?,
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
            let declaration = self.session.executor().denoiser().declaration();
            let extent = declaration.allocated_extent();
            for view in declaration.debug_views() {
                outputs.views.push((view, view_picture(extent, &self.session.debug_view(view)?)?));
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

/// As a picture: the alpha channel holds the numbers behind the colours.
pub fn view_picture([width, height]: [u32; 2], texels: &[[f32; 4]]) -> Result<Picture> {
    let colours: Vec<_> = texels.iter().map(|&[r, g, b, _]| [r, g, b]).collect();
    Picture::from_display(width, height, &colours).map_err(|e| ToolError::Usage(e.to_string()))
}
