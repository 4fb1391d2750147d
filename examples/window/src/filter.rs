//! A filter that runs, with the images that its results are shown from.

use ash::vk;
use atrous::config::{PostProcess, Preset};
use atrous::{DebugView, ResetReason, Tuning};

use super::panes::{prepare, Source};
use super::shared::{FilterMemory, FilterReport, HISTOGRAM_BARS};
use atrous_engine::gpu::{Gpu, Image};
use atrous_engine::scene::Moment;
use atrous_engine::Result;
use atrous_engine::{DenoiserOptions, FrameDenoiser, PathTracer};

/// A filter that runs.
pub struct Filter {
    /// Before the images that it writes.
    denoiser: FrameDenoiser,
    /// Which.
    pub preset: Preset,
    /// Radiance of surfaces.
    pub radiance: Image,
    /// That of the medium, where there is one.
    pub medium: Option<Image>,
    /// The same, tone-mapped, and gathered over time where the filter does so.
    pub display: Image,
    /// Whether the filter does so.
    is_gathered: bool,
    /// The debug view, of the pixels that have light.
    pub debug: Image,
    /// The tracer's frame that it saw last.
    last_frame: Option<u32>,
    /// The moment that its history is of.
    remembered: Option<Moment>,
}

impl Filter {
    /// Makes a filter for a tracer's images. `gathered`: temporal anti-aliasing, and another size of the output.
    ///
    /// # Errors
    /// An output that is smaller than the tracer's images or more than three times as large, or no memory.
    pub fn new(gpu: &Gpu, tracer: &PathTracer, preset: Preset, gathered: (bool, Option<vk::Extent2D>)) -> Result<Self> {
        let image = |name, extent| Image::new(gpu, name, vk::Format::R16G16B16A16_SFLOAT, extent);
        let ((taa, output), rendered) = (gathered, tracer.extent());
        let radiance = image("radiance", rendered)?;
        let display = image("display", output.unwrap_or(rendered))?;
        let debug = image("debug view", tracer.light_extent())?;
        let medium = tracer.volume().map(|_| image("medium", rendered)).transpose()?;
        let outputs = [("denoised_radiance", &radiance), ("display", &display), ("debug_view", &debug)];
        let outputs: Vec<_> = outputs.into_iter().chain(medium.as_ref().map(|image| ("denoised_volume", image))).collect();
        prepare(gpu, &outputs.iter().map(|output| output.1).collect::<Vec<_>>())?;
        let options = DenoiserOptions::new(preset).with(|config| {
            config.debug_view = true;
            config.output_extent = output.map(|extent| [extent.width, extent.height]);
            config.post_process = if taa { PostProcess::ToneMapTaa } else { PostProcess::ToneMap };
        });
        let mut denoiser = FrameDenoiser::new(gpu, tracer, &options)?;
        for (name, image) in outputs {
            denoiser.bind_output(name, image)?;
        }
        let is_gathered = taa || output.is_some();
        Ok(Self { denoiser, preset, radiance, medium, display, is_gathered, debug, last_frame: None, remembered: None })
    }

    /// Denoises the tracer's frame, whose G-buffer was drawn, with motion from the moment `before` to `now`. Its history goes on from there, however
    /// many frames it has not seen meanwhile: where time stands still they change nothing. Else there is no motion from what it remembers.
    ///
    /// # Errors
    /// A lost device.
    pub fn frame(&mut self, gpu: &Gpu, tracer: &mut PathTracer, tuning: Tuning, now: &Moment, before: &Moment) -> Result<()> {
        self.denoiser.set_tuning(tuning);
        if self.remembered.replace(*now) != Some(*before) {
            self.denoiser.reset(ResetReason::CameraCut);
        }
        self.last_frame = Some(tracer.frame());
        gpu.submit(|cmd| self.denoiser.record(cmd, tracer))
    }

    /// The next frame is without history, whenever that is.
    pub fn forget(&mut self) {
        self.remembered = None;
    }

    /// What came out, display-referred where it is gathered over time.
    pub fn source(&self) -> Source<'_> {
        if self.is_gathered {
            return Source::of(&self.display);
        }
        self.linear()
    }

    /// What came out before the tone map.
    pub fn linear(&self) -> Source<'_> {
        Source::sum((&self.radiance, 1.0), self.medium.as_ref().map(|medium| (medium, 1.0)))
    }

    /// Gives its passes other code; whether one of them runs that shader.
    ///
    /// # Errors
    /// As [`FrameDenoiser::replace_shader`].
    #[cfg(feature = "hot-reload")]
    pub fn replace_shader(&mut self, shader: &atrous_engine::hot_reload::Compiled) -> Result<bool> {
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
        let tunables = declaration.tunables().map(|field| field.name).collect();
        FilterReport { preset: self.preset, times: self.denoiser.times(), memory, views: declaration.debug_views(), tunables }
    }

    /// Pixels by history length; `None` for a filter without history.
    ///
    /// # Errors
    /// A lost device.
    pub fn histogram(&mut self) -> Result<Option<[u32; HISTOGRAM_BARS]>> {
        if !self.denoiser.executor().denoiser().declaration().debug_views().contains(&DebugView::HistoryLength) {
            return Ok(None);
        }
        let mut bars = [0; HISTOGRAM_BARS];
        for [_, _, _, frames] in self.denoiser.view(DebugView::HistoryLength)? {
            // The background has none, and counts as new.
            bars[(frames as usize).clamp(1, HISTOGRAM_BARS - 1)] += 1;
        }
        Ok(Some(bars))
    }
}
