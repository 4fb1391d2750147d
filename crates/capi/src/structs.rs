//! Structs that cross the boundary. `struct_size` stands first: if you compiled against a different header, you get an error.

use crate::{AtrousConfig, AtrousGraph, AtrousPipelines, GetInstanceProcAddr};
use ash::vk::{
    AccessFlags, AccessFlags2, Buffer, BufferMemoryBarrier, BufferUsageFlags, DependencyInfo, Device, Format, Image, ImageLayout,
    ImageMemoryBarrier, ImageUsageFlags, ImageView, Instance, MemoryBarrier, PhysicalDevice, PipelineCache, PipelineStageFlags,
    PipelineStageFlags2,
};
use std::ffi::c_char;

/// Bytes of a name, with its null.
pub const ATROUS_NAME_SIZE: usize = 64;
/// Most uses of a pass.
pub const ATROUS_MAX_USES: usize = 32;

/// A buffer for a name.
pub type AtrousName = [c_char; ATROUS_NAME_SIZE];

/// The device of the passes. Handles stay yours.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct AtrousCreateInfo {
    /// sizeof(AtrousCreateInfo).
    pub struct_size: u32,
    /// Instance of the device.
    pub instance: Instance,
    /// Physical device of the device.
    pub physical_device: PhysicalDevice,
    /// Device.
    pub device: Device,
    /// `vkGetInstanceProcAddr` of the loader that made the instance.
    pub get_instance_proc_addr: GetInstanceProcAddr,
    /// Configuration; read during the call alone. NULL if you give a graph.
    pub config: *const AtrousConfig,
    /// Your pipeline cache, or null. Used during the call alone, on several threads, so it must not
    /// be externally synchronised.
    pub pipeline_cache: PipelineCache,
    /// Of an executor: 1: barriers by vkCmdPipelineBarrier, for devices without synchronization2.
    pub legacy_barriers: u32,
    /// 1: names every object, and an executor labels every pass. VK_EXT_debug_utils is enabled on the
    /// instance.
    pub debug_labels: u32,
    /// A graph of your own instead of a configuration, or NULL; read during the call alone.
    pub graph: *const AtrousGraph,
    /// Checks of bindings and frames, see atrous_set_checks: 0, in debug builds of the library; 1, on; 2, off.
    pub checks: u32,
    /// Of an executor: 1 checks the guides of the first frames, as atrous_check_conventions does, and logs its findings once:
    /// atrous_set_log. It takes a good part of a second a frame, and ends with the first answer. The images of your guides need the
    /// usage TRANSFER_SRC.
    pub check_guides: u32,
    /// Of an executor: 1 uses every image in VK_IMAGE_LAYOUT_GENERAL, for engines with one layout: images that are there already
    /// have barriers of memory alone.
    pub stay_in_general: u32,
    /// 0.
    pub reserved: u32,
    /// Pipelines that denoisers of this device share, or NULL.
    pub pipelines: *const AtrousPipelines,
}

/// An image that you lend for one call of `atrous_executor_denoise`: an input, or an output to be written.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct AtrousLentImage {
    /// sizeof(AtrousLentImage), the same in the whole array.
    pub struct_size: u32,
    /// Format of the view.
    pub format: Format,
    /// Name of the resource, for example ATROUS_INPUT_DEPTH or "denoised_radiance".
    pub name: *const c_char,
    /// Image.
    pub image: Image,
    /// 2D view of `layer` and `level`.
    pub view: ImageView,
    /// Width of that mip level.
    pub width: u32,
    /// Height of that mip level.
    pub height: u32,
    /// Its layout as the call finds it.
    pub layout: ImageLayout,
    /// The layout that the call leaves it in. VK_IMAGE_LAYOUT_UNDEFINED: all as it was found.
    pub after_layout: ImageLayout,
    /// Your stages that used it before.
    pub stage: PipelineStageFlags2,
    /// Accesses of those stages.
    pub access: AccessFlags2,
    /// Your next stages, unless after_layout is VK_IMAGE_LAYOUT_UNDEFINED.
    pub after_stage: PipelineStageFlags2,
    /// Accesses of those stages.
    pub after_access: AccessFlags2,
    /// Array layer of the view.
    pub layer: u32,
    /// Mip level of the view.
    pub level: u32,
}

