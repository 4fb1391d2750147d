//! A frame: your parameters, the memory of the previous frame, and the block that every pass reads.

use super::{DebugView, Material, Setup, Tuning};
use crate::choice::choices;
use crate::config::{check_extent, check_light_extent, check_output_extent};
use crate::error::Error;
use crate::frame_constants::{Flags, FrameConstants};
use glam::{DMat4, DVec3, Mat4};

mod forward;

choices! {
    /// The reason why all history is dropped for one frame.
    #[non_exhaustive]
    pub enum ResetReason {
        /// The first frame after creation, after [`FrameState::invalidate`], or after a frame that
        /// you began and did not record. It is forced, so you need not report it.
        Created = 1 => "created",
        /// The camera jumped.
        CameraCut = 2 => "camera_cut",
        /// The images changed size. Forced after [`FrameState::resize`].
        Resize = 3 => "resize",
        /// A different scene.
        SceneLoad = 4 => "scene_load",
        /// The origin of world space moved.
        OriginShift = 5 => "origin_shift",
        /// Exposure changed by more than `exposure_ratio` can express.
        ExposureJump = 6 => "exposure_jump",
    }
}

/// Your parameters of a frame. With the feature `serde`, a file may leave out every field that has
/// a default.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct FrameParams {
    /// Below `Config::frames_in_flight`; GPU work recorded earlier with the same slot is complete. Default: 0.
    #[cfg_attr(feature = "serde", serde(default))]
    pub frame_slot: u32,
    /// Drops all history for this frame. Default: `None`.
    #[cfg_attr(feature = "serde", serde(default))]
    pub reset: Option<ResetReason>,
    /// Pixels rendered this frame, anchored top left; at most the allocated extent.
    pub render_extent: [u32; 2],
    /// World to view, column-major, column vectors.
    pub view_from_world: [[f32; 4]; 4],
    /// View to Vulkan clip space (y down, depth 0..1), unjittered, column-major.
    pub clip_from_view: [[f32; 4]; 4],
    /// Offset of this frame's samples from the pixel centres, in pixels, y down, −1 to 1. The
    /// matrices are without it. Default: 0, 0.
    #[cfg_attr(feature = "serde", serde(default))]
    pub jitter: [f32; 2],
    /// Exposure of this frame divided by that of the previous one, if your radiance is pre-exposed.
    /// It scales the history: for example 2 if the picture became twice as bright. Default: 1.
    #[cfg_attr(feature = "serde", serde(default = "unchanged"))]
    pub exposure_ratio: f32,
    /// Whether you re-shade the `gradient_samples` of this frame: your path tracer takes surface
    /// and seed of those pixels from the previous frame. Without it
    /// [`Preset::Best`](crate::config::Preset::Best) compares the noisy picture with its history to
    /// detect changes of light. Other presets with gradients behave as
    /// [`Preset::Svgf`](crate::config::Preset::Svgf), and log that once. Default: false.
    #[cfg_attr(feature = "serde", serde(default))]
    pub reshaded: bool,
    /// The view of the pass `debug_view`, with [`crate::Config::debug_view`]. `None`: you leave the
    /// pass out of this frame. Default: `None`.
    #[cfg_attr(feature = "serde", serde(default))]
    pub debug_view: Option<DebugView>,
    /// The number of frames whose GPU work is complete, of those that you began: for example the value of a timeline semaphore that
    /// each frame raises by 1. With [`crate::Checks`], a slot whose last frame is not among them is an error. Default: `None`, you do
    /// not say.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub complete_frames: Option<u64>,
    /// Places of the lights of [`crate::Config::visibility`], in world space: x, y, z, 1 of a lamp; x, y, z, 0 is the direction towards
    /// a sun. With a place the shadows of things and lights that move are followed. Default: 0, not known.
    #[cfg_attr(feature = "serde", serde(default))]
    pub lights: [[f32; 4]; 4],
    /// With [`crate::Config::light_extent`], the rendered pixel that each pixel of light was traced for: `light_offset` beyond
    /// the pixel of light times the ratio. It may differ from frame to frame. Each is 0, or 1 along a halved axis. Default: 0, 0.
    #[cfg_attr(feature = "serde", serde(default))]
    pub light_offset: [u32; 2],
    /// With [`crate::Config::image_extent`], the pixel of your images at which this picture begins: the render extent lies within
    /// them. It may differ from frame to frame. Default: 0, 0.
    #[cfg_attr(feature = "serde", serde(default))]
    pub viewport_origin: [u32; 2],
    /// Pixels of the picture that you show, anchored top left: at most [`crate::Config::output_extent`], 1 to 3 times the render
    /// extent. It may differ from frame to frame, and resets nothing. None: all of them. Default: none.
    #[cfg_attr(feature = "serde", serde(default))]
    pub output_extent: Option<[u32; 2]>,
    /// With [`crate::Config::material_class`], the numbers of each class. It may differ from frame to frame, and resets nothing.
    /// Default: those of [`Tuning`] for every class.
    #[cfg_attr(feature = "serde", serde(default))]
    // `Material::CLASSES` by its number: the compiler fails on `FrameParams { .., ..params }` in a closure otherwise (rustc 1.95).
    pub materials: [Material; 16],
}

