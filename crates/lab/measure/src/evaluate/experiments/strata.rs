//! Gradient samples in blocks of 2x2, 3x3 and 4x4 pixels.

use std::path::Path;

use crate::Result;
use atrous::config::Preset;

use super::{on_scene, Figures, Findings};
use crate::evaluate::contenders::Contender;
use crate::evaluate::scene::Lab;

/// Scenes whose light changes.
const SCENES: [&str; 2] = ["cornell", "pillars"];

pub fn run(lab: &Lab, folder: &Path) -> Result<Findings> {
    let sizes = [
        ("A-SVGF, 2x2", 2, Preset::Asvgf),
        ("A-SVGF, 3x3", 3, Preset::Asvgf),
        ("A-SVGF, 4x4", 4, Preset::Asvgf),
        ("best, 2x2", 2, Preset::Best),
        ("best, 3x3", 3, Preset::Best),
        ("best, 4x4", 4, Preset::Best),
    ];
    let contenders = sizes.map(|(name, stratum_size, preset)| {
        let mut contender = Contender::new(name, preset);
        contender.options.config.stratum_size = stratum_size;
        contender
    });
    let mut tables = Vec::new();
    for name in SCENES {
        let mut table = Figures::new(name, [("RMSE", 4), ("SSIM", 3), ("temporal RMSE", 4), ("ms, gradients", 1)]);
        for row in on_scene(lab, name, &contenders, folder)?.iter().skip(1) {
            let mean = row.mean();
            let stages = ["forward_project", "gradient", "gradient_atrous", "history_confidence"];
            table.row(&row.name, &[mean.rmse, mean.ssim, mean.temporal_error, stages.iter().map(|stage| row.stage(stage)).sum()]);
        }
        tables.push(table);
    }
    Ok(Findings {
        title: "Sizes of strata: [ASVGF] Fig. 5".into(),
        text: "One pixel in four, nine or sixteen is a gradient sample. Means of the measured frames.".into(),
        tables,
        ..Findings::default()
    })
}
