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
    /// The same, tone-mapped and anti-aliased.
    display: Image,
    /// Whether the filter has it.
    taa: bool,
    /// The debug view.
    pub debug: Image,
    /// The tracer's frame that it saw last.
    last_frame: Option<u32>,
    /// The moment that its history is of.
    remembered: Option<Moment>,
}

impl Filter {
    /// Makes a filter for a tracer's images.
    ///
    /// # Errors
    /// No memory.
    pub fn new(gpu: &Gpu, tracer: &PathTracer, preset: Preset, taa: bool) -> Result<Self> {
        let image = |name| Image::new(gpu, name, vk::Format::R16G16B16A16_SFLOAT, tracer.extent());
        let (radiance, display, debug) = (image("radiance")?, image("display")?, image("debug view")?);
        let medium = tracer.volume().map(|_| image("medium")).transpose()?;
        let outputs = [("denoised_radiance", &radiance), ("display", &display), ("debug_view", &debug)];
        let outputs: Vec<_> = outputs.into_iter().chain(medium.as_ref().map(|image| ("denoised_volume", image))).collect();
        prepare(gpu, &outputs.iter().map(|output| output.1).collect::<Vec<_>>())?;
        let options = DenoiserOptions::new(preset).with(|config| {
            config.debug_view = true;
            config.post_process = if taa { PostProcess::ToneMapTaa } else { PostProcess::ToneMap };
        });
        let mut denoiser = FrameDenoiser::new(gpu, tracer, &options)?;
        for (name, image) in outputs {
            denoiser.bind_output(name, image)?;
        }
        Ok(Self { denoiser, preset, radiance, medium, display, taa, debug, last_frame: None, remembered: None })
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

    /// What came out, display-referred with temporal anti-aliasing.
    pub fn source(&self) -> Source<'_> {
        if self.taa {
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
