//! The denoiser inside this engine: its inputs bound to the engine's images, its phases recorded around the lighting pass.

use ash::vk;
use atrous::config::{Conventions, MotionDepth, MotionUnit, PostProcess, Preset, Signals};
use atrous::executor::{Executor, ExecutorOptions, HostImage, PassTime};
use atrous::{Config, DebugView, Device, FrameContext, FrameParams, Phase, ResetReason, Tuning, UseFrame};

use crate::gpu::{Buffer, Gpu, Image, MemoryKind};
use crate::{Outputs, PathTracer, Result};

/// What the denoiser is asked for.
#[derive(Clone, Copy, Debug, Default)]
pub struct DenoiserOptions {
    /// Filter.
    pub preset: Preset,
    /// Direct and indirect light filtered apart, or as one.
    pub signals: Signals,
    /// Tone map and temporal anti-aliasing after it.
    pub taa: bool,
    /// Per-frame numbers.
    pub tuning: Tuning,
    /// The pass `debug_view`, in frames that ask for it.
    pub debug_view: bool,
}

impl DenoiserOptions {
    /// A preset as its paper has it.
    pub fn new(preset: Preset) -> Self {
        let signals = if preset == Preset::Svgf { Signals::Apart } else { Signals::Together };
        Self { preset, signals, taa: false, tuning: Tuning::for_preset(preset), debug_view: false }
    }
}

/// Denoises what a [`PathTracer`] renders. Keep the tracer as long: the denoiser reads its images.
pub struct FrameDenoiser {
    executor: Executor,
    gpu: Gpu,
    tuning: Tuning,
    shown: Option<DebugView>,
    reset: Option<ResetReason>,
    frame: Option<FrameContext>,
}

impl FrameDenoiser {
    /// Makes the denoiser for a tracer's images.
    ///
    /// # Errors
    /// A device without what the denoiser needs, or no memory.
    pub fn new(gpu: &Gpu, tracer: &PathTracer, options: &DenoiserOptions) -> Result<Self> {
        let extent = tracer.extent();
        let config = Config {
            frames_in_flight: 1,
            preset: options.preset,
            signals: options.signals,
            debug_view: options.debug_view,
            post_process: if options.taa { PostProcess::ToneMapTaa } else { PostProcess::ToneMap },
            conventions: Conventions {
                motion_unit: MotionUnit::Pixels,
                motion_depth: MotionDepth::Absolute,
                ..Conventions::default()
            },
            ..Config::new([extent.width, extent.height])
        };
        let host = Device { instance: gpu.instance(), physical_device: gpu.physical_device(), device: gpu.device() };
        let wanted = ExecutorOptions {
            extra_image_usage: vk::ImageUsageFlags::TRANSFER_SRC,
            timestamps: gpu.timestamp_period().is_some(),
            ..ExecutorOptions::default()
        };
        // SAFETY: `gpu` is kept by this value, and every submission of the engine is waited for.
        let mut executor = unsafe { Executor::new(host, &config, wanted)? };
        for (name, image) in inputs(tracer.outputs(), options.signals) {
            executor.bind_image(name, host_image(image))?;
        }
        Ok(Self { executor, gpu: gpu.clone(), tuning: options.tuning, shown: None, reset: None, frame: None })
    }

    /// Renders and denoises the frame that the tracer was set to, and waits for it.
    ///
    /// # Errors
    /// As [`Self::record`], and a lost device.
    pub fn render(&mut self, tracer: &mut PathTracer) -> Result<()> {
        let gpu = self.gpu.clone();
        gpu.submit(|cmd| {
            tracer.record_gbuffer(cmd);
            self.record(cmd, tracer)
        })
    }

    /// Records lighting with the denoiser around it, behind [`PathTracer::record_gbuffer`] of the same frame.
    ///
    /// # Errors
    /// Numbers out of range, in the tuning or in the camera.
    pub fn record(&mut self, cmd: vk::CommandBuffer, tracer: &mut PathTracer) -> Result<()> {
        let camera = tracer.camera(tracer.frame());
        let extent = tracer.extent();
        let params = FrameParams {
            view_from_world: camera.view_from_world,
            clip_from_view: camera.clip_from_view,
            jitter: camera.jitter,
            reset: self.reset,
            debug_view: self.shown,
            ..FrameParams::new([extent.width, extent.height])
        };
        let frame = self.executor.begin_frame(&params, &self.tuning)?;
        self.frame = Some(frame);
        self.reset = None;
        self.record_phase(cmd, &frame, Phase::BeforeLighting)?;
        tracer.record_lighting(cmd);
        self.record_phase(cmd, &frame, Phase::AfterLighting)?;
        self.record_phase(cmd, &frame, Phase::PostProcess)
    }

