//! Results, as they are kept in files.

use std::fs;
use std::path::{Path, PathBuf};

use crate::measure::Scores;
use crate::report::mean;
use crate::Result;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::settings::Settings;
use crate::files::write;

/// Everything that was measured on a scene.
#[derive(Serialize, Deserialize)]
pub struct SceneResult {
    /// What it depends on.
    pub settings: Settings,
    /// Name of the scene.
    pub scene: String,
    /// Hash of the scene: a file may change.
    pub content: u64,
    /// The noisy picture, then each filter.
    pub rows: Vec<Row>,
}

/// The figures of one filter.
#[derive(Serialize, Deserialize)]
pub struct Row {
    /// Name of the filter.
    pub name: String,
    /// Scores of each measured frame.
    pub frames: Vec<Scores>,
    /// Light of all measured frames, as a share of the references'.
    pub energy: f64,
    /// GPU time of each stage in milliseconds, one for each frame behind the first two; none for the noisy picture, and on devices without
    /// timestamps.
    pub stages: Vec<(String, Vec<f64>)>,
    /// Memory; `None` for the noisy picture.
    pub memory: Option<Memory>,
}

/// Memory of a filter, bytes a pixel.
#[derive(Clone, Copy, Serialize, Deserialize)]
pub struct Memory {
    /// What is kept from frame to frame.
    pub history: f64,
    /// What another use may have between frames.
    pub transient: f64,
}

impl Row {
    /// Means over the frames.
    pub fn mean(&self) -> Scores {
        mean(&self.frames)
    }

    /// Milliseconds of each frame; none where nothing was measured.
    pub fn frame_times(&self) -> Vec<f64> {
        let frames = self.stages.first().map_or(0, |(_, times)| times.len());
        (0..frames).map(|frame| self.stages.iter().map(|(_, times)| times[frame]).sum()).collect()
    }

    /// Milliseconds of a frame, the mean.
    pub fn milliseconds(&self) -> Option<f64> {
        mean_of(&self.frame_times())
    }

    /// Milliseconds of a stage, the mean; 0 for one that the filter does not have.
    pub fn stage(&self, name: &str) -> f64 {
        self.stages.iter().find(|(stage, _)| stage == name).and_then(|(_, times)| mean_of(times)).unwrap_or(0.0)
    }
}

/// The mean, where there are values.
pub fn mean_of(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

impl SceneResult {
    /// The figures of a filter.
    pub fn row(&self, name: &str) -> Option<&Row> {
        self.rows.iter().find(|row| row.name == name)
    }

    /// What a folder holds, if it is of these settings and this scene.
    pub fn read(folder: &Path, settings: &Settings, content: u64) -> Option<Self> {
        read::<Self>(&file(folder)).filter(|result| result.settings == *settings && result.content == content)
    }

    /// Writes it, behind the pictures that belong to it: what is there is complete.
    ///
    /// # Errors
    /// A folder that cannot be written.
    pub fn write(&self, folder: &Path) -> Result<()> {
        keep(&file(folder), self)
    }
}

/// What a file holds. One that cannot be read counts as none: it is of another version.
pub fn read<T: DeserializeOwned>(path: &Path) -> Option<T> {
    serde_json::from_str(&fs::read_to_string(path).ok()?).ok()
}

/// Writes a file for [`read`].
///
/// # Errors
/// A file that cannot be written.
pub fn keep<T: Serialize>(path: &Path, value: &T) -> Result<()> {
    let text = serde_json::to_string_pretty(value);
    let text = text.map_err(|e| atrous_engine::Error::Folder { path: path.to_owned(), problem: e.to_string() })?;
    write(path, text.as_bytes())
}

fn file(folder: &Path) -> PathBuf {
    folder.join("result.json")
}
