//! The path tracer: visibility, lighting, and the ground truth.

mod ambient;
pub mod barriers;
mod bvh;
mod camera;
mod lamps;
mod layout;
mod lights;
mod outputs;
mod reference;
mod reshading;
mod scene_buffers;
mod volume;

pub use ambient::{Ambient, AMBIENT_REACH};
pub use camera::Camera;
pub use lamps::{angular_radius, LampApart, LampsApart, LAMPS_APART};
pub use outputs::Outputs;
pub use reference::{Reference, ReferenceSums};
pub use reshading::{Reshading, SampleEye};
pub use volume::Volume;

use std::sync::Arc;

use ash::vk;
use clap::ValueEnum;
use serde::{Deserialize, Serialize};

use crate::error::Result;
use crate::gpu::{storage_images, Bound, Buffer, DescriptorSet, Gpu, Image, Pipeline, SetLayout};
use crate::scene::{Environment, Lamp, Moment, Scene, View};
use barriers::{general_barrier, memory_barrier};
use layout::FrameConstants;
use scene_buffers::SceneBuffers;

/// The shaders as they were built.
pub mod shaders {
    use crate::gpu::Shader;
    include!(concat!(env!("OUT_DIR"), "/shaders.rs"));
}

/// How area lights are found. All agree in the mean; only the noise differs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LightSampling {
    /// Both ways, weighed by the balance heuristic.
    #[default]
    Both,
    /// Shadow rays to sampled lights only.
    Lights,
    /// Directions sampled from the material only; lamps without an area are not found.
    Bsdf,
}

/// How the random numbers of neighbouring pixels are related. References are the same.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Noise {
    /// Not at all.
    #[default]
    White,
    /// They complement each other, so that the errors of a neighbourhood cancel; frames are independent.
    Blue,
}

/// What guides and signals have where glass is seen. The picture is the same.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum GlassShown {
    /// The glass itself: all light that it lets pass or reflects is specular.
    Itself,
    /// What is seen through it; its reflection is specular light, and all else diffuse.
    #[default]
    Layers,
    /// What is seen through it, without its reflection.
    Through,
    /// Its reflection, and what is seen there; all else is background, and black.
    Reflection,
}

/// What the path tracer does differently from its default.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TracerOptions {
    /// Moves the primary rays by a Halton sequence within their pixels (default: through the centres).
    pub jitter: bool,
    /// Other seeds give other noise (default 0).
    pub seed: u32,
    /// How area lights are found.
    pub light_sampling: LightSampling,
    /// The first lamps of the scene, [`LAMPS_APART`] at most, have images of their own, and what they give surfaces that the eye sees is in no
    /// other (default false).
    pub lamps_apart: bool,
    /// Ambient occlusion has images of its own (default false).
    pub ambient: bool,
    /// Light of half of the columns and rows, another pixel of 2x2 in each frame (default false).
    pub half_light: bool,
    /// What guides and signals have of glass.
    pub glass: GlassShown,
    /// How noise is distributed over the picture.
    pub noise: Noise,
}

/// A path tracer of one scene into images of one size.
pub struct PathTracer {
    gpu: Gpu,
    scene: Arc<Scene>,
    extent: vk::Extent2D,
    options: TracerOptions,
    frame: u32,
    view: View,
    /// Of the last frame that was begun, seconds.
    lamp_time: f32,
    buffers: SceneBuffers,
    outputs: Outputs,
    scene_set: DescriptorSet,
    gbuffer_set: DescriptorSet,
    lighting_set: DescriptorSet,
    gbuffer: Pipeline,
    lighting: Pipeline,
    scene_layout: SetLayout,
    volume: Option<Volume>,
    /// Whether the outputs hold the lighting of the frame whose G-buffer was drawn last.
    is_lit: bool,
    lamps: Option<LampsApart>,
    ambient: Option<Ambient>,
}