/// The exposure ratio of a file that has none.
#[cfg(feature = "serde")]
fn unchanged() -> f32 {
    1.0
}

impl FrameParams {
    /// A frame without jitter, reset or exposure change, seen through identity matrices.
    pub fn new(render_extent: [u32; 2]) -> Self {
        let identity = Mat4::IDENTITY.to_cols_array_2d();
        Self {
            frame_slot: 0,
            reset: None,
            render_extent,
            view_from_world: identity,
            clip_from_view: identity,
            jitter: [0.0; 2],
            exposure_ratio: 1.0,
            reshaded: false,
            debug_view: None,
            complete_frames: None,
            lights: [[0.0; 4]; 4],
            light_offset: [0; 2],
            viewport_origin: [0; 2],
            output_extent: None,
            materials: [Material::default(); Material::CLASSES],
        }
    }

    pub(crate) fn validate(&self, setup: &Setup) -> Result<(), Error> {
        check_extent("FrameParams::render_extent", self.render_extent)?;
        if (0..2).any(|i| self.render_extent[i] > setup.allocated_extent[i]) {
            return Err(Error::RenderExtent { render: self.render_extent, allocated: setup.allocated_extent });
        }
        check_output_extent("FrameParams::output_extent", self.output_extent.or(setup.output_extent), self.render_extent)?;
        let (output, allocated) = (setup.output_of(self), setup.largest_output());
        if (0..2).any(|i| output[i] > allocated[i]) {
            return Err(Error::FrameOutput { output, allocated });
        }
        let ratio = setup.light_ratio();
        check_light_extent(setup.light_extent.map(|_| setup.light_of(self.render_extent)), self.render_extent)?;
        if (0..2).any(|i| self.light_offset[i] >= ratio[i]) {
            return Err(Error::LightOffset { given: self.light_offset, ratio });
        }
        let images = setup.image_extent.unwrap_or(self.render_extent);
        if (0..2).any(|i| u64::from(self.viewport_origin[i]) + u64::from(self.render_extent[i]) > u64::from(images[i])) {
            return Err(Error::ViewportOrigin { given: self.viewport_origin, render: self.render_extent, images });
        }
        if self.frame_slot >= setup.frames_in_flight {
            return Err(Error::FrameSlot { given: self.frame_slot, frames_in_flight: setup.frames_in_flight });
        }
        let invertible = |m: &[[f32; 4]; 4]| {
            let m = Mat4::from_cols_array_2d(m);
            m.is_finite() && m.inverse().is_finite()
        };
        for (name, matrix) in [("view_from_world", &self.view_from_world), ("clip_from_view", &self.clip_from_view)] {
            if !invertible(matrix) {
                return Err(Error::FrameParams { name, problem: "has no inverse; give a finite, invertible, column-major matrix" });
            }
        }
        if !self.jitter.iter().all(|j| (-1.0..=1.0).contains(j)) {
            return Err(Error::FrameParams { name: "jitter", problem: "must be -1 to 1, in pixels" });
        }
        if !(self.exposure_ratio > 0.0 && self.exposure_ratio.is_finite()) {
            return Err(Error::FrameParams {
                name: "exposure_ratio",
                problem: "must be positive and finite; 1 where exposure did not change",
            });
        }
        if !self.lights.iter().all(|[x, y, z, w]| [x, y, z].iter().all(|c| c.is_finite()) && [0.0, 1.0].contains(w)) {
            let problem = "must be finite, with w 1 for a lamp and 0 for a sun; all 0 where the place is not known";
            return Err(Error::FrameParams { name: "lights", problem });
        }
        self.materials.iter().enumerate().try_for_each(|(class, material)| material.validate(class))
    }
}

