//! The scenes' measurements at twice the width and height.

use std::path::Path;

use crate::Result;

use super::{on_scene, Figures, Findings};
use crate::evaluate::contenders::{self, ASVGF, BEST, SVGF};
use crate::evaluate::scene::Lab;
use crate::evaluate::settings::Settings;

/// Soft shadows that wander, and edges of shadows as fine as a pixel.
const SCENES: [&str; 2] = ["pillars", "leaves"];
/// Frames that are measured: references are four times as large.
const MEASURED: u32 = 2;

pub fn run(lab: &Lab, folder: &Path) -> Result<Findings> {
    let [width, height] = lab.settings.size;
    let size = [2 * width, 2 * height];
    let settings = Settings { size, measured: lab.settings.measured.min(MEASURED), ..lab.settings.clone() };
    let lab = Lab { settings: &settings, ..*lab };
    let contenders = contenders::named(&[SVGF, ASVGF, "percentile", "fast", BEST]);
    let mut tables = Vec::new();
    for name in SCENES {
        let columns = [("RMSE", 4), ("relMSE", 4), ("SSIM", 3), ("FLIP", 3), ("temporal RMSE", 4), ("ms a frame", 1)];
        let mut table = Figures::new(name, columns);
        for row in on_scene(&lab, name, &contenders, folder)? {
            let (mean, milliseconds) = (row.mean(), row.milliseconds().unwrap_or(f64::NAN));
            table.row(&row.name, &[mean.rmse, mean.rel_mse, mean.ssim, mean.flip, mean.temporal_error, milliseconds]);
        }
        tables.push(table);
    }
    Ok(Findings {
        title: format!("At {}x{}", size[0], size[1]),
        text: format!("Twice as wide and high, the same defaults. Means of the last {} frames.", settings.measured),
        tables,
        ..Findings::default()
    })
}
