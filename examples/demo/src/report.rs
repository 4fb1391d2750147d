//! What the demo leaves behind: labelled strips, the sequence, and the tables.

use std::path::Path;

use atrous_picture::{Column, Picture, PictureError, Strip, TextTable};

use crate::measure::{Frame, Scores};
use crate::{FrameDenoiser, Result};

/// Longest history length that the false colours tell apart.
const LONGEST_SHOWN: f32 = 32.0;

/// Noisy and denoised, side by side.
///
/// # Errors
/// A file that cannot be written.
pub fn write_pair(path: &Path, frame: &Frame) -> Result<()> {
    let [w, h] = frame.extent;
    let mut pair = Picture::filled(2 * w, h, [0; 3])?;
    pair.paste(&Picture::from_linear(w, h, &frame.noisy, 1.0)?, 0, 0);
    pair.paste(&Picture::from_linear(w, h, &frame.denoised, 1.0)?, w, 0);
    Ok(pair.write_png(path)?)
}

/// Noisy, denoised, reference where there is one, history length and variance, with their labels.
///
/// # Errors
/// A file that cannot be written.
pub fn write_strip(path: &Path, title: &str, frame: &Frame, scores: Option<[Scores; 2]>) -> Result<()> {
    let [w, h] = frame.extent;
    let label = |name: &str, s: Option<Scores>| match s {
        Some(s) => format!("{name}\nRMSE {:.4}  SSIM {:.3}", s.rmse, s.ssim),
        None => name.to_owned(),
    };
    let colour = |pixels: &[[f32; 3]]| Picture::from_linear(w, h, pixels, 1.0);
    let mut strip = Strip::new(format!("{title}, frame {}", frame.index))
        .panel(label("noisy, 1 path per pixel", scores.map(|s| s[0])), colour(&frame.noisy)?)
        .panel(label("denoised", scores.map(|s| s[1])), colour(&frame.denoised)?);
    if let Some(reference) = &frame.reference {
        strip = strip.panel("reference", colour(reference)?);
    }
    let deviation_range = high(&frame.deviation);
    strip = strip
        .panel(
            format!("history length\n0 to {LONGEST_SHOWN} frames"),
            Picture::false_colour(w, h, &frame.history_length, [0.0, LONGEST_SHOWN])?,
        )
        .panel(
            format!("variance, as standard deviation\n0 to {deviation_range:.3}"),
            Picture::false_colour(w, h, &frame.deviation, [0.0, deviation_range])?,
        );
    Ok(strip.render()?.write_png(path)?)
}

/// The value below which 99 % of the values lie.
fn high(values: &[f32]) -> f32 {
    let mut sorted: Vec<f32> = values.iter().copied().filter(|v| v.is_finite()).collect();
    sorted.sort_by(f32::total_cmp);
    sorted.get(sorted.len() * 99 / 100).copied().unwrap_or(1.0).max(1e-3)
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
        temporal_error: over(|s| s.temporal_error),
    }
}

/// A table of scores: a row for each name.
///
/// # Errors
/// None in practice: every row has every column.
pub fn score_table(rows: &[(String, Scores)]) -> std::result::Result<TextTable, PictureError> {
    let columns = [("RMSE", 4), ("relMSE", 4), ("PSNR", 2), ("SSIM", 4), ("temporal error", 5)];
    let mut table = TextTable::new("", columns.map(|(name, decimals)| Column::new(name, decimals)));
    for (name, s) in rows {
        table.row(name, &[s.rmse, s.rel_mse, s.psnr, s.ssim, s.temporal_error])?;
    }
    Ok(table)
}

/// GPU time of each pass: mean over frames.
///
/// # Errors
/// None in practice.
pub fn time_table(times: &[(&'static str, f64)]) -> std::result::Result<TextTable, PictureError> {
    let total: f64 = times.iter().map(|t| t.1).sum();
    let mut table = TextTable::new("pass", [Column::new("ms", 3), Column::new("%", 1)]);
    for (name, milliseconds) in times {
        table.row(*name, &[*milliseconds, 100.0 * milliseconds / total])?;
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
