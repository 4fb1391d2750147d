//! The figures as Markdown, with a picture of details.

use std::fs;
use std::path::Path;

use crate::measure::Scores;
use crate::{Error, Result};
use atrous_lab::pages::Best;
use atrous_lab::pictures::{Column, Picture, Region, Strip, TextTable};

use super::claims::{self, Claim};
use super::contenders::{ASVGF, BEST, NOISY, SVGF};
use super::experiments::Findings;
use super::figures;
use super::results::{mean_of, Memory, SceneResult};
use super::scene::{picture, REFERENCE};
use crate::files::write;

const BEGIN: &str = "<!-- evaluate -->";
const END: &str = "<!-- /evaluate -->";
/// Pictures of a row of the sheet.
const SHOWN: [&str; 5] = [NOISY, SVGF, ASVGF, BEST, REFERENCE];

/// A metric: heading, digits, and where it is among the scores.
pub struct Metric {
    /// Heading.
    pub name: &'static str,
    /// Digits behind the point.
    pub decimals: usize,
    /// Its value.
    pub of: fn(&Scores) -> f64,
    /// Whether more is better.
    pub more_is_better: bool,
}

impl Metric {
    /// The end of a column at which its best value is.
    pub fn best(&self) -> Best {
        match self.more_is_better {
            true => Best::Highest,
            false => Best::Lowest,
        }
    }
}

/// The metrics in the order of tables.
pub const METRICS: [Metric; 5] = [
    Metric { name: "RMSE", decimals: 4, of: |s| s.rmse, more_is_better: false },
    Metric { name: "relMSE", decimals: 4, of: |s| s.rel_mse, more_is_better: false },
    Metric { name: "SSIM", decimals: 3, of: |s| s.ssim, more_is_better: true },
    Metric { name: "FLIP", decimals: 3, of: |s| s.flip, more_is_better: false },
    Metric { name: "temporal RMSE", decimals: 4, of: |s| s.temporal_error, more_is_better: false },
];

/// How the figures came about, in a sentence.
pub fn conditions(results: &[SceneResult]) -> String {
    let Some(SceneResult { settings, .. }) = results.first() else { return String::new() };
    let frames = settings.measured_frames();
    format!(
        "{}x{}, one path a pixel, frames {} to {} of {} against {} paths a pixel, whose noise is left out of all but FLIP; {}.",
        settings.size[0],
        settings.size[1],
        frames.start,
        frames.end - 1,
        settings.frames,
        settings.reference_spp,
        settings.device
    )
}

/// A table of one metric: a row for each filter, a column for each scene.
///
/// # Errors
/// None in practice.
pub fn metric_table(results: &[SceneResult], metric: &Metric) -> Result<TextTable> {
    let columns = results.iter().map(|result| Column::new(result.scene.as_str(), metric.decimals));
    let mut table = TextTable::new(metric.name, columns);
    for name in names(results) {
        let values: Vec<_> =
            results.iter().map(|result| result.row(name).map_or(f64::NAN, |row| (metric.of)(&row.mean()))).collect();
        table.row(name, &values)?;
    }
    Ok(table)
}

/// A table of one scene: a row for each filter, a column for each metric.
///
/// # Errors
/// None in practice.
pub fn mean_table(result: &SceneResult) -> Result<TextTable> {
    let columns = METRICS.iter().map(|metric| Column::new(metric.name, metric.decimals));
    let mut table = TextTable::new("mean of the measured frames", columns);
    for row in &result.rows {
        let mean = row.mean();
        table.row(row.name.as_str(), &METRICS.each_ref().map(|metric| (metric.of)(&mean)))?;
    }
    Ok(table)
}