    fn record_phase(&mut self, cmd: vk::CommandBuffer, frame: &FrameContext, phase: Phase) -> Result<()> {
        // SAFETY: `cmd` is recording; the engine's images are in the state that they were bound with; every frame is waited for.
        unsafe { self.executor.record(cmd, frame, phase)? };
        Ok(())
    }

    /// The next frame drops all history.
    pub fn reset(&mut self, reason: ResetReason) {
        self.reset = Some(reason);
    }

    /// From the next frame on. Drops no history.
    pub fn set_tuning(&mut self, tuning: Tuning) {
        self.tuning = tuning;
    }

    /// What the output `debug_view` shows from the next frame on, with [`DenoiserOptions::debug_view`].
    pub fn show(&mut self, view: Option<DebugView>) {
        self.shown = view;
    }

    /// Records the output `debug_view` of the last frame anew, with another view.
    ///
    /// # Errors
    /// None in practice.
    pub fn record_debug_view(&mut self, cmd: vk::CommandBuffer, view: DebugView) -> Result<()> {
        let Some(frame) = self.frame else { return Ok(()) };
        // SAFETY: as in `record_phase`; the frame was waited for.
        unsafe { self.executor.record_debug_view(cmd, &FrameContext { debug_view: Some(view), ..frame })? };
        Ok(())
    }

    /// Has an output written into an image of the engine, in layout `GENERAL` when a frame is recorded and after.
    ///
    /// # Errors
    /// A name that does not exist, another format, or an image that is too small.
    pub fn bind_output(&mut self, name: &str, image: &Image) -> Result<()> {
        Ok(self.executor.bind_image(name, host_image(image))?)
    }

    /// Texels of one of the denoiser's outputs or histories in the last frame.
    ///
    /// # Errors
    /// A name that does not exist, or no memory.
    pub fn read(&mut self, name: &str) -> Result<Vec<[f32; 4]>> {
        let Some(frame) = self.frame else { return Ok(Vec::new()) };
        let copy = self.executor.readback(name, &frame, UseFrame::Current)?;
        let buffer = Buffer::new(&self.gpu, "denoiser readback", copy.bytes, MemoryKind::Readback)?;
        let gpu = self.gpu.clone();
        gpu.submit(|cmd| {
            // SAFETY: `cmd` is recording; the buffer has room for the copy; images have TRANSFER_SRC usage.
            unsafe { self.executor.record_copy(cmd, &frame, name, UseFrame::Current, buffer.handle)? };
            Ok(())
        })?;
        Ok(copy.to_floats(&buffer.bytes()[..copy.bytes as usize]))
    }

    /// GPU time of each pass in the frame before the last.
    pub fn times(&self) -> Vec<PassTime> {
        self.executor.times()
    }

    /// The executor, for its memory and declaration.
    pub fn executor(&self) -> &Executor {
        &self.executor
    }
}

fn inputs(outputs: &Outputs, signals: Signals) -> Vec<(&'static str, &Image)> {
    let mut inputs = vec![
        ("depth", &outputs.depth),
        ("normal", &outputs.normal),
        ("motion", &outputs.motion),
        ("surface_id", &outputs.surface_id),
        ("albedo", &outputs.albedo),
        ("emission", &outputs.emission),
    ];
    match signals {
        Signals::Apart => inputs.extend([("noisy_direct", &outputs.direct), ("noisy_indirect", &outputs.indirect)]),
        Signals::Together => inputs.push(("noisy_radiance", &outputs.scattered)),
    }
    inputs
}

fn host_image(image: &Image) -> HostImage {
    HostImage {
        image: image.handle,
        view: image.view,
        format: image.format,
        extent: [image.extent.width, image.extent.height],
        layout: vk::ImageLayout::GENERAL,
        stage: vk::PipelineStageFlags2::COMPUTE_SHADER,
        access: vk::AccessFlags2::SHADER_STORAGE_WRITE,
    }
}