/// The state of a frame that all its passes see.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameContext {
    /// Number of the frame, from 0. Its parity selects the current copy of a history.
    pub index: u64,
    /// The frame slot: [`FrameParams::frame_slot`].
    pub slot: u32,
    /// The render extent: [`FrameParams::render_extent`].
    pub render_extent: [u32; 2],
    /// Pixels of the picture that you show: [`FrameParams::output_extent`].
    pub output_extent: [u32; 2],
    /// The reason why history is dropped in this frame, if it is.
    pub reset: Option<ResetReason>,
    /// The view: [`FrameParams::debug_view`]. Change it to record the pass `debug_view` again with
    /// a different view, in a later submission.
    pub debug_view: Option<DebugView>,
    /// The block that the first pass uploads.
    pub constants: FrameConstants,
    /// The numbers that shaders read as push constants.
    pub tuning: Tuning,
}

impl FrameContext {
    /// The copy of a history that a use refers to, of two: 0 or 1.
    pub const fn history_copy(&self, frame: super::UseFrame) -> usize {
        ((self.index & 1) as usize) ^ matches!(frame, super::UseFrame::Previous) as usize
    }
}

/// The memory from one frame to the next. It is state of the CPU alone.
#[derive(Clone, Debug)]
pub struct FrameState {
    frames: u64,
    /// The previous frame, or the reason why there is none.
    last: Result<FrameParams, ResetReason>,
}

impl Default for FrameState {
    fn default() -> Self {
        Self { frames: 0, last: Err(ResetReason::Created) }
    }
}

impl FrameState {
    /// Starts a frame.
    ///
    /// # Errors
    /// Names the unusable field of `params` or `tuning`. Nothing is changed then.
    pub fn begin(&mut self, setup: &Setup, params: &FrameParams, tuning: &Tuning) -> Result<FrameContext, Error> {
        params.validate(setup)?;
        tuning.validate()?;
        let reset = params.reset.or(self.last.err());
        let before = if reset.is_some() { *params } else { self.last.unwrap_or(*params) };
        let index = self.frames;
        let constants = constants(setup, params, &before, index, reset.is_some());
        self.last = Ok(*params);
        self.frames = index.wrapping_add(1);
        // A lower percentile above the upper one would turn the range round.
        let tuning = Tuning { percentile_low: tuning.percentile_low.min(tuning.percentile_up), ..*tuning };
        let FrameParams { frame_slot: slot, render_extent, debug_view, .. } = *params;
        let output_extent = constants.output_extent;
        Ok(FrameContext { index, slot, render_extent, output_extent, reset, debug_view, constants, tuning })
    }

    /// Makes the next frame drop all history. Call it after you re-created or lost images.
    pub fn invalidate(&mut self) {
        self.last = Err(ResetReason::Created);
    }

    /// Makes the next frame count as `index` and drop all history: for a replay that starts in the
    /// middle of a sequence. The choice of re-shaded pixels depends on this number.
    pub fn restart_at(&mut self, index: u64) {
        *self = Self { frames: index, ..Self::default() };
    }

    /// Starts over for images of a different extent: frames count from 0, and the first one drops
    /// all history.
    pub fn resize(&mut self) {
        *self = Self { frames: 0, last: Err(ResetReason::Resize) };
    }
}