/// Parameters of a frame; `atrous_frame_params_default` fills it.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct AtrousFrameParams {
    /// sizeof(AtrousFrameParams).
    pub struct_size: u32,
    /// Frame slot, below frames_in_flight; GPU work recorded earlier with the same slot is complete.
    pub frame_slot: u32,
    /// Your reason to drop the history: 0 (none), 1 (created), 2 (camera_cut), 3 (resize), 4
    /// (scene_load), 5 (origin_shift), 6 (exposure_jump). You need not report 1.
    pub reset: u32,
    /// Width rendered this frame, anchored top left.
    pub render_width: u32,
    /// Height rendered this frame.
    pub render_height: u32,
    /// World to view, column-major.
    pub view_from_world: [f32; 16],
    /// View to Vulkan clip space, unjittered, column-major.
    pub clip_from_view: [f32; 16],
    /// Offset of the samples from the pixel centres, pixels.
    pub jitter: [f32; 2],
    /// Exposure of this frame divided by that of the previous one.
    pub exposure_ratio: f32,
    /// 1: you re-shade this frame's `gradient_samples`.
    pub reshaded: u32,
    /// The view of the pass `debug_view`; without one you leave the pass out.
    ///
    /// 0 (none), 1 (history_length), 2 (deviation), 3 (mean_and_deviation), 4 (gradient), 5 (lambda), 6 (alpha), 7 (percentiles), 8
    /// (fireflies), 9 (disocclusion), 10 (motion), 11 (normal), 12 (depth), 13 (surface_id), 14 (bad_values),
    /// 15 (hit_distance), 16 (lobe_angle), 17 (virtual_motion), 18 (reflection_history), 19 (visibility), 20 (penumbra).
    pub debug_view: u32,
    /// Number of frames whose GPU work is complete, of those that you began: for example the value of a timeline semaphore that each
    /// frame raises by 1. With atrous_set_checks, a slot whose last frame is not among them is refused. UINT64_MAX: you do not say.
    pub complete_frames: u64,
    /// Four numbers for each light whose visibility you give, its place in world space: x, y, z, 1 of a lamp, or x, y, z, 0 towards a
    /// sun. 0: not known.
    pub lights: [f32; 16],
    /// With AtrousConfig.light_extent, the rendered pixel of each cell that light was traced for: 0, or 1 along a halved axis.
    pub light_offset: [u32; 2],
    /// With AtrousConfig.image_extent, the pixel of your images at which this picture begins.
    pub viewport_origin: [u32; 2],
    /// Width and height of the picture that you show, anchored top left: at most AtrousConfig.output_extent, and 1 to 3 times what is
    /// rendered. They may differ from frame to frame. 0, 0: all of it.
    pub output_extent: [u32; 2],
    /// With AtrousConfig.material_class, four numbers for each of 16 classes: factors of tolerated differences of depth and of normals,
    /// factor of sigma_l, each 0.01 to 100, and the longest history, 1 to 1024 frames. Default: 1, 1, 1, 1024.
    pub materials: [f32; 64],
}

/// A frame that was begun. Plain data: copy it as you like.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct AtrousFrame {
    /// sizeof(AtrousFrame), set by you before `atrous_begin_frame`.
    pub struct_size: u32,
    /// The frame slot of AtrousFrameParams.
    pub frame_slot: u32,
    /// Number of the frame, from 0.
    pub index: u64,
    /// Counts resizes.
    pub generation: u64,
    /// The current copy of a resource with two copies: 0 or 1. The other one is the previous.
    pub current_copy: u32,
    /// Whether and why history is dropped this frame: as in AtrousFrameParams, and 1 for the first frame.
    pub reset: u32,
}

