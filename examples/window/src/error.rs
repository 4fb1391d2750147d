//! The error type of the window. Each message says what was given, what is allowed and what to do.

use std::path::PathBuf;

/// Everything that can go wrong in the window.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The engine failed.
    #[error(transparent)]
    Engine(#[from] atrous_engine::Error),
    /// Two pictures could not be compared.
    #[error("comparing pictures: {0}")]
    Quality(#[from] atrous_lab::scores::QualityError),
    /// A picture could not be composed or written.
    #[error(transparent)]
    Composition(#[from] atrous_lab::pictures::PictureError),
    /// The error of a picture could not be drawn.
    #[error(transparent)]
    Page(#[from] atrous_lab::pages::PageError),
    /// There is nothing to open a window on.
    #[error("no window can be opened: {problem}. Start it from a desktop session (DISPLAY or WAYLAND_DISPLAY set), or leave --window out: then pictures and tables are written to a folder")]
    NoDisplay {
        /// What the window system said.
        problem: String,
    },
    /// The window cannot be drawn.
    #[error("the window: {problem}")]
    Window {
        /// Why.
        problem: String,
    },
    /// A file of settings, or of a camera path, cannot be used.
    #[error("{}: {problem}. Correct the file, or delete it to start anew", path.display())]
    SettingsFile {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        problem: String,
    },
    /// The panel could not be drawn.
    #[error("drawing the panel: {0}")]
    Panel(#[from] egui_ash_renderer::RendererError),
}

/// The result of everything that can fail here.
pub type Result<T> = std::result::Result<T, Error>;

impl From<atrous::Error> for Error {
    fn from(error: atrous::Error) -> Self {
        Self::Engine(error.into())
    }
}