/// Beyond it squares of lengths leave the range of a float.
const FARTHEST_DEPTH: f32 = 1e15;

fn constants(setup: &Setup, now: &FrameParams, before: &FrameParams, index: u64, reset: bool) -> FrameConstants {
    let eye = eye_of(now);
    let world_from_view = double(&now.view_from_world).inverse();
    let previous_view = double(&before.view_from_world) * DMat4::from_translation(eye);
    let columns = |m: DMat4| m.to_cols_array_2d().map(|column| column.map(|x| x as f32));
    let (light, light_before) = (of_light(setup, now), of_light(setup, before));
    let forward = forward::ForwardProjection::new(&setup.conventions, &light, &light_before, eye);
    FrameConstants {
        clip_from_view: now.clip_from_view,
        world_from_view: columns(DMat4::from_translation(-eye) * world_from_view),
        previous_clip_from_world: columns(double(&before.clip_from_view) * previous_view),
        previous_view_from_world: columns(previous_view),
        world_from_previous_sample: forward.world_from_previous_sample,
        sample_from_world: forward.sample_from_world,
        render_extent: light.render_extent,
        previous_render_extent: light_before.render_extent,
        jitter: light.jitter,
        previous_jitter: light_before.jitter,
        frame_index: index as u32,
        flags: Flags::of(&setup.conventions, reset) | if now.reshaded { Flags::RESHADED } else { 0 },
        exposure_ratio: now.exposure_ratio,
        background_depth: setup.conventions.background_depth.min(FARTHEST_DEPTH),
        previous_clip_w_scale: forward.previous_clip_w[0],
        previous_clip_w_offset: forward.previous_clip_w[1],
        // The stage `filter_exposure` chooses another, where a graph has it.
        filter_exposure: 1.0,
        inverse_filter_exposure: 1.0,
        eye: eye.extend(0.0).as_vec4().into(),
        lights: now.lights.map(|light| from_eye(light, eye)),
        // A light that was not known stood still.
        previous_lights: std::array::from_fn(|i| {
            from_eye(if before.lights[i] == UNKNOWN { now.lights[i] } else { before.lights[i] }, eye)
        }),
        materials: now.materials.map(Into::into),
        output_extent: setup.output_of(now),
        previous_output_extent: setup.output_of(before),
        guide_extent: now.render_extent,
        previous_guide_extent: before.render_extent,
        guide_jitter: now.jitter,
        previous_guide_jitter: before.jitter,
        light_ratio: setup.light_ratio(),
        light_offset: now.light_offset,
        viewport_origin: now.viewport_origin,
        motion_scale: setup.conventions.motion_scale,
    }
}

/// A frame as its light sees it: with the pixels of the light, whose samples lie beside their centres by the offset, too.
fn of_light(setup: &Setup, params: &FrameParams) -> FrameParams {
    let ratio = setup.light_ratio();
    let jitter = [0, 1].map(|i| match ratio[i] {
        1 => params.jitter[i],
        side => (params.light_offset[i] as f32 + 0.5 + params.jitter[i]) / side as f32 - 0.5,
    });
    FrameParams { render_extent: setup.light_of(params.render_extent), jitter, ..*params }
}

/// The place of a light that is not known.
const UNKNOWN: [f32; 4] = [0.0; 4];

/// A homogeneous place as it is seen from an eye.
fn from_eye([x, y, z, w]: [f32; 4], eye: DVec3) -> [f32; 4] {
    let [x, y, z, w] = [x, y, z, w].map(f64::from);
    (DVec3::new(x, y, z) - w * eye).extend(w).as_vec4().into()
}

/// Where a view looks from: the origin of the world that shaders see.
fn eye_of(params: &FrameParams) -> DVec3 {
    double(&params.view_from_world).inverse().w_axis.truncate()
}

fn double(m: &[[f32; 4]; 4]) -> DMat4 {
    DMat4::from_cols_array_2d(&m.map(|column| column.map(f64::from)))
}
