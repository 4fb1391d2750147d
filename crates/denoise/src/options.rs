//! The options of a run, without the command line that they came by.

use crate::roles::Role;
use crate::sampling::Pattern;
use atrous::config::Preset;
use atrous_options::ConfigArgs;
use std::path::PathBuf;

/// Options of the user that the setup takes.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Channels by role.
    pub channels: Vec<(Role, String)>,
    /// View layer to read alone.
    pub view_layer: Option<String>,
    /// Another `sequence.json`.
    pub camera: Option<PathBuf>,
    /// Conventions by key.
    pub conventions: Vec<(String, String)>,
    /// Fields of the configuration, on top of those of a capture.
    pub config: ConfigArgs,
    /// The size of the results, where not that of the frames.
    pub output_size: Option<[u32; 2]>,
    /// Filter, where not that of a capture, or [`Preset::default`].
    pub preset: Option<Preset>,
    /// Pixels whose samples are kept, where not all.
    pub keep_samples: Option<Pattern>,
    /// Tunables, on top of those of the sequence.
    pub tunables: Vec<(String, f32)>,
    /// The step of the numbers of frames, where not 1.
    pub step: Option<u64>,
    /// The form of the results.
    pub made: Made,
}

/// The form of the results: what a frame is made with beside the filter.
#[derive(Clone, Copy, Debug, Default)]
pub struct Made {
    /// By the CPU engine, not by a device.
    pub reference: bool,
    /// In 32-bit floats.
    pub float: bool,
    /// The exposure of previews, where they are written.
    pub preview: Option<f32>,
    /// With debug views.
    pub views: bool,
    /// With the other layers of the input.
    pub keeps_layers: bool,
}
