//! The one error type of the demo engine. Each message says what was given, what is allowed and what to do.

use std::path::PathBuf;

use ash::vk;

/// Everything that can go wrong in the demo engine.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The Vulkan loader library could not be opened.
    #[error(
        "no Vulkan loader ({0}): install it (Debian, Ubuntu: `apt install libvulkan1 mesa-vulkan-drivers`) or run scripts/setup.sh"
    )]
    NoVulkan(#[from] ash::LoadingError),
    /// No device answers at all.
    #[error("the Vulkan loader finds no device with a compute queue: install a driver for your GPU, or Mesa's software device (Debian, Ubuntu: `apt install mesa-vulkan-drivers`)")]
    NoDevice,
    /// No device matches what was asked for.
    #[error("no device matches \"{wanted}\"; there are: {available}. Give an index or a part of a name")]
    DeviceNotFound {
        /// What the caller asked for.
        wanted: String,
        /// The devices that exist, with their indices.
        available: String,
    },
    /// The Khronos validation layer was asked for and is not installed.
    #[error("validation was asked for, but the layer VK_LAYER_KHRONOS_validation is not installed (Debian, Ubuntu: `apt install vulkan-validationlayers`)")]
    NoValidationLayer,
    /// Something that a window needs is not there.
    #[error("no Vulkan device here has the extension {name}, which a window needs: run without --window, which writes pictures to a folder")]
    NoExtension {
        /// Its name.
        name: String,
    },
    /// A Vulkan call failed.
    #[error("Vulkan failed to {doing}: {result}")]
    Vulkan {
        /// What was attempted.
        doing: &'static str,
        /// Vulkan's answer.
        result: vk::Result,
    },
    /// Device memory could not be had.
    #[error("no device memory for {what} ({bytes} bytes): {source}. Choose a smaller picture or scene")]
    Memory {
        /// The resource that needed it.
        what: String,
        /// Its size.
        bytes: u64,
        /// The allocator's answer.
        source: gpu_allocator::AllocationError,
    },
    /// The picture's size is not usable.
    #[error("a picture of {width}x{height} pixels is not possible: both sides must be from 1 to {limit}")]
    Extent {
        /// Requested width in pixels.
        width: u32,
        /// Requested height in pixels.
        height: u32,
        /// The device's largest 2D image.
        limit: u32,
    },
    /// The scene's name is none of ours, and no glTF file either.
    #[error("no scene is called \"{given}\": give one of {}, or a file that ends in .glb or .gltf", crate::scene::BUILT_IN.join(", "))]
    UnknownScene {
        /// What was given.
        given: String,
    },
    /// A scene file cannot be used.
    #[error("{}: {problem}. {remedy}", path.display())]
    SceneFile {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        problem: String,
        /// What to do about it.
        remedy: &'static str,
    },
    /// There is nothing to trace.
    #[error("the scene has no triangles: place at least one mesh")]
    EmptyScene,
    /// A scene is too complex for a fixed limit.
    #[error("the scene has {given} {what}, and the demo takes {limit} at most: simplify the scene")]
    SceneLimit {
        /// What there is too much of.
        what: &'static str,
        /// How much there is.
        given: usize,
        /// How much is allowed.
        limit: usize,
    },
    /// A folder could not be made.
    #[error("cannot write {}: {problem}. Check the folder and the space on the disk", path.display())]
    Folder {
        /// The folder.
        path: PathBuf,
        /// What the system said.
        problem: String,
    },
    /// The denoiser refused.
    #[error("the denoiser: {0}")]
    Denoiser(#[from] atrous::Error),
    /// A reference of no samples has no mean.
    #[error("a reference of 0 samples per pixel has no mean: ask for 1 or more (1024 is a good start)")]
    NoSamples,
}

/// The result of everything that can fail here.
pub type Result<T> = std::result::Result<T, Error>;

/// Names a failed Vulkan call.
pub trait Doing<T> {
    /// `doing` completes the sentence "Vulkan failed to ...".
    fn doing(self, doing: &'static str) -> Result<T>;
}

impl<T> Doing<T> for std::result::Result<T, vk::Result> {
    fn doing(self, doing: &'static str) -> Result<T> {
        self.map_err(|result| Error::Vulkan { doing, result })
    }
}
