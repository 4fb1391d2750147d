//! The error type of the demo. Each message says what was given, what is allowed and what to do.

/// Everything that can go wrong in the demo.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The engine failed.
    #[error(transparent)]
    Engine(#[from] atrous_engine::Error),
    /// A frame could not be measured.
    #[error(transparent)]
    Measuring(#[from] atrous_measure::Error),
    /// The window failed.
    #[cfg(feature = "window")]
    #[error(transparent)]
    Window(#[from] atrous_window::Error),
    /// The program was built without its window.
    #[cfg(not(feature = "window"))]
    #[error("this program was built without its window: run scripts/demo.sh --window, or build with `cargo build --release --package atrous-demo --features window`. Without --window pictures and tables are written to a folder")]
    NoWindowBuilt,
    /// A frame for which no reference can be rendered.
    #[error("reference frame {given} does not exist: with --frames {frames} they are 0 to {}", frames - 1)]
    ReferenceFrame {
        /// As given.
        given: u32,
        /// Frames rendered.
        frames: u32,
    },
    /// `--capture` without the code for it.
    #[cfg(not(feature = "capture"))]
    #[error("--capture needs the feature `capture`: cargo run --release --package atrous-demo --features capture -- --capture")]
    NoCapture,
}

/// The result of everything that can fail here.
pub type Result<T> = std::result::Result<T, Error>;