impl PathTracer {
    /// Makes everything, and prepares frame 0.
    ///
    /// # Errors
    /// An extent of zero or beyond the device's limit, a scene beyond a fixed limit, or no memory.
    pub fn new(gpu: &Gpu, scene: &Arc<Scene>, extent: vk::Extent2D, options: TracerOptions) -> Result<Self> {
        let outputs = Outputs::new(gpu, extent, light_extent(extent, options))?;
        let (gbuffer, lighting) = match scene.has_glass() {
            true => (&shaders::GBUFFER_GLASS, &shaders::PATH_TRACE_GLASS),
            false => (&shaders::GBUFFER, &shaders::PATH_TRACE),
        };
        let buffers = SceneBuffers::new(gpu, scene)?;
        let bound = buffers.bindings();
        let kinds = bound.map(Bound::kind);
        let scene_layout = SetLayout::new(gpu, &kinds)?;
        let gbuffer_layout = SetLayout::new(gpu, &storage_images(12))?;
        let lighting_layout = SetLayout::new(gpu, &storage_images(LIT_IMAGES))?;
        let mut tracer = Self {
            scene_set: DescriptorSet::of_buffers(gpu, &scene_layout, &bound)?,
            gbuffer_set: DescriptorSet::of_images(gpu, &gbuffer_layout, &outputs.gbuffer().map(|image| image.view))?,
            lighting_set: DescriptorSet::of_images(gpu, &lighting_layout, &lit_images(&outputs).map(|image| image.view))?,
            gbuffer: Pipeline::new(gpu, gbuffer, &[&scene_layout, &gbuffer_layout], 0)?,
            lighting: Pipeline::new(gpu, lighting, &[&scene_layout, &lighting_layout], 0)?,
            gpu: gpu.clone(),
            scene: scene.clone(),
            extent,
            options,
            frame: 0,
            view: scene.view(0),
            lamp_time: 0.0,
            buffers,
            lamps: if options.lamps_apart { LampsApart::new(gpu, scene, &scene_layout, &outputs)? } else { None },
            ambient: options.ambient.then(|| Ambient::new(gpu, &scene_layout, &outputs)).transpose()?,
            volume: scene.medium.map(|_| Volume::new(gpu, &scene_layout, &outputs)).transpose()?,
            is_lit: false,
            outputs,
            scene_layout,
        };
        tracer.begin_frame(0)?;
        Ok(tracer)
    }

    /// Animates the scene to a frame, whose motion is relative to the frame with the index before it (frame 0 stands
    /// still), and writes the staging buffers. All work recorded for earlier frames must be complete.
    ///
    /// # Errors
    /// A scene without a triangle.
    pub fn begin_frame(&mut self, frame: u32) -> Result<()> {
        let (now, before) = (self.scene.moment(frame), self.scene.moment(frame.saturating_sub(1)));
        self.begin_moment(frame, &now, &before)
    }

    /// The same at any time: `frame` seeds the random numbers, and motion is from `before` to `now`.
    ///
    /// # Errors
    /// As [`Self::begin_frame`].
    pub fn begin_moment(&mut self, frame: u32, now: &Moment, before: &Moment) -> Result<()> {
        self.frame = frame;
        self.view = now.view;
        self.lamp_time = now.object_time;
        let state = self.buffers.animate(&self.scene, now, before)?;
        let jitter = self.jitter(frame);
        let Environment { zenith, horizon, ground } = self.scene.environment;
        let lit = (zenith + horizon + ground).max_element() > 0.0;
        // Two parts in a hundred thousand of the scene: above float32's error at its edge, below what the eye sees.
        let epsilon = 2.0e-5 * state.diagonal;
        let constants = FrameConstants {
            camera: camera::camera_frame(&now.view, self.extent),
            previous_camera: camera::camera_frame(&before.view, self.extent),
            extent_frame_seed: [self.extent.width, self.extent.height, frame, self.options.seed],
            jitter_epsilon_weight: [jitter[0], jitter[1], epsilon, state.total_weight],
            sky_zenith: layout::with(zenith, f32::from(u8::from(lit))),
            sky_horizon: layout::with(horizon, f32::from(u8::from(self.options.noise == Noise::Blue))),
            sky_ground: layout::with(ground, 0.0),
            counts: [state.light_count, self.options.light_sampling as u32, state.first_lamp, self.lamps_apart().len() as u32],
            medium: self.scene.medium.map_or([0.0; 4], |m| [m.extinction, m.anisotropy, 0.0, 0.0]),
            medium_scattering: self.scene.medium.map_or([0.0; 4], |m| layout::with(m.scattering, 0.0)),
            light: [self.light_ratio(), self.light_ratio(), self.light_offset()[0], self.light_offset()[1]],
            glass: [self.options.glass as u32, 0, 0, 0],
        };
        self.buffers.set_constants(&constants);
        Ok(())
    }

