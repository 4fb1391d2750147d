//! The error type of what measures. Each message says what was given, what is allowed and what to do.

use std::path::PathBuf;

/// Everything that can go wrong while frames are measured.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The engine that renders the frames failed.
    #[error(transparent)]
    Engine(#[from] atrous_engine::Error),
    /// Two pictures could not be compared.
    #[error("comparing pictures: {0}")]
    Quality(#[from] atrous_lab::scores::QualityError),
    /// A picture could not be composed or written.
    #[error("{0}")]
    Composition(#[from] atrous_lab::pictures::PictureError),
    /// A page could not be composed or written.
    #[error("{0}")]
    Page(#[from] atrous_lab::pages::PageError),
    /// More frames to measure than there are.
    #[error("{given} frames at the end of an animation of {frames} cannot be measured: give --measured {frames} or less, or more --frames")]
    MeasuredFrames {
        /// As given.
        given: u32,
        /// Frames rendered.
        frames: u32,
    },
    /// A Markdown file whose tables cannot be renewed.
    #[error("{}: {problem}. Give a file with both lines to --markdown", path.display())]
    Markdown {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        problem: String,
    },
    /// Figures that are worse than what is claimed.
    #[error("{failed} of {claims} claims do not hold, as listed above; everything was written")]
    Claims {
        /// Those that fail.
        failed: usize,
        /// All.
        claims: usize,
    },
}

/// The result of everything that can fail here.
pub type Result<T> = std::result::Result<T, Error>;

impl From<atrous::Error> for Error {
    fn from(error: atrous::Error) -> Self {
        Self::Engine(error.into())
    }
}
