//! The denoiser inside this engine: its inputs bound to the engine's images, its phases recorded around the lighting pass.

use ash::vk;
use atrous::config::{Conventions, MotionDepth, MotionUnit, PostProcess, Preset, Signals};
use atrous::executor::{Executor, ExecutorOptions, HostImage, PassTime};
use atrous::{Config, DebugView, Declaration, FrameContext, FrameParams, Input, Phase, ResetReason, Tuning, UseFrame};
use clap::ValueEnum;

use crate::gpu::{Buffer, Gpu, Image, MemoryKind};
use crate::tracer::barriers::general_barrier;
use crate::tracer::{angular_radius, Reshading, SampleEye};
use crate::{PathTracer, Result};

/// The filters that the demo compares, in the order of strips, tables and menus. A-SVGF, which has lighting of its own, is not the last: then the
/// noisy picture is the one that all others had.
pub const FILTERS: [Preset; 6] = [Preset::Svgf, Preset::Asvgf, Preset::Percentile, Preset::Fast, Preset::Eaw, Preset::Best];

/// A graph for what a configuration says of the host.
pub type GraphOfConfig = fn(&Config) -> std::result::Result<Declaration, atrous::Error>;

/// How a denoiser follows what moves in reflections.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Reflections {
    /// Not at all: only the eye and the surface move.
    AtRest,
    /// By the id of the thing that is reflected.
    #[default]
    Ids,
    /// By its motion, which the engine tells.
    Motion,
}

/// What the denoiser is asked for.
#[derive(Clone, Copy, Debug)]
pub struct DenoiserOptions {
    /// The filter. Extent, inputs and conventions are the engine's.
    pub config: Config,
    /// Whether fog has motion of its own; else it moves as the surfaces behind it.
    pub volume_motion: bool,
    /// It gets motion of each pixel and transforms of instances; else the camera's matrices alone.
    pub motion: bool,
    /// How reflections follow the thing in them.
    pub reflections: Reflections,
    /// Shadows follow the thing that casts them by its id.
    pub occluder_ids: bool,
    /// They follow the lights, whose places are told.
    pub light_places: bool,
    /// Per-frame numbers to start with.
    pub tuning: Tuning,
    /// The eye for which gradient samples are shaded. `None`: the current one, but where specular light is apart and no medium lies before
    /// it: its reflections are followed as they move, and lose their history to gradients that see the same movement. In a medium all
    /// light depends on the eye.
    pub sample_eye: Option<SampleEye>,
    /// A graph in place of that of the preset, which says what the inputs are.
    pub graph: Option<GraphOfConfig>,
}

impl DenoiserOptions {
    /// A preset as its paper has it: light apart in SVGF \[SVGF 3\], together in A-SVGF \[ASVGF 4\] and EAW. Percentile-adaptive SVGF is meant to
    /// cost no more than SVGF on one signal. The filter of choice has reflections apart.
    pub fn new(preset: Preset) -> Self {
        let signals = match preset {
            Preset::Svgf => Signals::Apart,
            Preset::Best => Signals::Specular,
            _ => Signals::Together,
        };
        Self {
            config: Config { preset, signals, post_process: PostProcess::ToneMap, ..Config::new([1; 2]) },
            volume_motion: true,
            motion: true,
            reflections: Reflections::default(),
            occluder_ids: true,
            light_places: true,
            sample_eye: None,
            graph: None,
            tuning: Tuning::for_preset(preset),
        }
    }

    /// The same with another configuration.
    pub fn with(mut self, change: impl FnOnce(&mut Config)) -> Self {
        change(&mut self.config);
        self
    }

    fn sample_eye(&self, tracer: &PathTracer) -> SampleEye {
        let follows = self.config.signals == Signals::Specular && tracer.volume().is_none();
        self.sample_eye.unwrap_or(if follows { SampleEye::Kept } else { SampleEye::Current })
    }

    fn config(&self, tracer: &PathTracer) -> Config {
        let (extent, light) = (tracer.extent(), tracer.light_extent());
        Config {
            allocated_extent: [extent.width, extent.height],
            frames_in_flight: 1,
            volume: tracer.volume().is_some(),
            visibility: tracer.lamps_apart().len() as u32,
            coloured_visibility: !tracer.lamps_apart().is_empty() && tracer.scene().has_glass(),
            ambient_occlusion: tracer.ambient().is_some(),
            light_extent: (light != extent).then_some([light.width, light.height]),
            conventions: Conventions {
                motion_unit: MotionUnit::Pixels,
                motion_depth: MotionDepth::Absolute,
                ..Conventions::default()
            },
            ..self.config
        }
    }
}

impl Default for DenoiserOptions {
    fn default() -> Self {
        Self::new(Preset::default())
    }
}

