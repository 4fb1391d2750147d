//! A way of the camera, frame by frame, that a file keeps.

use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::error::{Error, Result};
use atrous_engine::scene::View;

/// One view for each frame.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CameraPath {
    views: Vec<SavedView>,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct SavedView {
    eye: [f32; 3],
    target: [f32; 3],
    up: [f32; 3],
    /// Radians.
    vertical_fov: f32,
}

impl CameraPath {
    /// Adds the view of the next frame.
    pub fn push(&mut self, view: &View) {
        let View { eye, target, up, vertical_fov } = *view;
        self.views.push(SavedView { eye: eye.into(), target: target.into(), up: up.into(), vertical_fov });
    }

    /// The view of a frame; `None` at the end.
    pub fn view(&self, frame: usize) -> Option<View> {
        let SavedView { eye, target, up, vertical_fov } = *self.views.get(frame)?;
        Some(View { eye: eye.into(), target: target.into(), up: up.into(), vertical_fov })
    }

    /// Frames.
    pub fn len(&self) -> usize {
        self.views.len()
    }

    /// Reads a file.
    ///
    /// # Errors
    /// A file that cannot be read, or a view that no camera has.
    pub fn load(path: &Path) -> Result<Self> {
        let bad = |problem: String| Error::SettingsFile { path: path.to_owned(), problem };
        let text = atrous_files::read_text(path, 64 << 20).map_err(|e| bad(e.to_string()))?;
        let loaded: Self = serde_json::from_str(&text).map_err(|e| bad(e.to_string()))?;
        let finite = |v: &SavedView| [v.eye, v.target, v.up].iter().flatten().all(|c| c.is_finite());
        let usable = |v: &SavedView| finite(v) && v.eye != v.target && (0.01..3.0).contains(&v.vertical_fov);
        match loaded.views.iter().position(|v| !usable(v)) {
            Some(frame) => {
                Err(bad(format!("the view of frame {frame} is none: eye and target have to differ, vertical_fov is 0.01 to 3")))
            }
            None if loaded.views.is_empty() => Err(bad("it has no views".into())),
            None => Ok(loaded),
        }
    }

    /// Writes a file.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn save(&self, path: &Path) -> Result<()> {
        let bad = |problem: String| Error::SettingsFile { path: path.to_owned(), problem };
        let text = serde_json::to_string(self).map_err(|e| bad(e.to_string()))?;
        std::fs::write(path, text + "\n").map_err(|e| bad(e.to_string()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn a_way_survives_a_file_and_a_wrong_one_is_named() {
        let path = std::env::temp_dir().join(format!("atrous-path-{}.json", std::process::id()));
        let mut way = CameraPath::default();
        for x in [0.1f32, 0.3] {
            way.push(&View { eye: Vec3::X * x, target: Vec3::NEG_Z, up: Vec3::Y, vertical_fov: 0.8 });
        }
        way.save(&path).expect("saved");
        let loaded = CameraPath::load(&path).expect("loaded");
        assert_eq!(loaded, way);
        assert_eq!((loaded.len(), loaded.view(2)), (2, None));
        way.push(&View { eye: Vec3::ONE, target: Vec3::ONE, up: Vec3::Y, vertical_fov: 0.8 });
        way.save(&path).expect("saved");
        assert!(CameraPath::load(&path).expect_err("wrong").to_string().contains("frame 2"));
        let _ = std::fs::remove_file(path);
    }
}
