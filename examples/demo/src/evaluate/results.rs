//! The results of a scene, as they are kept in a file.

use std::fs;
use std::path::{Path, PathBuf};

use atrous_demo::measure::Scores;
use atrous_demo::report::mean;
use atrous_demo::{Error, Result};
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
    /// GPU time of a frame in milliseconds; `None` for the noisy picture, and on devices without timestamps.
    pub milliseconds: Option<f64>,
    /// Memory of history and transients; `None` for the noisy picture.
    pub bytes_per_pixel: Option<f64>,
}

impl Row {
    /// Means over the frames.
    pub fn mean(&self) -> Scores {
        mean(&self.frames)
    }
}

impl SceneResult {
    /// The figures of a filter.
    pub fn row(&self, name: &str) -> Option<&Row> {
        self.rows.iter().find(|row| row.name == name)
    }

    /// What a folder holds, if it is of these settings and this scene. A file that cannot be read counts as none: it is of another version.
    pub fn read(folder: &Path, settings: &Settings, content: u64) -> Option<Self> {
        let text = fs::read_to_string(file(folder)).ok()?;
        serde_json::from_str::<Self>(&text).ok().filter(|result| result.settings == *settings && result.content == content)
    }

    /// Writes it, behind the pictures that belong to it: what is there is complete.
    ///
    /// # Errors
    /// A folder that cannot be written.
    pub fn write(&self, folder: &Path) -> Result<()> {
        let problem = |problem: String| Error::Folder { path: file(folder), problem };
        let text = serde_json::to_string_pretty(self).map_err(|e| problem(e.to_string()))?;
        write(&file(folder), text.as_bytes())
    }
}

fn file(folder: &Path) -> PathBuf {
    folder.join("result.json")
}
