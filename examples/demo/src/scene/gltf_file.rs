//! TODO
use super::Scene;
use crate::error::{Error, Result};
pub fn load(path: &std::path::Path) -> Result<Scene> {
    Err(Error::SceneFile {
        path: path.into(),
        problem: "not yet".into(),
        remedy: "wait",
    })
}
