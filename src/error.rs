//! One error for the whole crate.

use ash::vk;

/// Every error. A message names the given value, the allowed ones and the remedy.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// An extent is zero or too large.
    #[error("{what} is {given:?} pixels; each side must be 1 to {max}. Give the extent of the image that is filtered")]
    Extent {
        /// The field with the extent.
        what: &'static str,
        /// Width and height as given.
        given: [u32; 2],
        /// Largest legal side.
        max: u32,
    },
    /// The render extent does not fit into the allocated one.
    #[error("render_extent {render:?} is larger than allocated_extent {allocated:?}; resize the denoiser, or render less")]
    RenderExtent {
        /// Render extent as given.
        render: [u32; 2],
        /// Extent that images were allocated with.
        allocated: [u32; 2],
    },
    /// The light has neither the size of the rendered picture nor half of it.
    #[error("light of {light:?} pixels for {rendered:?} rendered pixels; each side must be equal to theirs, or exactly half of it. Change Config::light_extent, or render an even number of pixels")]
    LightExtent {
        /// Pixels of light: as given, or of the frame.
        light: [u32; 2],
        /// Allocated extent, or render extent of a frame.
        rendered: [u32; 2],
    },
    /// Images that are smaller than the picture.
    #[error("Config::image_extent is {images:?}, and Config::allocated_extent {allocated:?}; your images hold the whole picture, so make them at least as large")]
    ImageExtent {
        /// The size of the images.
        images: [u32; 2],
        /// The allocated extent.
        allocated: [u32; 2],
    },
    /// A part of larger images that has two sizes.
    #[error("Config::image_extent is {images:?}, and Config::{other} makes pictures of two sizes. Leave one of both out")]
    PartAndSize {
        /// The other field.
        other: &'static str,
        /// The size of the images.
        images: [u32; 2],
    },
    /// A picture that does not lie within its images.
    #[error("FrameParams::viewport_origin is {given:?} and the render extent {render:?}, and the images have {images:?} pixels; give the first pixel of a part within them, and their size as Config::image_extent")]
    ViewportOrigin {
        /// The origin.
        given: [u32; 2],
        /// The render extent.
        render: [u32; 2],
        /// The size of the images.
        images: [u32; 2],
    },
    /// The pixel that light was traced for lies beyond its cell.
    #[error("FrameParams::light_offset is {given:?}, and each pixel of light stands for {ratio:?} rendered ones; each must be below that")]
    LightOffset {
        /// Offset as given.
        given: [u32; 2],
        /// Rendered pixels for each of the light.
        ratio: [u32; 2],
    },
    /// The output is smaller than the rendered picture, or more than three times as wide or high.
    #[error("{what} is {output:?} for {rendered:?} rendered pixels; each side must be 1 to 3 times theirs. Render more or fewer pixels, or leave it out")]
    OutputExtent {
        /// The field with the extent.
        what: &'static str,
        /// Output extent as given.
        output: [u32; 2],
        /// Allocated extent, or render extent of a frame.
        rendered: [u32; 2],
    },
    /// The output of a frame does not fit into the allocated one.
    #[error("FrameParams::output_extent is {output:?}, larger than the {allocated:?} pixels of Config::output_extent; allocate more, or show less")]
    FrameOutput {
        /// Output extent of the frame.
        output: [u32; 2],
        /// Allocated pixels of the output.
        allocated: [u32; 2],
    },
    /// A number of a class of materials is out of range.
    #[error("FrameParams::materials[{class}].{name} is {given}; allowed is {min} to {max}. Leave a class that you do not use at Material::default()")]
    Material {
        /// The class.
        class: usize,
        /// Field of [`crate::Material`].
        name: &'static str,
        /// Value as given.
        given: f32,
        /// Smallest legal value.
        min: f32,
        /// Largest legal value.
        max: f32,
    },
    /// A structural setting is out of range.
    #[error("Config::{name} is {given}; allowed is {min} to {max}")]
    Config {
        /// Field of [`crate::Config`].
        name: &'static str,
        /// Value as given.
        given: u32,
        /// Smallest legal value.
        min: u32,
        /// Largest legal value.
        max: u32,
    },
    /// A number of [`crate::config::Conventions`] is unusable.
    #[error("Conventions::{name} is {given}; give {allowed}")]
    Conventions {
        /// Field of [`crate::config::Conventions`].
        name: &'static str,
        /// Value as given.
        given: f32,
        /// Allowed values.
        allowed: &'static str,
    },
    /// A choice has no value of this name or number.
    #[error("`{given}` is no {kind}; there are: {allowed}")]
    Choice {
        /// Type of the choice, as `Preset`.
        kind: &'static str,
        /// Name or number as given.
        given: String,
        /// Names, or numbers with their names, that exist.
        allowed: String,
    },
    /// A tunable is out of range.
    #[error("Tuning::{name} is {value}; allowed is {min} to {max}, the default is {default}")]
    Tuning {
        /// Field of [`crate::Tuning`].
        name: &'static str,
        /// Value as given.
        value: f32,
        /// Smallest legal value.
        min: f32,
        /// Largest legal value.
        max: f32,
        /// Default.
        default: f32,
    },
    /// No tunable has this name.
    #[error("no tunable is called `{0}`; Tuning::FIELDS lists them")]
    UnknownTuning(String),
    /// The frame slot does not exist.
    #[error("frame_slot is {given}, but Config::frames_in_flight is {frames_in_flight}; use frame_index modulo frames_in_flight")]
    FrameSlot {
        /// Slot as given.
        given: u32,
        /// Slots that exist.
        frames_in_flight: u32,
    },
    /// A matrix, jitter or ratio of [`crate::FrameParams`] is unusable.
    #[error("FrameParams::{name} {problem}")]
    FrameParams {
        /// Field.
        name: &'static str,
        /// The mistake, and the expected value.
        problem: &'static str,
    },
    /// The device cannot run the passes.
    #[error("this device cannot run the denoiser: {}", missing.join("; "))]
    Unsupported {
        /// Each missing version, feature, limit or format.
        missing: Vec<String>,
    },
    /// A handle that is null.
    #[error("`{0}` is null; give the host's own, which is live")]
    NullHandle(&'static str),
    /// No Vulkan loader or device.
    #[error("no Vulkan device: {0}. Install a driver, e.g. Debian's mesa-vulkan-drivers (software), or check VK_DRIVER_FILES")]
    NoDevice(String),
    /// A resource has no image or buffer bound to it.
    #[error("resource `{0}` has nothing bound to it; bind it, since only optional inputs may be left out")]
    NotBound(String),
    /// A resource is of a different kind, or is none that you bind.
    #[error("resource `{resource}` is not {needed}; Declaration::resources tells the shape and the lifetime of each")]
    WrongKind {
        /// The resource.
        resource: String,
        /// What the call takes.
        needed: &'static str,
    },
    /// A result was asked for before the first frame.
    #[error("`{0}` has no content before the first frame; run one first")]
    NoFrame(String),
    /// A transient that was asked for after the CPU engine freed it.
    #[error("resource `{0}` is a transient, and its memory is free after its last pass; make the engine with Engine::keep_transients to read it later")]
    NotKept(String),
    /// A binding that is not what the pass declares: see [`crate::Checks`].
    #[error("pass `{pass}`, resource `{resource}`: {problem}")]
    Binding {
        /// Name of the pass.
        pass: String,
        /// Name of the resource.
        resource: String,
        /// The given value, the allowed ones, and the remedy.
        problem: String,
    },
    /// Passes of a frame that were left out: see [`crate::Checks`].
    #[error("frame {frame} was recorded without {}; record every pass of a frame, or call `invalidate` if you gave the frame up", passes.join(", "))]
    LeftOut {
        /// Number of the frame.
        frame: u64,
        /// Names of the passes.
        passes: Vec<String>,
    },
    /// A frame slot that the GPU still works on: see [`crate::FrameParams::complete_frames`].
    #[error("frame slot {slot} has frame {frame}, and {complete} frames are complete, from 0; wait for that frame, or raise frames_in_flight")]
    InFlight {
        /// The slot.
        slot: u32,
        /// Number of the frame that was recorded last with it.
        frame: u64,
        /// Frames that are complete, as given.
        complete: u64,
    },
    /// A pass was given a wrong number of bindings.
    #[error("pass `{pass}` was given {given} bindings, it needs {needed}: one for each of its uses, in their order")]
    Bindings {
        /// Name of the pass.
        pass: String,
        /// Bindings as given.
        given: usize,
        /// Bindings as needed.
        needed: usize,
    },
    /// A graph that makes no sense.
    #[error("node `{node}`, port `{port}`: {problem}")]
    Graph {
        /// Name of the node.
        node: String,
        /// Port of the node: a binding of its shader, a parameter, or a resource.
        port: String,
        /// The given value, the allowed ones, and the remedy.
        problem: String,
    },
    /// A shader of yours that cannot be a stage.
    #[error("stage `{stage}`: {problem}")]
    Stage {
        /// Name of the stage.
        stage: String,
        /// The given value, the allowed ones, and the remedy.
        problem: String,
    },
    /// No resource has this name.
    #[error("no resource is called `{given}`; this denoiser has: {known}")]
    UnknownResource {
        /// Name as given.
        given: String,
        /// Names that exist.
        known: String,
    },
    /// A CPU twin without an input that its stage needs.
    #[error("the CPU twin of stage `{stage}` needs {needed} as `{binding}`, but was given {given}; bind it under the name that the shader has")]
    Twin {
        /// Stage.
        stage: String,
        /// Name of the binding or of the specialisation constant.
        binding: String,
        /// Kind of image or value that the stage needs.
        needed: &'static str,
        /// Kind of image or value that it was given.
        given: String,
    },
    /// An image with a wrong format.
    #[error("resource `{resource}` was given an image of format {given:?}; it takes {allowed}")]
    Format {
        /// Resource.
        resource: String,
        /// Format as given.
        given: vk::Format,
        /// Formats that the resource takes.
        allowed: String,
    },
    /// An image or a slice of texels with a wrong size.
    #[error("resource `{resource}` was given {given}; it needs {needed}")]
    Size {
        /// Resource.
        resource: String,
        /// Size that was given.
        given: String,
        /// Size that is needed.
        needed: String,
    },
    /// Memory ran out.
    #[error("out of memory while allocating {bytes} bytes for {what}; lower the allocated extent or free memory on the device")]
    OutOfMemory {
        /// Purpose of the memory.
        what: String,
        /// Size of the memory, bytes.
        bytes: u64,
    },
    /// A capture cannot be started, or ended early.
    #[error("capture: {}: {problem}", path.display())]
    Capture {
        /// File or folder.
        path: std::path::PathBuf,
        /// The mistake and the remedy.
        problem: String,
    },
    /// A shader that cannot take the place of the one that the program was built with.
    #[error("shader `{shader}`: {difference}. The program was built for the other one: build it again")]
    ShaderInterface {
        /// Name of the shader.
        shader: String,
        /// The difference between the given interface and the built one.
        difference: String,
    },
    /// A Vulkan call failed.
    #[error("{call} failed with {result}{}", remedy(*result))]
    Vulkan {
        /// Vulkan function.
        call: &'static str,
        /// Result of the call.
        result: vk::Result,
    },
}

/// What to do about a result, as the end of a sentence.
fn remedy(result: vk::Result) -> &'static str {
    match result {
        vk::Result::ERROR_DEVICE_LOST => {
            ": the device is lost. Make another device and executor, and go on with `restart_at` and the frame that was not finished"
        }
        _ => "",
    }
}

impl Error {
    /// The error of a Vulkan call, for `map_err`.
    pub(crate) fn vulkan(call: &'static str) -> impl FnOnce(vk::Result) -> Self {
        move |result| Self::Vulkan { call, result }
    }
}
