//! PNG: previews, strips, views and plots.

use crate::backend::MomentsView;
use crate::error::{Result, ToolError};
use crate::frame::FrameInputs;
use crate::score::{FrameScore, ScoreBook};
use atrous::reference::{LONG_HISTORY, REASON_COLOURS};
use atrous_picture::{LinePlot, Picture, PictureError, Region, Strip};
use std::path::Path;

/// Size of a plot.
const PLOT: [u32; 2] = [900, 300];

fn save(path: &Path, picture: std::result::Result<Picture, PictureError>) -> Result<()> {
    let failed = |e: PictureError| match e {
        PictureError::File { source, .. } => ToolError::Write { path: path.to_owned(), source },
        other => ToolError::Encode { path: path.to_owned(), problem: other.to_string() },
    };
    picture.and_then(|p| p.write_png(path)).map_err(failed)
}

/// A tone-mapped preview.
pub fn preview(path: &Path, extent: [u32; 2], radiance: &[[f32; 3]], exposure: f32) -> Result<()> {
    save(path, Picture::from_linear(extent[0], extent[1], radiance, exposure))
}

/// Noisy, denoised and, where there is one, reference, side by side with a detail of each.
pub fn strip(
    path: &Path,
    title: &str,
    frame: &FrameInputs,
    radiance: &[[f32; 3]],
    score: Option<&FrameScore>,
    exposure: f32,
) -> Result<()> {
    let [width, height] = frame.params.render_extent;
    let picture = |pixels: &[[f32; 3]]| Picture::from_linear(width, height, pixels, exposure);
    let label = |name: &str, rmse: Option<f64>| rmse.map_or(name.to_owned(), |e| format!("{name}\nRMSE {e:.4}"));
    let render = || {
        let mut strip = Strip::new(format!("{title}, frame {}", frame.number))
            .panel(label("noisy", score.map(|s| s.noisy.rmse)), picture(&frame.noisy)?)
            .panel(label("denoised", score.map(|s| s.denoised.rmse)), picture(radiance)?);
        if let Some(reference) = &frame.reference {
            strip = strip.panel("reference", picture(reference)?);
        }
        let (w, h) = ((width / 5).max(1), (height / 5).max(1));
        strip.inset(Region { x: (width - w) / 2, y: (height - h) / 2, width: w, height: h }).render()
    };
    save(path, render())
}

/// History length, variance, α and disocclusion reasons of every signal.
pub fn views(folder: &Path, stem: &str, extent: [u32; 2], views: &[MomentsView], alpha: f32) -> Result<()> {
    let [w, h] = extent;
    for view in views {
        let path = |what: &str| folder.join(format!("{stem}_{what}{}.png", view.suffix));
        save(&path("history_length"), Picture::false_colour(w, h, &view.history_length, [0.0, LONG_HISTORY]))?;
        let alphas: Vec<f32> = view.history_length.iter().map(|n| alpha.max(1.0 / n.max(1.0))).collect();
        save(&path("alpha"), Picture::false_colour(w, h, &alphas, [0.0, 1.0]))?;
        let variance: Vec<f32> = view.deviation.iter().map(|d| d * d).collect();
        save(&path("variance"), Picture::false_colour(w, h, &variance, [0.0, bright(&variance)]))?;
        let colours = view.reason.iter().map(|r| REASON_COLOURS[usize::from(*r).min(REASON_COLOURS.len() - 1)]).collect();
        save(&path("disocclusion"), Picture::from_pixels(w, h, colours))?;
    }
    Ok(())
}

/// The 99th percentile, so that single pixels do not darken the rest.
fn bright(values: &[f32]) -> f32 {
    let mut sorted: Vec<f32> = values.iter().copied().filter(|v| v.is_finite()).collect();
    sorted.sort_by(f32::total_cmp);
    sorted.get(sorted.len() * 99 / 100).copied().unwrap_or(1.0).max(1e-6)
}

/// One plot below the other: each metric over the frames, noisy and denoised.
pub fn plots(path: &Path, book: &ScoreBook, preset: &str) -> Result<()> {
    let render = || {
        let titles = ["RMSE, linear radiance", "SSIM, tone-mapped", "temporal error, tone-mapped"];
        let pick = [0, 3, 4];
        let mut panels = Vec::new();
        for (title, metric) in titles.iter().zip(pick) {
            let of = |f: &dyn Fn(&FrameScore) -> [f64; 5]| book.frames.iter().map(|s| f(s)[metric]).collect::<Vec<f64>>();
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
    };
    save(path, render())
}