/// A table of what filters cost: means over the scenes.
///
/// # Errors
/// None in practice.
pub fn cost_table(results: &[SceneResult]) -> Result<TextTable> {
    let columns = [("ms a frame", 1), ("history, bytes a pixel", 1), ("transient", 1), ("both", 1)];
    let mut table = TextTable::new("cost", columns.map(|(name, decimals)| Column::new(name, decimals)));
    for name in names(results).into_iter().filter(|name| *name != NOISY) {
        let rows: Vec<_> = results.iter().filter_map(|result| result.row(name)).collect();
        let mean = |values: Vec<f64>| mean_of(&values).unwrap_or(f64::NAN);
        let memory = |of: fn(&Memory) -> f64| mean(rows.iter().filter_map(|row| row.memory.as_ref()).map(of).collect());
        let milliseconds = mean(rows.iter().filter_map(|row| row.milliseconds()).collect());
        table.row(name, &[milliseconds, memory(|m| m.history), memory(|m| m.transient), memory(|m| m.history + m.transient)])?;
    }
    Ok(table)
}

/// Names of the rows, in order. A scene may have rows of its own, behind the others.
pub fn names(results: &[SceneResult]) -> Vec<&str> {
    let mut names: Vec<&str> = Vec::new();
    for row in results.iter().flat_map(|result| &result.rows) {
        if !names.contains(&row.name.as_str()) {
            names.push(&row.name);
        }
    }
    names
}

/// All tables.
///
/// # Errors
/// None in practice.
pub fn text(results: &[SceneResult], findings: &[Findings], claims: &[Claim]) -> Result<String> {
    let mut text = String::new();
    if !results.is_empty() {
        text += &format!("{}\n", conditions(results));
        for metric in &METRICS {
            text += &format!("\n{}", metric_table(results, metric)?);
        }
        text += &format!("\n{}\n", cost_table(results)?);
    }
    text += &claims::table(claims)?.to_string();
    let of_scenes = figures::of_scenes(results);
    for found in findings.iter().chain(&of_scenes) {
        text += &format!("\n{}", found.markdown()?);
    }
    Ok(text)
}

/// A link to the sheet of details.
pub fn picture_of_details(path: &str) -> String {
    format!("![Details of the last frame of each scene]({path})\n")
}

/// Puts a text between the lines of a Markdown file that are meant for it.
///
/// # Errors
/// A file without these lines, or one that cannot be written.
pub fn renew(path: &Path, text: &str) -> Result<()> {
    let (before, behind) = around(path)?;
    write(path, format!("{before}{BEGIN}\n\n{text}\n{END}{behind}").as_bytes())
}

/// What stands before and behind the part that is renewed.
///
/// # Errors
/// A file that cannot be read, or has not these lines in this order.
pub fn around(path: &Path) -> Result<(String, String)> {
    let problem = |problem: String| Error::Markdown { path: path.to_owned(), problem };
    let text = fs::read_to_string(path).map_err(|e| problem(e.to_string()))?;
    let parts = text.split_once(BEGIN).and_then(|(before, rest)| Some((before, rest.split_once(END)?.1)));
    let (before, behind) = parts.ok_or_else(|| problem(format!("it has no line {BEGIN} with a line {END} behind it")))?;
    Ok((before.to_owned(), behind.to_owned()))
}

/// Details of every scene: noisy, three filters, reference.
///
/// # Errors
/// A picture that cannot be read.
pub fn sheet(results: &[SceneResult], out: &Path) -> Result<Picture> {
    let shown: Vec<_> = SHOWN.into_iter().filter(|name| *name == REFERENCE || names(results).contains(name)).collect();
    let mut sheet = Strip::new("last frame of each scene, the middle of it").columns(shown.len() as u32);
    for result in results {
        for name in &shown {
            let whole = Picture::read_png(picture(&out.join(&result.scene), name))?;
            let (width, height) = (whole.width().div_ceil(2), whole.height().div_ceil(2));
            let region = Region { x: width / 2, y: height / 2, width, height };
            sheet = sheet.panel(format!("{}\n{name}", result.scene), whole.crop(region)?);
        }
    }
    Ok(sheet.render()?)
}
