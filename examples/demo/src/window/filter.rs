//! A filter that runs, with the images that its results are shown from.

use ash::vk;
use atrous::config::Preset;
use atrous::{DebugView, ResetReason, Tuning};

use super::panes::prepare;
use super::shared::{FilterMemory, FilterReport, HISTOGRAM_BARS};
use crate::error::Result;
use crate::gpu::{Gpu, Image};
use crate::{DenoiserOptions, FrameDenoiser, PathTracer};

/// A filter that runs.
pub struct Filter {
    /// Before the images that it writes.
    denoiser: FrameDenoiser,
    /// Which.
    pub preset: Preset,
    /// Radiance.
    pub radiance: Image,
    /// The same, tone-mapped and anti-aliased.
    pub display: Image,
    /// The debug view.
    pub debug: Image,
    /// The frame that it saw last.
    last_frame: Option<u32>,
}

impl Filter {
    /// Makes a filter for a tracer's images.
    ///
    /// # Errors
    /// No memory.
    pub fn new(gpu: &Gpu, tracer: &PathTracer, preset: Preset, taa: bool) -> Result<Self> {
        let image = |name| Image::new(gpu, name, vk::Format::R16G16B16A16_SFLOAT, tracer.extent());
        let (radiance, display, debug) = (image("radiance")?, image("display")?, image("debug view")?);
        prepare(gpu, &[&radiance, &display, &debug])?;
        let options = DenoiserOptions { taa, debug_view: true, ..DenoiserOptions::new(preset) };
        let mut denoiser = FrameDenoiser::new(gpu, tracer, &options)?;
        for (name, image) in [("denoised_radiance", &radiance), ("display", &display), ("debug_view", &debug)] {
            denoiser.bind_output(name, image)?;
        }
        Ok(Self { denoiser, preset, radiance, display, debug, last_frame: None })
    }

    /// Denoises the tracer's frame, whose G-buffer was drawn; `reset`: without history.
    ///
    /// # Errors
    /// A lost device.
    pub fn frame(&mut self, gpu: &Gpu, tracer: &mut PathTracer, tuning: Tuning, reset: bool) -> Result<()> {
        self.denoiser.set_tuning(tuning);
        let frame = tracer.frame();
        // What it remembers is of another frame than the one before.
        let missed = self.last_frame.is_some_and(|last| last + 1 != frame);
        if reset || missed {
            self.denoiser.reset(ResetReason::CameraCut);
        }
        self.last_frame = Some(frame);
        gpu.submit(|cmd| self.denoiser.record(cmd, tracer))
    }

    /// Gives its passes other code; whether one of them runs that shader.
    ///
    /// # Errors
    /// As [`FrameDenoiser::replace_shader`].
    #[cfg(feature = "hot-reload")]
    pub fn replace_shader(&mut self, shader: &crate::hot_reload::Compiled) -> Result<bool> {
        self.denoiser.replace_shader(shader)
    }

    /// Shows a view of the last frame.
    ///
    /// # Errors
    /// A lost device.
    pub fn show(&mut self, gpu: &Gpu, view: DebugView) -> Result<()> {
        gpu.submit(|cmd| self.denoiser.record_debug_view(cmd, view))
    }

    /// Whether it saw the tracer's frame.
    pub fn is_current(&self, tracer: &PathTracer) -> bool {
        self.last_frame == Some(tracer.frame())
    }

    /// Times, memory, views.
    pub fn report(&self) -> FilterReport {
        let allocated = self.denoiser.executor().allocated();
        let declaration = self.denoiser.executor().denoiser().declaration();
        let memory =
            FilterMemory { history: allocated.history, transient: allocated.transient, output: declaration.memory().output };
        FilterReport { preset: self.preset, times: self.denoiser.times(), memory, views: declaration.debug_views() }
    }

    /// Pixels by history length; `None` for a filter without history.
    ///
    /// # Errors
    /// A lost device.
    pub fn histogram(&mut self) -> Result<Option<[u32; HISTOGRAM_BARS]>> {
        let name = match self.denoiser.executor().denoiser().declaration() {
            d if d.find("moments").is_some() => "moments",
            d if d.find("moments_direct").is_some() => "moments_direct",
            _ => return Ok(None),
        };
        let mut bars = [0; HISTOGRAM_BARS];
        for texel in self.denoiser.read(name)? {
            let frames = half::f16::from_bits(texel[2] as u16).to_f32();
            bars[(frames as usize).min(HISTOGRAM_BARS - 1)] += 1;
        }
        Ok(Some(bars))
    }
}