    /// Gives its passes other code; whether one of them runs that shader.
    ///
    /// # Errors
    /// No memory, or a lost device.
    #[cfg(feature = "hot-reload")]
    pub fn replace_shader(&mut self, shader: &crate::hot_reload::Compiled) -> Result<bool> {
        let volume = self.volume.as_mut().map(|volume| &mut volume.pipeline);
        let lamps = self.lamps.as_mut().map(|lamps| &mut lamps.pipeline);
        let ambient = self.ambient.as_mut().map(|ambient| &mut ambient.pipeline);
        for pipeline in [&mut self.gbuffer, &mut self.lighting].into_iter().chain(volume).chain(lamps).chain(ambient) {
            if pipeline.replace(shader)? {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Records the copies of the frame's data and the visibility pass. Waits for all earlier commands of the queue.
    pub fn record_gbuffer(&mut self, cmd: vk::CommandBuffer) {
        let device = self.gpu.device().clone();
        let (all, copy, compute) =
            (vk::PipelineStageFlags::ALL_COMMANDS, vk::PipelineStageFlags::TRANSFER, vk::PipelineStageFlags::COMPUTE_SHADER);
        let anything = vk::AccessFlags::MEMORY_READ | vk::AccessFlags::MEMORY_WRITE;
        let written = vk::AccessFlags::TRANSFER_WRITE;
        let read = vk::AccessFlags::SHADER_READ | vk::AccessFlags::UNIFORM_READ;
        memory_barrier(&device, cmd, (all, anything), (copy, written));
        self.is_lit = false;
        self.buffers.record(&device, cmd);
        memory_barrier(&device, cmd, (copy, written), (compute, read));
        general_barrier(&device, cmd, &self.outputs.gbuffer());
        self.gbuffer.record(cmd, &[&self.scene_set, &self.gbuffer_set], &[], self.extent);
    }

    /// Records the lighting pass: one path for each pixel. Waits for all earlier commands of the queue, so whatever
    /// wrote the visibility samples and seeds last is seen. Nothing where it was recorded since the G-buffer: it would give the same.
    pub fn record_lighting(&mut self, cmd: vk::CommandBuffer) {
        if std::mem::replace(&mut self.is_lit, true) {
            return;
        }
        self.prepare_lighting(cmd);
        self.lighting.record(cmd, &[&self.scene_set, &self.lighting_set], &[], self.light_extent());
        self.record_apart(cmd);
    }

    /// What has images of its own: lamps, ambient occlusion and the volume.
    fn record_apart(&self, cmd: vk::CommandBuffer) {
        if let Some(lamps) = &self.lamps {
            general_barrier(self.gpu.device(), cmd, &lamps.images());
            lamps.record(cmd, &self.scene_set, self.extent);
        }
        if let Some(ambient) = &self.ambient {
            general_barrier(self.gpu.device(), cmd, &[&ambient.noisy_ambient, &ambient.ambient_distance]);
            let reach = AMBIENT_REACH.to_ne_bytes();
            ambient.pipeline.record(cmd, &[&self.scene_set, &ambient.set], &reach, self.light_extent());
        }
        if let Some(volume) = &self.volume {
            general_barrier(self.gpu.device(), cmd, &[&volume.noisy_volume, &volume.scattering_depth]);
            volume.pipeline.record(cmd, &[&self.scene_set, &volume.set], &[], self.light_extent());
        }
    }

    fn prepare_lighting(&self, cmd: vk::CommandBuffer) {
        let compute = vk::PipelineStageFlags::COMPUTE_SHADER;
        let written = vk::AccessFlags::MEMORY_WRITE;
        let source = (vk::PipelineStageFlags::ALL_COMMANDS, written);
        memory_barrier(self.gpu.device(), cmd, source, (compute, vk::AccessFlags::SHADER_READ));
        general_barrier(self.gpu.device(), cmd, &self.outputs.lighting());
    }

    /// The images of the frame.
    pub fn outputs(&self) -> &Outputs {
        &self.outputs
    }

    /// What the medium of the scene scatters, where there is one; written by every lighting pass.
    pub fn volume(&self) -> Option<&Volume> {
        self.volume.as_ref()
    }

    /// The lamps that [`TracerOptions::lamps_apart`] asks for; written by every lighting pass.
    pub fn lamps_apart(&self) -> &[LampApart] {
        self.lamps.as_ref().map_or(&[], |apart| &apart.lamps)
    }

    /// Where these lamps are, homogeneous: the direction towards a sun has w 0.
    pub fn lamp_places(&self) -> Vec<[f32; 4]> {
        self.scene.lamps_at(self.lamp_time).iter().take(self.lamps_apart().len()).map(Lamp::place).collect()
    }

    /// Ambient occlusion, where [`TracerOptions::ambient`] asks for it; written by every lighting pass.
    pub fn ambient(&self) -> Option<&Ambient> {
        self.ambient.as_ref()
    }

    /// Size of the images of light.
    pub fn light_extent(&self) -> vk::Extent2D {
        light_extent(self.extent, self.options)
    }

    /// The pixel of the picture that light is traced for in this frame, beyond the first of each block.
    pub fn light_offset(&self) -> [u32; 2] {
        match self.options.half_light {
            true => [[0, 0], [1, 1], [1, 0], [0, 1]][self.frame as usize % 4],
            false => [0; 2],
        }
    }

    fn light_ratio(&self) -> u32 {
        1 + u32::from(self.options.half_light)
    }

    /// For each `surface_id` three rows of the map from world space now to world space in the previous frame (entry 0:
    /// identity). Last written by a copy in [`Self::record_gbuffer`] and made visible to shader reads of compute.
    pub fn previous_from_current(&self) -> &Buffer {
        &self.buffers.previous_from_current.buffer
    }

    /// The inverses of [`Self::previous_from_current`]: they carry a point of the previous frame to where it is now.
    pub fn current_from_previous(&self) -> &Buffer {
        &self.buffers.current_from_previous.buffer
    }

    /// The camera of any frame; that of the last frame that was begun is where it was then.
    pub fn camera(&self, frame: u32) -> Camera {
        let view = if frame == self.frame { self.view } else { self.scene.view(frame) };
        Camera::new(&view, self.extent, self.jitter(frame))
    }

    /// The frame of the last [`Self::begin_frame`].
    pub fn frame(&self) -> u32 {
        self.frame
    }

    /// Size of the images in pixels.
    pub fn extent(&self) -> vk::Extent2D {
        self.extent
    }

    /// The scene.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Whether primary rays move within their pixels from frame to frame.
    pub fn jitters(&self) -> bool {
        self.options.jitter
    }

    fn jitter(&self, frame: u32) -> [f32; 2] {
        if self.options.jitter {
            camera::halton_jitter(frame)
        } else {
            [0.0; 2]
        }
    }
}

/// Half of the columns and rows, rounded down, where light has half of them.
fn light_extent(extent: vk::Extent2D, options: TracerOptions) -> vk::Extent2D {
    let ratio = 1 + u32::from(options.half_light);
    vk::Extent2D { width: extent.width / ratio, height: extent.height / ratio }
}

const LIT_IMAGES: usize = 10;

/// What the lighting pass reads and writes, in the order of its bindings.
fn lit_images(outputs: &Outputs) -> [&Image; LIT_IMAGES] {
    let [direct, indirect, scattered, diffuse, specular, hit_distance, hit_id, motion] = outputs.lighting();
    [&outputs.visibility, &outputs.seed, direct, indirect, scattered, diffuse, specular, hit_distance, hit_id, motion]
}
