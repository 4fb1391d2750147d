//! What the demo leaves behind: labelled strips, the sequence, and the tables.

use std::path::Path;

use atrous::DebugView;
use atrous_lab::pictures::{Column, Picture, PictureError, Strip, TextTable};

use crate::measure::{Frame, Scores};
use crate::Result;
use atrous_engine::FrameDenoiser;

/// Noisy and denoised, side by side.
///
/// # Errors
/// A file that cannot be written.
pub fn write_row(path: &Path, frame: &Frame) -> Result<()> {
    let [w, h] = frame.extent;
    let mut row = Picture::filled(w * (1 + frame.denoised.len() as u32), h, [0; 3])?;
    for (i, pixels) in (0..).zip(frame.pictures()) {
        row.paste(&Picture::from_linear(w, h, pixels, 1.0)?, i * w, 0);
    }
    Ok(row.write_png(path)?)
}

/// Noisy, each denoised picture, the reference where there is one; of a single denoiser its views as well. With labels: `names` are those of
/// the denoisers.
///
/// # Errors
/// A file that cannot be written.
pub fn write_strip(path: &Path, title: &str, frame: &Frame, names: &[&str], scores: Option<&[Scores]>) -> Result<()> {
    let [w, h] = frame.extent;
    let mut strip = Strip::new(format!("{title}, frame {}", frame.index));
    for (i, (name, pixels)) in ["noisy, 1 path per pixel"].iter().chain(names).zip(frame.pictures()).enumerate() {
        let label = match scores.and_then(|s| s.get(i)) {
            Some(s) => format!("{name}\nRMSE {:.4}  SSIM {:.3}", s.rmse, s.ssim),
            None => (*name).to_owned(),
        };
        strip = strip.panel(label, Picture::from_linear(w, h, pixels, 1.0)?);
    }
    if let Some(reference) = &frame.reference {
        strip = strip.panel("reference", Picture::from_linear(w, h, reference, 1.0)?);
    }
    let views = match &frame.denoised[..] {
        [only] => &only.views[..],
        _ => &[],
    };
    for (view, texels) in views {
        let colours: Vec<_> = texels.iter().map(|&[r, g, b, _]| [r, g, b]).collect();
        strip = strip.panel(label(*view), Picture::from_display(w, h, &colours)?);
    }
    // Five fit into a row; more are shared out between two.
    let panels = 1 + frame.denoised.len() + usize::from(frame.reference.is_some()) + views.len();
    let columns = if panels > 5 { panels.div_ceil(2) } else { panels };
    Ok(strip.columns(columns as u32).render()?.write_png(path)?)
}

/// What a view shows, and which colours mean what.
fn label(view: DebugView) -> &'static str {
    match view {
        DebugView::HistoryLength => "history length\n0 to 32 frames",
        DebugView::Deviation => "standard deviation\n0.25 in the middle",
        DebugView::Gradient => "gradient\nred brighter, blue darker",
        DebugView::Lambda => "lambda, change of light\n0 to 1",
        DebugView::Alpha => "alpha, weight of the new frame\n0 to 1",
        other => other.name(),
    }
}

/// Mean scores over the frames that have a reference.
pub fn mean(scores: &[Scores]) -> Scores {
    let over = |value: fn(&Scores) -> f64| {
        let values: Vec<f64> = scores.iter().map(value).filter(|v| v.is_finite()).collect();
        values.iter().sum::<f64>() / values.len() as f64
    };
    Scores {
        rmse: over(|s| s.rmse),
        rel_mse: over(|s| s.rel_mse),
        psnr: over(|s| s.psnr),
        ssim: over(|s| s.ssim),
        flip: over(|s| s.flip),
        temporal_error: over(|s| s.temporal_error),
    }
}

/// A table of scores: a row for each name, with the GPU time of a frame in milliseconds (NaN: none).
///
/// # Errors
/// None in practice: every row has every column.
pub fn score_table(rows: &[(String, Scores, f64)]) -> std::result::Result<TextTable, PictureError> {
    let columns = [("RMSE", 4), ("relMSE", 4), ("PSNR", 2), ("SSIM", 4), ("FLIP", 4), ("temporal error", 5), ("ms per frame", 1)];
    let mut table = TextTable::new("", columns.map(|(name, decimals)| Column::new(name, decimals)));
    for (name, s, milliseconds) in rows {
        table.row(name, &[s.rmse, s.rel_mse, s.psnr, s.ssim, s.flip, s.temporal_error, *milliseconds])?;
    }
    Ok(table)
}

/// The error of every frame that was measured: a column for each name.
///
/// # Errors
/// Another number of scores than names.
pub fn frame_table(names: &[&str], frames: &[(u32, Vec<Scores>)]) -> std::result::Result<TextTable, PictureError> {
    let mut table = TextTable::new("RMSE of frame", names.iter().map(|name| Column::new(*name, 4)));
    for (index, scores) in frames {
        table.row(index.to_string(), &scores.iter().map(|s| s.rmse).collect::<Vec<_>>())?;
    }
    Ok(table)
}

/// GPU time of each pass: mean over frames.
///
/// # Errors
/// None in practice.
pub fn time_table(times: &[(String, f64)]) -> std::result::Result<TextTable, PictureError> {
    let total: f64 = times.iter().map(|t| t.1).sum();
    let mut table = TextTable::new("pass", [Column::new("ms", 3), Column::new("%", 1)]);
    for (name, milliseconds) in times {
        table.row(name.clone(), &[*milliseconds, 100.0 * milliseconds / total])?;
    }
    table.row("all passes", &[total, 100.0])?;
    Ok(table)
}

/// What the denoiser allocated, in bytes and per pixel.
///
/// # Errors
/// None in practice.
pub fn memory_table(denoiser: &FrameDenoiser) -> std::result::Result<TextTable, PictureError> {
    let declaration = denoiser.executor().denoiser().declaration();
    let [w, h] = declaration.allocated_extent();
    let (planned, allocated) = (declaration.memory(), denoiser.executor().allocated());
    let mut table = TextTable::new(
        "memory",
        [Column::new("planned bytes", 0), Column::new("allocated bytes", 0), Column::new("bytes/pixel", 1)],
    );
    let rows = [
        ("history", planned.history, allocated.history),
        ("transient, aliased", planned.transient, allocated.transient),
        ("both", planned.history + planned.transient, allocated.history + allocated.transient),
        ("outputs", planned.output, allocated.output),
    ];
    for (name, planned, allocated) in rows {
        table.row(name, &[planned as f64, allocated as f64, allocated as f64 / (f64::from(w) * f64::from(h))])?;
    }
    Ok(table)
}