/// Denoises what a [`PathTracer`] renders. Several may share a tracer, with one or another used in a frame; one that did not see the moment
/// that motion is from has to be [`Self::reset`]. Keep the tracer as long: the denoiser reads its images.
pub struct FrameDenoiser {
    executor: Executor,
    preset: Preset,
    /// For presets whose gradient samples the tracer shades again; others pay nothing.
    reshading: Option<Reshading>,
    gpu: Gpu,
    tuning: Tuning,
    reset: Option<ResetReason>,
    light_places: bool,
    frame: Option<FrameContext>,
    /// What another denoiser writes, and this one reads.
    followed: Option<Image>,
}

impl FrameDenoiser {
    /// Makes the denoiser for a tracer's images.
    ///
    /// # Errors
    /// A device without what the denoiser needs, or no memory.
    pub fn new(gpu: &Gpu, tracer: &PathTracer, options: &DenoiserOptions) -> Result<Self> {
        let config = options.config(tracer);
        let declaration = options.graph.map_or_else(|| config.declare(), |graph| graph(&config))?;
        let mut tuning = options.tuning;
        set_light_radii(&mut tuning, tracer)?;
        let wanted = ExecutorOptions {
            extra_image_usage: vk::ImageUsageFlags::TRANSFER_SRC,
            timestamps: gpu.timestamp_period().is_some(),
            ..ExecutorOptions::default()
        };
        // SAFETY: `gpu` is kept by this value, and every submission of the engine is waited for.
        let mut executor = unsafe { Executor::new(gpu.host(), declaration, wanted)? };
        for (name, image) in inputs(tracer, options) {
            executor.bind_image(name, host_image(image, vk::AccessFlags2::SHADER_STORAGE_WRITE))?;
        }
        if options.motion {
            let transforms = tracer.previous_from_current();
            let (stage, access) = (vk::PipelineStageFlags2::ALL_TRANSFER, vk::AccessFlags2::TRANSFER_WRITE);
            executor.bind_buffer("instance_transforms", transforms.handle, transforms.size, stage, access)?;
        }
        // What is seen through glass is no sample of one surface.
        let reshades = executor.denoiser().declaration().find("gradient_samples").is_some() && !tracer.scene().has_glass();
        let reshading = if reshades { Some(tracer.reshading(config.stratum_size, options.sample_eye(tracer))?) } else { None };
        if let Some(reshading) = &reshading {
            let image = host_image(&reshading.gradient_samples, vk::AccessFlags2::SHADER_SAMPLED_READ);
            executor.bind_image("gradient_samples", image)?;
        }
        Ok(Self {
            executor,
            preset: options.config.preset,
            reshading,
            gpu: gpu.clone(),
            tuning,
            reset: None,
            light_places: options.light_places,
            frame: None,
            followed: None,
        })
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

    /// Records lighting with the denoiser around it, behind [`PathTracer::record_gbuffer`] of the same frame. Submit it before anything else is
    /// recorded, and wait for it before the next frame. Several denoisers may follow one another: each has the lighting that it needs.
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
            reshaded: self.reshading.is_some(),
            lights: if self.light_places { lights(tracer) } else { [[0.0; 4]; 4] },
            light_offset: tracer.light_offset(),
            ..FrameParams::new([extent.width, extent.height])
        };
        let frame = self.executor.begin_frame(&params, &self.tuning)?;
        self.frame = Some(frame);
        self.reset = None;
        self.record_phase(cmd, &frame, Phase::BeforeLighting)?;
        match &mut self.reshading {
            Some(reshading) => tracer.record_lighting_reshaded(cmd, reshading),
            None => tracer.record_lighting(cmd),
        }
        self.record_phase(cmd, &frame, Phase::AfterLighting)?;
        self.record_phase(cmd, &frame, Phase::PostProcess)
    }

    fn record_phase(&mut self, cmd: vk::CommandBuffer, frame: &FrameContext, phase: Phase) -> Result<()> {
        // SAFETY: `cmd` is recording; the engine's images are in the state that they were bound with; every frame is waited for.
        unsafe { self.executor.record(cmd, frame, phase)? };
        Ok(())
    }

    /// Makes the next frame drop all history.
    pub fn reset(&mut self, reason: ResetReason) {
        self.reset = Some(reason);
    }

    /// Per-frame numbers of the last frame, or those that the next one will have.
    pub fn tuning(&self) -> &Tuning {
        &self.tuning
    }

    /// From the next frame on. Drops no history.
    pub fn set_tuning(&mut self, tuning: Tuning) {
        self.tuning = tuning;
    }

    /// Gives the denoiser's passes other code, or the pass that shades gradient samples again; whether one of them runs that shader. Keeps the
    /// history.
    ///
    /// # Errors
    /// A shader that does not fit, no memory, or a lost device: the old code stays.
    #[cfg(feature = "hot-reload")]
    pub fn replace_shader(&mut self, shader: &crate::hot_reload::Compiled) -> Result<bool> {
        match (shader.owner(), &mut self.reshading) {
            // SAFETY: shaderc made it for Vulkan 1.1, and every submission of the engine is waited for.
            (crate::hot_reload::Owner::Denoiser, _) => unsafe { Ok(self.executor.replace_shader(shader.name(), shader.spirv())?) },
            (crate::hot_reload::Owner::Engine, Some(reshading)) => reshading.replace_shader(shader),
            (crate::hot_reload::Owner::Engine, None) => Ok(false),
        }
    }

    /// Records the output `debug_view` of the last frame, with `Config::debug_view`: as often as there are views to show.
    ///
    /// # Errors
    /// None in practice.
    pub fn record_debug_view(&mut self, cmd: vk::CommandBuffer, view: DebugView) -> Result<()> {
        let Some(frame) = self.frame else { return Ok(()) };
        // SAFETY: `cmd` is recording, and the host waited for the frame whose outputs this reads.
        unsafe { self.executor.record_debug_view(cmd, &FrameContext { debug_view: Some(view), ..frame })? };
        Ok(())
    }

    /// What the denoiser knows of each pixel of the last frame, with `Config::debug_view`: rgb as it is displayed, linear; alpha: the
    /// number behind it. Nothing before the first frame.
    ///
    /// # Errors
    /// A denoiser without debug views, or no memory.
    pub fn view(&mut self, view: DebugView) -> Result<Vec<[f32; 4]>> {
        let gpu = self.gpu.clone();
        gpu.submit(|cmd| self.record_debug_view(cmd, view))?;
        self.read("debug_view")
    }

    /// Has an output written into an image of the engine, in layout `GENERAL` when a frame is recorded and after.
    ///
    /// # Errors
    /// A name that does not exist, another format, or an image that is too small.
    pub fn bind_output(&mut self, name: &str, image: &Image) -> Result<()> {
        Ok(self.executor.bind_image(name, host_image(image, vk::AccessFlags2::SHADER_STORAGE_WRITE))?)
    }

    /// Has it filter the picture of another one, which is recorded before it in every frame: for [`Preset::Stabilize`].
    ///
    /// # Errors
    /// A preset that filters the noisy picture, or no memory.
    pub fn follow(&mut self, other: &mut FrameDenoiser, extent: vk::Extent2D) -> Result<()> {
        let picture = Image::new(&self.gpu, "followed", vk::Format::R16G16B16A16_SFLOAT, extent)?;
        self.gpu.submit(|cmd| {
            general_barrier(self.gpu.device(), cmd, &[&picture]);
            Ok(())
        })?;
        other.bind_output("denoised_radiance", &picture)?;
        self.executor.bind_image("other_denoised_radiance", host_image(&picture, vk::AccessFlags2::SHADER_STORAGE_WRITE))?;
        self.followed = Some(picture);
        Ok(())
    }

    /// The filter.
    pub fn preset(&self) -> Preset {
        self.preset
    }

    /// Texels of one of the denoiser's outputs or histories in the last frame: `display`, `denoised_radiance`, ...
    ///
    /// # Errors
    /// A name that does not exist, or no memory.
    pub fn read(&mut self, name: &str) -> Result<Vec<[f32; 4]>> {
        let Some(frame) = self.frame else { return Ok(Vec::new()) };
        let copy = self.executor.readback(name, &frame, UseFrame::Current)?;
        Ok(copy.to_floats(&self.read_bytes(name)?))
    }

    /// The same, as bytes in the format of the image: packed bits, for example, whose floats would be rounded.
    ///
    /// # Errors
    /// A name that does not exist, or no memory.
    pub fn read_bytes(&mut self, name: &str) -> Result<Vec<u8>> {
        let Some(frame) = self.frame else { return Ok(Vec::new()) };
        let copy = self.executor.readback(name, &frame, UseFrame::Current)?;
        let buffer = Buffer::new(&self.gpu, "denoiser readback", copy.bytes, MemoryKind::Readback)?;
        let gpu = self.gpu.clone();
        gpu.submit(|cmd| {
            // SAFETY: `cmd` is recording; the buffer has room for the copy; images have TRANSFER_SRC usage.
            unsafe { self.executor.record_copy(cmd, &frame, name, UseFrame::Current, buffer.handle)? };
            Ok(())
        })?;
        Ok(buffer.bytes()[..copy.bytes as usize].to_vec())
    }

    /// Writes the inputs of the next frames as an EXR sequence: see [`atrous::capture`].
    ///
    /// # Errors
    /// A folder that cannot be written, or that holds a sequence.
    #[cfg(feature = "capture")]
    pub fn capture(&mut self, folder: &std::path::Path, frames: u32) -> Result<()> {
        Ok(self.executor.capture(folder, frames)?)
    }

    /// Writes what is left of a capture.
    ///
    /// # Errors
    /// What ended the capture early.
    #[cfg(feature = "capture")]
    pub fn finish_capture(&mut self) -> Result<u32> {
        // SAFETY: every submission of the engine is waited for.
        Ok(unsafe { self.executor.finish_capture()? })
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

/// Distance from lamps near by for which shadows have the right width, scene units.
const LAMP_DISTANCE: f32 = 3.0;

/// Those of the lamps that are apart, where nobody chose others.
fn set_light_radii(tuning: &mut Tuning, tracer: &PathTracer) -> Result<()> {
    let names = ["light_radius", "light_radius_1", "light_radius_2", "light_radius_3"];
    let default = Tuning::default();
    for (name, lamp) in names.into_iter().zip(&tracer.scene().lamps).take(tracer.lamps_apart().len()) {
        if tuning.get(name) == default.get(name) {
            tuning.set(name, angular_radius(lamp, LAMP_DISTANCE))?;
        }
    }
    Ok(())
}

fn lights(tracer: &PathTracer) -> [[f32; 4]; 4] {
    let places = tracer.lamp_places();
    std::array::from_fn(|i| places.get(i).copied().unwrap_or_default())
}

fn inputs<'a>(tracer: &'a PathTracer, options: &DenoiserOptions) -> Vec<(&'static str, &'a Image)> {
    let outputs = tracer.outputs();
    let mut inputs = vec![("depth", &outputs.depth), ("normal", &outputs.normal), ("surface_id", &outputs.surface_id)];
    inputs.extend(options.motion.then_some(("motion", &outputs.motion)));
    // Another denoiser's picture has it already.
    if options.config.preset != Preset::Stabilize {
        inputs.push(("emission", &outputs.emission));
    }
    let knows_coat = matches!(options.config.signals, Signals::Specular | Signals::Mixed);
    let albedo = if knows_coat { &outputs.diffuse_albedo } else { &outputs.albedo };
    inputs.push(("albedo", albedo));
    match options.config.signals {
        Signals::Apart => inputs.extend([("noisy_direct", &outputs.direct), ("noisy_indirect", &outputs.indirect)]),
        Signals::Specular => inputs.extend([("noisy_diffuse", &outputs.diffuse), ("noisy_specular", &outputs.specular)]),
        _ => inputs.push(("noisy_radiance", &outputs.scattered)),
    }
    if knows_coat {
        inputs.extend([
            ("specular_albedo", &outputs.specular_albedo),
            ("specular_hit_distance", &outputs.hit_distance),
            ("roughness", &outputs.roughness),
        ]);
        match options.reflections {
            Reflections::AtRest => {}
            Reflections::Ids => inputs.push(("specular_hit_id", &outputs.hit_id)),
            Reflections::Motion => inputs.push(("specular_motion", &outputs.specular_motion)),
        }
    }
    if let Some(volume) = tracer.volume() {
        inputs.push(("noisy_volume", &volume.noisy_volume));
        inputs.extend(options.volume_motion.then_some(("scattering_depth", &volume.scattering_depth)));
    }
    for (number, lamp) in tracer.lamps_apart().iter().enumerate() {
        inputs.push((Input::NOISY_VISIBILITY[number].name, &lamp.noisy_visibility));
        inputs.push((Input::OCCLUDER_DISTANCE[number].name, &lamp.occluder_distance));
        inputs.push((Input::UNSHADOWED_DIRECT[number].name, &lamp.unshadowed_direct));
        inputs.extend(options.occluder_ids.then_some((Input::OCCLUDER_ID[number].name, &lamp.occluder_id)));
    }
    if let Some(ambient) = tracer.ambient() {
        inputs.extend([("noisy_ambient", &ambient.noisy_ambient), ("ambient_distance", &ambient.ambient_distance)]);
    }
    inputs
}

/// `access`: what the engine's shaders do with it.
fn host_image(image: &Image, access: vk::AccessFlags2) -> HostImage {
    HostImage {
        image: image.handle,
        view: image.view,
        subresource: atrous::Subresource::default(),
        format: image.format,
        extent: [image.extent.width, image.extent.height],
        layout: vk::ImageLayout::GENERAL,
        stage: vk::PipelineStageFlags2::COMPUTE_SHADER,
        access,
    }
}
