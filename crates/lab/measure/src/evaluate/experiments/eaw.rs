//! Edge-stopping functions and levels of EAW.

use std::path::Path;

use crate::Result;
use atrous::config::{EawWeights, Preset};

use super::{on_scene, Figures, Findings};
use crate::evaluate::contenders::{Contender, NOISY};
use crate::evaluate::scene::Lab;

const LEVELS: [u32; 3] = [1, 5, 10];
const NAMES: [[&str; 3]; 4] = [
    ["none, 1 level", "none, 5 levels", "none, 10 levels"],
    ["rt, 1 level", "rt, 5 levels", "rt, 10 levels"],
    ["rt, normal, 1 level", "rt, normal, 5 levels", "rt, normal, 10 levels"],
    ["rt, normal, position, 1 level", "rt, normal, position, 5 levels", "rt, normal, position, 10 levels"],
];

pub fn run(lab: &Lab, folder: &Path) -> Result<Findings> {
    let pairs = (0..NAMES.len()).flat_map(|weights| (0..LEVELS.len()).map(move |level| (weights, level)));
    let contenders: Vec<_> = pairs
        .map(|(weights, level)| {
            let mut contender = Contender::new(NAMES[weights][level], Preset::Eaw);
            contender.options.config.eaw_weights = EawWeights::first(weights as u32);
            contender.options.config.levels = Some(LEVELS[level]);
            contender
        })
        .collect();
    let mut table = Figures::new("cornell", [("MSE, % of the noisy picture's", 2), ("SSIM", 3), ("ms, levels alone", 1)]);
    let rows = on_scene(lab, "cornell", &contenders, folder)?;
    let noisy = rows[0].mean().rmse;
    for row in rows.iter().filter(|row| row.name != NOISY) {
        let mean = row.mean();
        table.row(&row.name, &[100.0 * (mean.rmse / noisy).powi(2), mean.ssim, row.stage("eaw")]);
    }
    Ok(Findings {
        title: "Edge-stopping functions and levels of EAW: [EAW] Fig. 4, Table 2".into(),
        text: "Each frame by itself; Fig. 12 of the paper has the squared error against that of the noisy picture, too.".into(),
        tables: vec![table],
        ..Findings::default()
    })
}
