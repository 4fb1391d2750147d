//! Experiments beside the tables of scenes: counterparts of figures of the papers, and what presets have to reach.

mod ablation;
mod display;
mod eaw;
mod energy;
mod findings;
mod flicker;
mod ghost;
mod glass;
mod other;
mod reflection;
mod regions;
mod resolution;
mod sparse;
mod still;
mod strata;
mod variance;

use std::path::Path;
use std::sync::Arc;

use crate::Result;
use atrous_engine::{Scene, SceneOptions, TracerOptions};
use serde::{Deserialize, Serialize};

use super::contenders::Contender;
use super::results::{self, Row};
use super::scene::{self, Lab};
use super::settings::Settings;
use crate::files;

pub use findings::{Figures, Findings, Lines};

/// An experiment, by its name.
pub struct Experiment {
    /// Name on the command line.
    pub name: &'static str,
    /// Whether it belongs to `--quick`, too.
    pub is_quick: bool,
    /// Does it, with a folder of its own, which exists.
    run: fn(&Lab, &Path) -> Result<Findings>,
}

/// All of them, in the order of the report.
pub const ALL: [Experiment; 14] = [
    Experiment { name: "flicker", is_quick: true, run: flicker::run },
    Experiment { name: "ghost", is_quick: false, run: ghost::run },
    Experiment { name: "reflection", is_quick: false, run: reflection::run },
    Experiment { name: "glass", is_quick: false, run: glass::run },
    Experiment { name: "still", is_quick: false, run: still::run },
    Experiment { name: "variance", is_quick: true, run: variance::run },
    Experiment { name: "strata", is_quick: false, run: strata::run },
    Experiment { name: "other", is_quick: false, run: other::run },
    Experiment { name: "eaw", is_quick: false, run: eaw::run },
    Experiment { name: "sparse", is_quick: false, run: sparse::run },
    Experiment { name: "energy", is_quick: false, run: energy::run },
    Experiment { name: "display", is_quick: false, run: display::run },
    Experiment { name: "resolution", is_quick: false, run: resolution::run },
    Experiment { name: "ablation", is_quick: false, run: ablation::run },
];

/// Findings with what they depend on.
#[derive(Serialize, Deserialize)]
struct Kept {
    settings: Settings,
    findings: Findings,
}

impl Experiment {
    /// What it found: kept in a folder for each experiment in `out`, or measured anew.
    ///
    /// # Errors
    /// A lost device, or a folder that cannot be written.
    pub fn findings(&self, lab: &Lab, out: &Path) -> Result<Findings> {
        lab.bar.set_message(self.name);
        let folder = out.join("experiments").join(self.name);
        files::make(&folder)?;
        let file = folder.join("findings.json");
        if let Some(kept) = results::read::<Kept>(&file).filter(|kept| kept.settings == *lab.settings) {
            return Ok(kept.findings);
        }
        let kept = Kept { settings: lab.settings.clone(), findings: (self.run)(lab, &folder)? };
        results::keep(&file, &kept)?;
        Ok(kept.findings)
    }
}

/// Measures filters on a built-in scene as all scenes are.
///
/// # Errors
/// A lost device, or a folder that cannot be written.
fn on_scene(lab: &Lab, name: &str, contenders: &[Contender], folder: &Path) -> Result<Vec<Row>> {
    let scene = Arc::new(Scene::load(name, &SceneOptions::default())?);
    let folder = folder.join(name);
    files::make(&folder)?;
    scene::measure(lab, &scene, TracerOptions::default(), contenders, &folder)
}