/// A resource that you allocate or give.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct AtrousResource {
    /// sizeof(AtrousResource), set by you.
    pub struct_size: u32,
    /// 0: image; 1: buffer.
    pub kind: u32,
    /// 0: input; 1: output; 2: transient; 3: history of two copies; 4: history in place.
    pub lifetime: u32,
    /// Number of copies that you allocate: 2 of a history, 0 of an input.
    pub copies: u32,
    /// 1: an input that you may leave out.
    pub optional: u32,
    /// 0: exactly `format`; 1: any floating-point or normalised format; 2: any unsigned integer format.
    pub format_class: u32,
    /// Format for your image.
    pub format: Format,
    /// Width of the image.
    pub width: u32,
    /// Height of the image.
    pub height: u32,
    /// Usage of the image by the passes; OR in your own.
    pub image_usage: ImageUsageFlags,
    /// Usage of the buffer by the passes; OR in your own.
    pub buffer_usage: BufferUsageFlags,
    /// Index of the first pass that uses it.
    pub first_pass: u32,
    /// Index of the last pass that uses it. Transients may share memory if these ranges do not
    /// overlap.
    pub last_pass: u32,
    /// Bytes of one copy, texels alone.
    pub bytes: u64,
    /// Stable key.
    pub name: AtrousName,
}

/// The use of a resource by a pass.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct AtrousUse {
    /// Index of the resource.
    pub resource: u32,
    /// 1: the copy of the previous frame.
    pub previous: u32,
    /// 0: sampled; 1: storage read; 2: storage write of every texel; 3: storage read and write; 4: uniform; 5: transfer write.
    pub access: u32,
    /// 1: old content matters; 0: you may discard it.
    pub reads: u32,
    /// 1: content changes.
    pub writes: u32,
    /// Layout of an image; VK_IMAGE_LAYOUT_GENERAL is always legal instead.
    pub layout: ImageLayout,
    /// Stage of synchronization2.
    pub stage: PipelineStageFlags2,
    /// Access mask of synchronization2.
    pub access_mask: AccessFlags2,
    /// Stage for vkCmdPipelineBarrier.
    pub legacy_stage: PipelineStageFlags,
    /// Access mask for vkCmdPipelineBarrier.
    pub legacy_access_mask: AccessFlags,
}

/// A pass: the smallest thing to schedule. Every barrier belongs between passes.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct AtrousPass {
    /// sizeof(AtrousPass), set by you.
    pub struct_size: u32,
    /// 0: before lighting; 1: after lighting; 2: post-process.
    pub phase: u32,
    /// Uses, and thereby bindings.
    pub use_count: u32,
    /// The first `use_count` are set.
    pub uses: [AtrousUse; ATROUS_MAX_USES],
    /// Name for labels and profiles.
    pub name: AtrousName,
}

/// The binding for a use. An image: `image`, `view` and `layout`. A buffer: `buffer`, `offset`, `range`. All null: an optional
/// input that is absent.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct AtrousBinding {
    /// The image of the view, or null: no pass needs it.
    pub image: Image,
    /// 2D view of mip 0, layer 0.
    pub view: ImageView,
    /// Layout of the image when the pass runs.
    pub layout: ImageLayout,
    /// Buffer.
    pub buffer: Buffer,
    /// Offset in bytes.
    pub offset: u64,
    /// Bytes, or VK_WHOLE_SIZE.
    pub range: u64,
}

/// The last use of an image or buffer, or its next: one side of a barrier.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct AtrousState {
    /// Stages of synchronization2.
    pub stage: PipelineStageFlags2,
    /// Accesses of those stages.
    pub access: AccessFlags2,
    /// Layout of an image; VK_IMAGE_LAYOUT_UNDEFINED for a buffer, and for content that no one needs.
    pub layout: ImageLayout,
    /// Queue family that owns it. VK_QUEUE_FAMILY_IGNORED if ownership never changes.
    pub queue_family: u32,
}

