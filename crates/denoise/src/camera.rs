//! `sequence.json`: matrices, jitter and conventions of a sequence.

use crate::captured_config::CapturedConfig;
use crate::error::{Result, ToolError};
use crate::old_tunables::of_today;
use atrous::{Material, ResetReason};
use serde::{Deserialize, Deserializer};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Largest `sequence.json` that is read: some 100 000 frames.
const MAX_BYTES: u64 = 256 << 20;

type Rows = [[f32; 4]; 4];

/// One frame's camera. Matrices are column-major for column vectors.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// What the frame counted as in the engine that it was captured from; its number where that is not told.
    pub index: u64,
    /// World to view.
    pub view_from_world: Rows,
    /// View to clip space, y down, depth 0..1, unjittered.
    pub clip_from_view: Rows,
    /// Offset of the samples from pixel centres.
    pub jitter: [f32; 2],
    /// Exposure over that of the previous frame.
    pub exposure_ratio: f32,
    /// The history is dropped here.
    pub reset: Option<ResetReason>,
    /// The noisy radiance has re-shaded samples at the pixels that the forward projection picks.
    pub reshaded: bool,
    /// Places of the lights whose visibility the frames have.
    pub lights: [[f32; 4]; 4],
    /// The pixel of the guides in each cell that light of fewer pixels was traced for.
    pub offset: [u32; 2],
    /// Numbers of the classes of materials.
    pub materials: [Material; Material::CLASSES],
    /// Tunables that are not those of the sequence.
    pub tuning: BTreeMap<String, f32>,
}

/// The content of `sequence.json`.
#[derive(Clone, Debug, Default)]
pub struct SequenceFile {
    /// The file.
    pub path: PathBuf,
    /// Cameras by frame number.
    pub cameras: BTreeMap<u64, Camera>,
    /// Conventions, as for `--convention`.
    pub conventions: Vec<(String, String)>,
    /// The configuration.
    pub config: CapturedConfig,
    /// Tunables.
    pub tuning: BTreeMap<String, f32>,
    /// Checksum of the whole text.
    pub checksum: u32,
    /// Values that are not finite reach the filter: a capture shows what an engine gave it.
    pub verbatim: bool,
}

#[derive(Deserialize)]
struct Json {
    frames: Vec<JsonFrame>,
    #[serde(default)]
    conventions: BTreeMap<String, Value>,
    #[serde(default)]
    config: CapturedConfig,
    /// Of the first captures, which have no `config`.
    levels: Option<u32>,
    #[serde(default)]
    tuning: BTreeMap<String, f32>,
    #[serde(default)]
    verbatim: bool,
}

#[derive(Deserialize)]
struct JsonFrame {
    i: Option<u64>,
    index: Option<u64>,
    view: Rows,
    proj: Rows,
    #[serde(default)]
    jitter: [f32; 2],
    #[serde(default = "one")]
    exposure_ratio: f32,
    #[serde(default, deserialize_with = "reset")]
    reset: Option<ResetReason>,
    #[serde(default)]
    reshaded: bool,
    #[serde(default)]
    lights: [[f32; 4]; 4],
    #[serde(default)]
    offset: [u32; 2],
    #[serde(default)]
    materials: Option<[[f32; 4]; Material::CLASSES]>,
    #[serde(default)]
    tuning: BTreeMap<String, f32>,
}

/// `true`, or the reason.
fn reset<'de, D: Deserializer<'de>>(from: D) -> std::result::Result<Option<ResetReason>, D::Error> {
    match Value::deserialize(from)? {
        Value::Bool(flag) => Ok(flag.then_some(ResetReason::CameraCut)),
        reason => ResetReason::deserialize(reason).map(Some).map_err(serde::de::Error::custom),
    }
}

fn one() -> f32 {
    1.0
}

/// Rows of a matrix, as JSON has them, to columns.
fn transposed(rows: &Rows) -> Rows {
    std::array::from_fn(|column| std::array::from_fn(|row| rows[row][column]))
}

/// Finds `sequence.json`: the given path, or beside the frames; there need not be one.
pub fn find(given: Option<&Path>, folder: &Path) -> Result<Option<(PathBuf, SequenceFile)>> {
    let path = match given {
        Some(path) => path.to_owned(),
        None => folder.join("sequence.json"),
    };
    match atrous_files::read_text(&path, MAX_BYTES) {
        Ok(text) => Ok(Some((path.clone(), parse(&path, &text)?))),
        Err(e) if e.kind() == std::io::ErrorKind::NotFound && given.is_none() => Ok(None),
        Err(source) => Err(ToolError::Read { path, source }),
    }
}

/// Reads the text of a `sequence.json`.
pub fn parse(path: &Path, text: &str) -> Result<SequenceFile> {
    let problem = |problem: String| ToolError::Json { path: path.to_owned(), problem };
    // Some editors begin a text with a byte order mark.
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let json: Json = serde_json::from_str(text).map_err(|e| problem(format!("is not a sequence description: {e}")))?;
    let mut cameras = BTreeMap::new();
    for (index, frame) in json.frames.into_iter().enumerate() {
        let number = frame.i.unwrap_or(index as u64);
        let camera = Camera {
            index: frame.index.unwrap_or(number),
            view_from_world: transposed(&frame.view),
            clip_from_view: transposed(&frame.proj),
            jitter: frame.jitter,
            exposure_ratio: frame.exposure_ratio,
            reset: frame.reset,
            reshaded: frame.reshaded,
            lights: frame.lights,
            offset: frame.offset,
            materials: frame.materials.map_or([Material::default(); Material::CLASSES], |all| all.map(Material::from)),
            tuning: of_today(frame.tuning).map_err(problem)?,
        };
        if cameras.insert(number, camera).is_some() {
            return Err(problem(format!("has frame {number} twice")));
        }
    }
    let text_of = |value: &Value| value.as_str().map_or_else(|| value.to_string(), str::to_owned);
    let conventions = json.conventions.iter().map(|(key, value)| (key.clone(), text_of(value))).collect();
    let checksum = crc32fast::hash(text.as_bytes());
    let config = json.levels.map_or(json.config, CapturedConfig::of_the_first);
    let tuning = of_today(json.tuning).map_err(problem)?;
    Ok(SequenceFile { path: path.to_owned(), cameras, conventions, config, tuning, checksum, verbatim: json.verbatim })
}
