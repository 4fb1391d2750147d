//! What is evaluated, and how.

use std::collections::hash_map::DefaultHasher;
use std::hash::{Hash, Hasher};
use std::path::PathBuf;

use crate::{Error, Result};
use atrous_engine::scene::BUILT_IN;
use atrous_engine::Noise;
use clap::builder::PossibleValuesParser;
use clap::Args;
use serde::{Deserialize, Serialize};

use super::contenders::{self, Contender};
use super::experiments::{self, Experiment};

/// Scenes of `--quick`: light of a lamp that steps, shadows that wander, mirrors and a moving camera, light that steps in a part of the picture.
const QUICK: [&str; 4] = ["cornell", "pillars", "glossy", "lamps"];

/// Measures every filter on every scene against references, and writes a page with pictures and curves, a table, and what the papers claim.
///
/// References are kept in OUT/references, and the results of a scene in OUT/SCENE: a run that was stopped goes on where it was.
#[derive(Args)]
pub struct EvaluateOptions {
    /// Scenes: built in, or a glTF 2.0 file; may be given several times. Default: all that are built in, with --quick cornell, pillars, glossy, lamps
    #[arg(long = "scene")]
    scenes: Vec<String>,
    /// Filters by their names in the tables; may be given several times. Default: all
    #[arg(long = "filter", value_parser = PossibleValuesParser::new(contenders::all().iter().chain(&contenders::of_sun()).map(|c| c.name)))]
    filters: Vec<String>,
    /// Experiments beside the scenes, by name; may be given several times. Default: all, or none where scenes or filters are given
    #[arg(long = "experiment", value_parser = PossibleValuesParser::new(experiments::ALL.map(|e| e.name)))]
    experiments: Vec<String>,
    /// Small pictures, few frames, four scenes, minutes; claims that do not hold are an error
    #[arg(long)]
    pub quick: bool,
    /// Width and height in pixels; default: 320x180, with --quick 128x72
    #[arg(long, value_parser = atrous_options::size)]
    size: Option<[u32; 2]>,
    /// Frames of the animation; default: 40, with --quick 16
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..))]
    frames: Option<u32>,
    /// Frames at the end of the animation that are measured; default: 8, with --quick 4
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..))]
    measured: Option<u32>,
    /// Paths per pixel of a reference, in two halves with independent noise; default: 128, with --quick 32
    #[arg(long, value_parser = clap::value_parser!(u32).range(2..))]
    reference_spp: Option<u32>,
    /// Folder for references, results, and the page
    #[arg(long, default_value = "out/evaluate")]
    pub out: PathBuf,
    /// Markdown file whose part between the lines `<!-- evaluate -->` and `<!-- /evaluate -->` is renewed, with a picture in its folder `images`
    #[arg(long)]
    pub markdown: Option<PathBuf>,
    /// Index or a part of the name of the device
    #[arg(long)]
    pub device: Option<String>,
    /// Run under the Khronos validation layer; its messages are errors
    #[arg(long)]
    pub validate: bool,
    /// Another seed gives other noise
    #[arg(long, default_value_t = 0)]
    seed: u32,
    /// Noise of the path tracer: white, independent from pixel to pixel, or blue, whose errors cancel in a neighbourhood
    #[arg(long, value_enum, default_value_t)]
    noise: Noise,
}

/// What the results of a scene depend on.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Settings {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Frames of the animation.
    pub frames: u32,
    /// Frames at its end that are measured.
    pub measured: u32,
    /// Paths per pixel of a reference.
    pub reference_spp: u32,
    /// Names of the filters in the order of tables.
    pub filters: Vec<String>,
    /// Seed of the noise.
    pub seed: u32,
    /// How noise is distributed over the picture.
    pub noise: Noise,
    /// Name of the device.
    pub device: String,
    /// Hash of this program.
    pub program: u64,
}

impl EvaluateOptions {
    /// The scenes in the order of tables.
    pub fn scenes(&self) -> Vec<String> {
        let names: &[&str] = if self.quick { &QUICK } else { &BUILT_IN };
        match self.scenes.is_empty() {
            // An experiment alone.
            true if !self.experiments.is_empty() => Vec::new(),
            true => names.iter().map(|name| name.to_string()).collect(),
            false => self.scenes.clone(),
        }
    }

    /// The experiments in the order of the report.
    pub fn experiments(&self) -> Vec<Experiment> {
        let is_whole = self.experiments.is_empty() && self.scenes.is_empty() && self.filters.is_empty();
        let wanted = |name: &str| self.experiments.iter().any(|given| given == name);
        experiments::ALL.into_iter().filter(|e| wanted(e.name) || (is_whole && (!self.quick || e.is_quick))).collect()
    }

    fn filters(&self) -> Vec<String> {
        let names = contenders::all().into_iter().chain(contenders::of_sun()).map(|c| c.name.to_owned());
        names.filter(|name| self.filters.is_empty() || self.filters.contains(name)).collect()
    }

    /// Defaults filled in.
    ///
    /// # Errors
    /// More measured frames than frames, or a program that cannot read itself.
    pub fn settings(&self, device: &str) -> Result<Settings> {
        let of = |given: Option<u32>, full: u32, quick: u32| given.unwrap_or(if self.quick { quick } else { full });
        let (frames, measured) = (of(self.frames, 40, 16), of(self.measured, 8, 4));
        if measured > frames {
            return Err(Error::MeasuredFrames { given: measured, frames });
        }
        Ok(Settings {
            size: self.size.unwrap_or(if self.quick { [128, 72] } else { [320, 180] }),
            frames,
            measured,
            reference_spp: of(self.reference_spp, 128, 32),
            filters: self.filters(),
            seed: self.seed,
            noise: self.noise,
            device: device.to_owned(),
            program: program()?,
        })
    }
}

impl Settings {
    /// Those of some filters that are wanted.
    pub fn wanted(&self, contenders: Vec<Contender>) -> Vec<Contender> {
        contenders.into_iter().filter(|c| self.filters.iter().any(|name| name == c.name)).collect()
    }

    /// Indices of the frames that are measured.
    pub fn measured_frames(&self) -> std::ops::Range<u32> {
        self.frames - self.measured..self.frames
    }
}

fn program() -> Result<u64> {
    let path = std::env::current_exe().unwrap_or_default();
    let bytes = std::fs::read(&path).map_err(|e| atrous_engine::Error::Folder { path, problem: e.to_string() })?;
    let mut hasher = DefaultHasher::new();
    bytes.hash(&mut hasher);
    Ok(hasher.finish())
}