/// Barriers for one call. Their lists belong to the tracker, and are valid until the next call on it.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct AtrousBarriers {
    /// sizeof(AtrousBarriers), set by you.
    pub struct_size: u32,
    /// Elements of `memory`.
    pub memory_count: u32,
    /// Elements of `buffers`.
    pub buffer_count: u32,
    /// Elements of `images`.
    pub image_count: u32,
    /// For vkCmdPipelineBarrier2. Of a tracker with legacy_barriers: empty.
    pub dependency_info: DependencyInfo<'static>,
    /// For vkCmdPipelineBarrier, as all below. Of a tracker without legacy_barriers: empty.
    pub src_stage: PipelineStageFlags,
    /// Stages that wait.
    pub dst_stage: PipelineStageFlags,
    /// Barriers of all memory.
    pub memory: *const MemoryBarrier<'static>,
    /// Barriers of buffers.
    pub buffers: *const BufferMemoryBarrier<'static>,
    /// Barriers of images.
    pub images: *const ImageMemoryBarrier<'static>,
}

/// What a node of a graph returned; 0 is none.
pub type AtrousPort = u32;

/// The content of an AtrousArgument.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub enum AtrousArgumentKind {
    /// `port`; 0 leaves the argument out.
    Port = 0,
    /// `port`, with its content of the frame before: for a binding of your stage.
    Previous = 1,
    /// `number`; of a flag 0 or 1.
    Number = 2,
    /// `text`: the name of a choice, of a tunable, or of an image.
    Text = 3,
    /// `number`, for a specialisation constant of your stage.
    Constant = 4,
}

impl TryFrom<u32> for AtrousArgumentKind {
    type Error = ();

    fn try_from(number: u32) -> Result<Self, ()> {
        [Self::Port, Self::Previous, Self::Number, Self::Text, Self::Constant].get(number as usize).copied().ok_or(())
    }
}

/// An argument of a node: ATROUS_PORT, ATROUS_NUMBER and so on fill it.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct AtrousArgument {
    /// Name of the argument.
    pub name: *const c_char,
    /// One of AtrousArgumentKind.
    pub kind: u32,
    /// A port of the same graph.
    pub port: AtrousPort,
    /// A number.
    pub number: f64,
    /// A text.
    pub text: *const c_char,
}

/// A compute shader of yours, for atrous_graph_stage.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct AtrousStageInfo {
    /// sizeof(AtrousStageInfo).
    pub struct_size: u32,
    /// 0: before lighting; 1: after lighting; 2: post-process.
    pub phase: u32,
    /// The member `level` of the push constants; 0 if there is none.
    pub level: u32,
    /// Side of the block of pixels for which one invocation runs and one texel is made; 0 and 1: a pixel.
    pub per_block: u32,
    /// Name of the stage.
    pub name: *const c_char,
    /// SPIR-V with its names.
    pub spirv: *const u32,
    /// Words of it.
    pub word_count: u64,
}

/// Bytes of the declared resources, before you allocate any. Your device may add alignment.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct AtrousMemory {
    /// sizeof(AtrousMemory), set by you.
    pub struct_size: u32,
    /// Histories, which survive the frame.
    pub history: u64,
    /// Transients, if you alias them by lifetime.
    pub transient: u64,
    /// Transients, if you alias none.
    pub transient_unaliased: u64,
    /// Outputs.
    pub output: u64,
}

/// A transient that you place in memory of your own.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct AtrousPlacement {
    /// Index of the resource.
    pub resource: u32,
    /// 0.
    pub reserved: u32,
    /// Bytes that its image needs.
    pub size: u64,
    /// Alignment that its image needs.
    pub alignment: u64,
    /// Where it goes: set by atrous_place_transients.
    pub offset: u64,
}

/// A number of the tuning, for user interfaces.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct AtrousTuningField {
    /// sizeof(AtrousTuningField), set by you.
    pub struct_size: u32,
    /// Smallest legal value.
    pub min: f32,
    /// Largest legal value.
    pub max: f32,
    /// Default in the default preset. Other presets may differ.
    pub default_value: f32,
    /// Name for atrous_set_tuning.
    pub name: AtrousName,
}
