//! Options.

use crate::conventions::keys;
use crate::roles::Role;
use crate::sampling::Pattern;
use crate::setup::{Made, Options};
use atrous::config::Preset;
use atrous_options::{size, tunable, ConfigArgs};
use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::Parser;
use std::path::{Path, PathBuf};

/// Denoise a sequence of EXR frames with the filters of atrous, and score the result.
///
/// Reads multi-channel EXR from Blender, Mitsuba, PBRT and others; finds colour, albedo, normal, depth, motion and ids by their
/// channel names; says what it found and what is lost without the rest. See docs/denoise.md.
#[derive(Parser, Clone, Debug)]
#[command(name = "atrous-denoise", version, max_term_width = 110)]
pub struct Cli {
    /// A folder, a pattern in quotes ("shot_*.exr", "shot_%04d.exr", "shot_####.exr"), or files
    #[arg(required = true, value_name = "FRAMES")]
    pub frames: Vec<PathBuf>,

    /// Folder for the result; frames keep their names
    #[arg(short, long, value_name = "FOLDER", required_unless_present = "check")]
    pub output: Option<PathBuf>,

    /// Test only whether depth, motion, normals and matrices agree with the conventions, and name the likely mistake; needs
    /// matrices
    #[arg(long)]
    pub check: bool,

    /// Filter; best, or that of a capture, where none is given
    ///
    /// best and asvgf react to changed light by layers with the samples of the previous frame re-shaded in the scene of this frame
    /// (reshade_direct, reshade_indirect); where there are none, and with percentile and fast, by the noisy image alone. eaw filters
    /// every frame by itself. stabilize accumulates what another denoiser made of the frames (other_denoised), by the changes that asvgf
    /// would see.
    #[arg(long, value_parser = preset())]
    pub preset: Option<Preset>,

    /// Score against the reference channels: table, scores.json and scores.png
    #[arg(long)]
    pub score: bool,

    /// Write tone-mapped previews
    #[arg(long)]
    pub png: bool,

    /// Write strip.png: noisy, denoised, reference and error of a frame, the last one unless given
    #[arg(long, value_name = "FRAME", num_args = 0..=1)]
    pub strip: Option<Option<u64>>,

    /// Write report.html: noisy, denoised, reference and errors of a frame to compare, the last one unless given, and every metric over
    /// the frames that have a reference
    #[arg(long, value_name = "FRAME", num_args = 0..=1)]
    pub report: Option<Option<u64>>,

    /// Write what the filter knows of every pixel into FOLDER/views: history length, variance, alpha, disocclusion reasons, ...
    #[arg(long)]
    pub views: bool,

    /// Exposure of pictures
    #[arg(long, default_value_t = 1.0, value_name = "FACTOR")]
    pub exposure: f32,

    /// Write 32-bit floats instead of half
    #[arg(long)]
    pub float: bool,

    /// Size of the result, such as 640x360: 1 to 3 times that of the frames, which are jittered; needs `jitter` in sequence.json
    #[arg(long, value_name = "SIZE", value_parser = size, conflicts_with_all = ["score", "strip", "report", "keep_layers"])]
    pub output_size: Option<[u32; 2]>,

    /// Folder with the guides of FRAMES, whose light has half as many columns or rows, or both; names of results are those of guides.
    /// `offset` in the sequence.json of FRAMES names the pixel of each cell that was traced, such as [1, 0]
    #[arg(long, value_name = "FOLDER")]
    pub guides: Option<PathBuf>,

    /// Keep the other layers and parts of the input in the result, such as cryptomattes
    #[arg(long)]
    pub keep_layers: bool,

    /// Overwrite existing frames, pictures and scores
    #[arg(long, conflicts_with = "resume")]
    pub force: bool,

    /// Keep finished frames and make the missing ones, with the same options
    #[arg(long)]
    pub resume: bool,

