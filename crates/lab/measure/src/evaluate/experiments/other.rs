//! Temporal accumulation by gradients over the pictures of another denoiser.

use std::path::Path;

use crate::Result;
use atrous::config::Preset;

use super::Lines;
use super::{on_scene, Figures, Findings};
use crate::evaluate::contenders::{Contender, ASVGF};
use crate::evaluate::scene::Lab;

const EAW: &str = "EAW";

pub fn run(lab: &Lab, folder: &Path) -> Result<Findings> {
    let over = Contender { over: Some(EAW), ..Contender::new("EAW, then stabilize", Preset::Stabilize) };
    let contenders = [Contender::new(EAW, Preset::Eaw), over, Contender::new(ASVGF, Preset::Asvgf)];
    let (mut tables, mut curves) = (Vec::new(), Vec::new());
    for name in ["cornell", "pillars"] {
        let rows = on_scene(lab, name, &contenders, folder)?;
        let mut table = Figures::new(name, [("RMSE", 4), ("SSIM", 3), ("FLIP", 3), ("temporal RMSE", 4)]);
        for row in &rows[1..] {
            let mean = row.mean();
            table.row(&row.name, &[mean.rmse, mean.ssim, mean.flip, mean.temporal_error]);
        }
        tables.push(table);
        let series = rows[1..].iter().map(|row| (row.name.clone(), row.frames.iter().map(|frame| frame.rmse).collect())).collect();
        curves.push(Lines { title: format!("RMSE, {name}"), first_frame: lab.settings.measured_frames().start, series });
    }
    Ok(Findings {
        title: "Consecutive frames of another denoiser, accumulated: [ASVGF] Fig. 6".into(),
        text: "The preset `stabilize` (A-RAE) takes the pictures of EAW, which knows no other frame.".into(),
        tables,
        curves,
        ..Findings::default()
    })
}
