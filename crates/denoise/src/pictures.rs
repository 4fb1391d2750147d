//! PNG: strips, plots, and how they are written.

use crate::error::{Result, ToolError};
use crate::score::{FrameScore, ScoreBook};
use crate::views::Views;
use atrous_files::Existing;
use atrous_lab::pages::HeatMap;
use atrous_lab::pictures::{LinePlot, Picture, PictureError, Region, Strip};
use std::path::Path;

/// Size of a plot.
const PLOT: [u32; 2] = [900, 300];

/// A picture, or the reason why there is none.
pub type Drawn = std::result::Result<Picture, PictureError>;

/// Writes a picture.
pub fn save(path: &Path, existing: Existing, drawn: Drawn) -> Result<()> {
    let written = drawn.and_then(|picture| match existing {
        Existing::Kept => picture.write_new_png(path),
        Existing::Replaced => picture.write_png(path),
    });
    written.map_err(|e| match e {
        PictureError::File { source, .. } => ToolError::publish(path)(source),
        other => ToolError::Encode { path: path.to_owned(), problem: other.to_string() },
    })
}

/// Noisy, denoised and, where there is one, reference and the error against it, side by side with a detail of each.
pub fn strip(title: &str, views: &Views<'_>, errors: Option<&HeatMap>, score: Option<&FrameScore>, exposure: f32) -> Drawn {
    let [width, height] = views.extent;
    let picture = |pixels: &[[f32; 3]]| Picture::from_linear(width, height, pixels, exposure);
    let label = |name: &str, rmse: Option<f64>| rmse.map_or(name.to_owned(), |e| format!("{name}\nRMSE {e:.4}"));
    let mut strip = Strip::new(format!("{title}, frame {}", views.number))
        .panel(label("noisy", score.map(|s| s.noisy.rmse)), picture(&views.noisy)?)
        .panel(label("denoised", score.map(|s| s.denoised.rmse)), picture(&views.denoised)?);
    if let (Some(reference), Some(errors)) = (&views.reference, errors) {
        strip = strip.panel("reference", picture(reference)?);
        strip = strip.panel(format!("FLIP of denoised\nblack 0, light yellow {}", HeatMap::LARGEST_FLIP), errors.picture().clone());
    }
    let (w, h) = ((width / 5).max(1), (height / 5).max(1));
    strip.inset(Region { x: (width - w) / 2, y: (height - h) / 2, width: w, height: h }).render()
}

/// One plot below the other: each metric over the frames, noisy and denoised.
pub fn plots(book: &ScoreBook, preset: &str) -> Drawn {
    let titles = ["RMSE, linear radiance", "SSIM, tone-mapped", "HDR-FLIP", "temporal error, tone-mapped"];
    let pick = [0, 3, 4, 5];
    let mut panels = Vec::new();
    for (title, metric) in titles.iter().zip(pick) {
        let of = |f: &dyn Fn(&FrameScore) -> [f64; 6]| book.frames.iter().map(|s| f(s)[metric]).collect::<Vec<f64>>();
        let plot = LinePlot::new(*title).size(PLOT[0], PLOT[1]);
        let plot = plot.series(preset, of(&|s| s.denoised.values())).series("noisy", of(&|s| s.noisy.values()));
        match plot.render() {
            // A single frame has no temporal error.
            Err(PictureError::NothingToPlot(_)) => {}
            panel => panels.push(panel?),
        }
    }
    let mut sheet = Picture::filled(PLOT[0], PLOT[1] * panels.len().max(1) as u32, [255; 3])?;
    for (row, panel) in panels.iter().enumerate() {
        sheet.paste(panel, 0, PLOT[1] * row as u32);
    }
    Ok(sheet)
}
