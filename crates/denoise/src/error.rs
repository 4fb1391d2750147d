//! One error for the whole tool. Every message names the file, says what is wrong and what to do.

use std::path::{Path, PathBuf};

/// Everything that can go wrong.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs, reason = "the message of each variant says what its fields are")]
pub enum ToolError {
    /// A file or folder cannot be read.
    #[error("{}: cannot be read: {source}", path.display())]
    Read { path: PathBuf, source: std::io::Error },
    /// A file that is no EXR, a truncated or corrupt one, or one that this tool has no use for.
    #[error("{}: not a usable EXR file: {problem}", path.display())]
    Exr { path: PathBuf, problem: String },
    /// A header that asks for more memory than any frame needs.
    #[error("{}: the header claims {claim}; the limit is {limit}. The file is corrupt, or crop the frames first", path.display())]
    TooLarge { path: PathBuf, claim: String, limit: String },
    /// A run that does not fit into memory.
    #[error("{}: {}x{} pixels need at least {needed} MiB ({parts}), and {available} MiB can be had ({limit}). {remedies}", path.display(), extent[0], extent[1])]
    Memory { path: PathBuf, extent: [u32; 2], needed: u64, parts: String, available: u64, limit: &'static str, remedies: String },
    /// A frame with another size than the first.
    #[error("{}: {}x{} pixels, but the first frame has {}x{}; all frames of a sequence must have one size", path.display(), given[0], given[1], expected[0], expected[1])]
    FrameSize { path: PathBuf, given: [u32; 2], expected: [u32; 2] },
    /// A channel with a type that its role cannot have.
    #[error("{}: channel `{channel}` holds {given}; {needed}", path.display())]
    ChannelType { path: PathBuf, channel: String, given: &'static str, needed: &'static str },
    /// A channel that the first frame has and this one has not, or one that was asked for.
    #[error("{}: no channel `{channel}`; the file has: {known}", path.display())]
    NoChannel { path: PathBuf, channel: String, known: String },
    /// A file with nothing to denoise in it.
    #[error("{}: no colour to denoise was recognised; {remedy}. The file has: {known}", path.display())]
    NoColour { path: PathBuf, known: String, remedy: String },
    /// A file in which several layers could be the picture.
    #[error("{}: several layers could be the picture; choose one with {}", path.display(), layers.join(" or "))]
    SeveralColours { path: PathBuf, layers: Vec<String> },
    /// No file fits FRAMES.
    #[error("{}: no EXR frames there{hint}", path.display())]
    NoFrames { path: PathBuf, hint: String },
    /// Files that cannot be put into one order.
    #[error("{}: {problem}", path.display())]
    Sequence { path: PathBuf, problem: String },
    /// Holes in the numbering.
    #[error("missing frame{}: {}{}; temporal filters need consecutive frames. Render them, or name a consecutive part of the sequence{}", if *count == 1 { "" } else { "s" }, names.join(", "), if *count > names.len() { format!(" and {} more", count - names.len()) } else { String::new() }, regular.map_or(String::new(), |step| format!("; where the numbers are {step} apart, give --step {step}")))]
    MissingFrames { names: Vec<String>, count: usize, regular: Option<u64> },
    /// An output that is already there.
    #[error("{}: exists already; --force overwrites it, --resume keeps finished frames and makes the missing ones", path.display())]
    Exists { path: PathBuf },
    /// A finished frame of another run.
    #[error("{}: {problem}. Resume with the options of that run, overwrite its frames with --force, or choose another folder with -o", path.display())]
    OtherOptions { path: PathBuf, problem: String },
    /// A file or folder cannot be written.
    #[error("{}: cannot be written: {source}{}", path.display(), write_hint(source))]
    Write { path: PathBuf, source: std::io::Error },
    /// A file that was to be encoded could not be.
    #[error("{}: cannot be encoded: {problem}", path.display())]
    Encode { path: PathBuf, problem: String },
    /// A JSON file with wrong content.
    #[error("{}: {problem}", path.display())]
    Json { path: PathBuf, problem: String },
    /// Options that contradict each other or the input.
    #[error("{0}")]
    Usage(String),
    /// Pictures and figures that make no page.
    #[error("the report cannot be made: {0}")]
    Page(#[from] atrous_lab::pages::PageError),
    /// There is no device, or none as asked for.
    #[error("{0}; or filter on the CPU, slowly, with --device reference")]
    NoDevice(atrous::Error),
    /// The library refused.
    #[error(transparent)]
    Denoise(#[from] atrous::Error),
    /// A thread of the pipeline ended without a message of its own.
    #[error("the {0} thread stopped unexpectedly; this is a bug, please report the sequence")]
    Thread(&'static str),
}

fn write_hint(source: &std::io::Error) -> &'static str {
    match source.kind() {
        std::io::ErrorKind::StorageFull | std::io::ErrorKind::QuotaExceeded | std::io::ErrorKind::FileTooLarge => {
            ". Free some space, then continue with --resume"
        }
        std::io::ErrorKind::PermissionDenied | std::io::ErrorKind::ReadOnlyFilesystem => ". Choose another folder with -o",
        _ => "",
    }
}

impl ToolError {
    /// The error of reading, for `map_err`.
    pub fn read(path: &Path) -> impl FnOnce(std::io::Error) -> Self + '_ {
        move |source| Self::Read { path: path.to_owned(), source }
    }

    /// The error of writing, for `map_err`.
    pub fn write(path: &Path) -> impl FnOnce(std::io::Error) -> Self + '_ {
        move |source| Self::Write { path: path.to_owned(), source }
    }

    /// The error of making a file of the result, for `map_err`.
    pub fn publish(path: &Path) -> impl FnOnce(std::io::Error) -> Self + '_ {
        move |source| match source.kind() {
            std::io::ErrorKind::AlreadyExists => Self::Exists { path: path.to_owned() },
            _ => Self::Write { path: path.to_owned(), source },
        }
    }

    /// A file that is no usable EXR.
    pub fn exr(path: &Path, problem: impl Into<String>) -> Self {
        Self::Exr { path: path.to_owned(), problem: problem.into() }
    }
}

/// Shorthand.
pub type Result<T> = std::result::Result<T, ToolError>;