    /// With --resume: finished frames before the first missing one that are filtered again to rebuild the history; default: until what
    /// was before weighs less than 0.1 %, which is 66 frames for `best` and 31 for svgf
    #[arg(long, value_name = "FRAMES")]
    pub warm_up: Option<usize>,

    /// Vulkan device by index or part of its name, or `reference` for the CPU twin
    #[arg(long, value_name = "DEVICE")]
    pub device: Option<String>,

    /// Fields of the configuration: those that choose the filter, and the signals.
    #[command(flatten)]
    pub config: ConfigArgs,

    /// Keep the samples of a share of the pixels alone, as if the renderer had traced no more: to see what that costs
    #[arg(long, value_name = "PATTERN")]
    pub keep_samples: Option<Pattern>,

    /// Set a tunable, for example sigma_l=2; a wrong name lists them all
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = tunable)]
    pub tunables: Vec<(String, f32)>,

    /// Name the channels of a role: a layer, channels separated by commas, or `none`. Roles: noisy, direct, indirect, emission,
    /// albedo, normal, depth, position, motion, previous_depth, id, roughness, reference, alpha, ...
    #[arg(long = "channel", value_name = "ROLE=NAME", value_parser = channel)]
    pub channels: Vec<(Role, String)>,

    /// Take only layers of this view layer
    #[arg(long, value_name = "NAME")]
    pub view_layer: Option<String>,

    /// Matrices, where not in sequence.json beside the frames
    #[arg(long, value_name = "FILE")]
    pub camera: Option<PathBuf>,

    /// Encoding of a guide, where it differs from what the layout usually means
    #[arg(long = "convention", value_name = "KEY=VALUE", value_parser = key_value, long_help = format!("Encoding of a guide, where it differs from what the layout usually means: {}", keys()))]
    pub conventions: Vec<(String, String)>,

    /// How far the numbers of two frames are apart; default: 1
    #[arg(long, value_name = "N")]
    pub step: Option<u64>,

    /// Print nothing but errors, warnings and scores
    #[arg(short, long)]
    pub quiet: bool,
}

/// A volume alone comes from captures, which name the preset themselves.
fn preset() -> impl TypedValueParser<Value = Preset> {
    let presets = Preset::ALL.into_iter().filter(|preset| *preset != Preset::Volume);
    PossibleValuesParser::new(presets.map(Preset::name)).try_map(|name| name.parse::<Preset>())
}

fn key_value(text: &str) -> Result<(String, String), String> {
    let (key, value) = text.split_once('=').ok_or("expected KEY=VALUE")?;
    Ok((key.trim().to_owned(), value.trim().to_owned()))
}

fn channel(text: &str) -> Result<(Role, String), String> {
    let (role, name) = key_value(text)?;
    let known = || Role::all().map(Role::name).collect::<Vec<_>>().join(", ");
    Role::by_name(&role).map(|role| (role, name)).ok_or_else(|| format!("no role `{role}`; there are: {}", known()))
}

impl Cli {
    /// Folder for the result. The parser sees to it that there is one where it is used.
    pub fn output(&self) -> &Path {
        self.output.as_deref().unwrap_or(Path::new("."))
    }

    /// Whether the CPU engine filters.
    pub fn is_reference(&self) -> bool {
        self.device.as_deref() == Some("reference")
    }

    /// The options for the setup.
    pub fn options(&self) -> Options {
        Options {
            channels: self.channels.clone(),
            view_layer: self.view_layer.clone(),
            camera: self.camera.clone(),
            conventions: self.conventions.clone(),
            config: self.config.clone(),
            output_size: self.output_size,
            preset: self.preset,
            keep_samples: self.keep_samples,
            tunables: self.tunables.clone(),
            step: self.step,
            made: Made {
                reference: self.is_reference(),
                float: self.float,
                preview: self.png.then_some(self.exposure),
                views: self.views,
                keeps_layers: self.keep_layers,
            },
        }
    }
}
