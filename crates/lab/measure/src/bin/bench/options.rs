//! The command line.

use super::chip;
use super::content::Content;
use super::subject::{Choices, Light, Subject};
use atrous::config::PostProcess;
use atrous_options::ConfigArgs;
use clap::Parser;
use std::path::PathBuf;

/// Times every pass of presets and other graphs, with their bytes, memory, start-up and recording.
///
/// docs/lab/performance.md says what the columns mean.
#[derive(Parser)]
#[command(name = "bench")]
pub struct Options {
    /// Presets or graphs, separated by commas; all presets where none is given
    #[arg(long, value_delimiter = ',', value_parser = str::parse::<Subject>)]
    pub preset: Vec<Subject>,
    /// Sizes in pixels, separated by commas; 720p to 4K where none is given, on CPU devices 320x180 and 640x360
    #[arg(long, value_delimiter = ',', value_parser = atrous_options::size)]
    pub size: Vec<[u32; 2]>,
    /// Content of the inputs: moving (a moving camera, holes, disocclusions) or wall (every pixel takes every tap)
    #[arg(long, default_value = "moving", value_parser = str::parse::<Content>)]
    pub content: Content,
    #[command(flatten)]
    pub config: ConfigArgs,
    /// The shadows of one light apart as well, or of so many lights; of several also their time in times of one
    #[arg(long, value_name = "LIGHTS", num_args = 0..=1, default_value_t = 0, default_missing_value = "1")]
    pub visibility: u32,
    /// Fog apart as well
    #[arg(long)]
    pub volume: bool,
    /// All that a game has: reflections and diffuse light, the shadows of one light, and fog, each as a signal of its own
    #[arg(long)]
    pub game: bool,
    /// Sides of the output over those of what is rendered, 1 to 3: the picture is gathered at that size (`Config::output_extent`)
    #[arg(long, value_name = "RATIO", value_parser = ratio)]
    pub output: Option<f64>,
    /// Size of the light: full, or half of the columns and of the rows (`Config::light_extent`), which takes even sizes
    #[arg(long, value_enum, default_value_t)]
    pub light: Light,
    /// Tone map and temporal anti-aliasing as well
    #[arg(long)]
    pub post_process: bool,
    /// Frames of each graph that are timed in a round
    #[arg(long, default_value_t = 6, value_parser = clap::value_parser!(u32).range(1..))]
    pub frames: u32,
    /// Rounds in which all graphs take turns, so that a slow minute of the machine hits all alike
    #[arg(long, default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..))]
    pub rounds: u32,
    /// Index or a part of the name of the device
    #[arg(long)]
    pub device: Option<String>,
    /// Timestamps on a CPU device as well, which swing with whatever else runs there
    #[arg(long)]
    pub timestamps: bool,
    /// Memory bandwidth of the device in GB/s, for the floor of each pass; by default that of its data sheet, where it is known here
    #[arg(long, value_parser = bandwidth)]
    pub bandwidth: Option<f64>,
    /// The chip whose floor is printed in the place of the device's own, such as "RTX 4080"; of "6900 XT" and "6800 XT" also by the
    /// cycles of the shaders
    #[arg(long, value_name = "NAME", value_parser = known_chip, conflicts_with = "bandwidth")]
    pub chip: Option<String>,
    /// Writes a page about this device to this file, such as you would send to us: docs/gpus.md
    #[arg(long, value_name = "FILE", conflicts_with = "isa")]
    pub report: Option<PathBuf>,
    /// Writes the figures to this file
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
    /// Draws a bar for each graph and size, with a segment for each pass, into this PNG file
    #[arg(long, value_name = "FILE", conflicts_with = "isa")]
    pub picture: Option<PathBuf>,
    /// Compares with figures that --json wrote; with --isa, with the table in a Markdown file
    #[arg(long, value_name = "FILE")]
    pub against: Option<PathBuf>,
    /// Shows how cost grows: per pixel with the size, and with the content, of which both are measured
    #[arg(long, conflicts_with = "isa")]
    pub growth: bool,
    /// Prints what the driver's compiler makes of every shader instead: registers, occupancy, instructions, cycles
    #[arg(long)]
    pub isa: bool,
    /// Prints every image with its format, life and bytes a pixel instead, which needs no device
    #[arg(long, conflicts_with = "isa")]
    pub images: bool,
    /// Writes the table of --isa, of all presets, into this Markdown file, between its markers
    #[arg(long, value_name = "FILE", requires = "isa", conflicts_with = "preset")]
    pub update: Option<PathBuf>,
}

impl Options {
    /// The graphs that are measured.
    pub fn subjects(&self) -> Vec<Subject> {
        if self.preset.is_empty() {
            Subject::presets().collect()
        } else {
            self.preset.clone()
        }
    }

    /// The settings of presets.
    pub fn choices(&self) -> Choices {
        let (visibility, volume) = (self.visibility.max(u32::from(self.game)), self.volume || self.game);
        let post_process = if self.post_process { PostProcess::ToneMapTaa } else { PostProcess::None };
        let (reflections, output, light) = (self.game, self.output, self.light);
        Choices { config: self.config.clone(), reflections, visibility, volume, output, light, post_process }
    }

    /// Sizes from small to large.
    pub fn sizes(&self, cpu_device: bool) -> Vec<[u32; 2]> {
        let mut sizes = match (self.size.as_slice(), cpu_device) {
            ([], false) => vec![[1280, 720], [1920, 1080], [2560, 1440], [3840, 2160]],
            ([], true) => vec![[320, 180], [640, 360]],
            (given, _) => given.to_vec(),
        };
        sizes.sort_by_key(|[w, h]| u64::from(*w) * u64::from(*h));
        sizes.dedup();
        sizes
    }

    /// Contents that are measured.
    pub fn contents(&self) -> Vec<Content> {
        if self.growth {
            Content::ALL.to_vec()
        } else {
            vec![self.content]
        }
    }
}

fn ratio(text: &str) -> Result<f64, String> {
    let given = text.parse().ok().filter(|ratio| (1.0..=3.0).contains(ratio));
    given.ok_or_else(|| format!("\"{text}\" is no ratio of an output: give 1 to 3, such as 1.5"))
}

fn bandwidth(text: &str) -> Result<f64, String> {
    let given = text.parse().ok().filter(|gb_per_s: &f64| gb_per_s.is_finite() && *gb_per_s > 0.0);
    given.ok_or_else(|| format!("\"{text}\" is no bandwidth: give GB/s above 0, such as 960"))
}

fn known_chip(name: &str) -> Result<String, String> {
    chip::bandwidth(name).map(|_| name.to_owned()).ok_or_else(|| {
        let known: Vec<_> = chip::names().collect();
        format!("\"{name}\" is no chip whose data sheet is known here; there are: {}. Or give its --bandwidth", known.join(", "))
    })
}
