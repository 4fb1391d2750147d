//! The figures as one HTML file: tables, pictures to compare, errors as heat maps, curves over the frames.

use std::path::Path;

use crate::Result;
use atrous_lab::pages::{Cell, Comparison, Curves, HeatMap, Page, Section, Table};
use atrous_lab::pictures::Picture;

use super::claims::Claim;
use super::contenders::{BEST, NOISY};
use super::experiments::Findings;
use super::figures;
use super::markdown::{conditions, cost_table, mean_table, metric_table, Metric, METRICS};
use super::results::SceneResult;
use super::scene::{picture, read_error, REFERENCE};

/// Writes the page.
///
/// # Errors
/// A picture that cannot be read, or a page that cannot be written.
pub fn write(path: &Path, results: &[SceneResult], findings: &[Findings], claims: &[Claim], out: &Path) -> Result<()> {
    let mut page = Page::new("Denoisers on the scenes of the demo");
    page.introduction(conditions(results));
    if !results.is_empty() {
        summary(page.section("All scenes"), results)?;
    }
    page.section("What is claimed").table(claim_table(claims)?);
    for found in findings.iter().chain(&figures::of_scenes(results)) {
        found.show(page.section(found.title.as_str()))?;
    }
    for result in results {
        of_scene(page.section(result.scene.as_str()), result, &out.join(&result.scene))?;
    }
    Ok(page.write(path)?)
}

fn summary(summary: &mut Section, results: &[SceneResult]) -> Result<()> {
    summary.text("Means over the measured frames. RMSE and relMSE of linear radiance, SSIM and temporal RMSE of tone-mapped values, HDR-FLIP. The noise of the references is left out of all but FLIP.");
    for metric in &METRICS {
        summary.table(table_of(results, metric)?);
    }
    summary.table(&cost_table(results)?);
    Ok(())
}

/// The table of a metric, with the best of each scene.
fn table_of(results: &[SceneResult], metric: &Metric) -> Result<Table> {
    let mut table = Table::from(&metric_table(results, metric)?);
    results.iter().try_for_each(|result| table.best(&result.scene, metric.best()))?;
    Ok(table)
}

fn claim_table(claims: &[Claim]) -> Result<Table> {
    let mut table = Table::new("scene and claim", ["measured", "bound", ""]);
    for claim in claims {
        let verdict = if claim.holds() { "holds" } else { "fails" };
        let cells = [
            Cell::number(claim.ratio, format!("{:.3}", claim.ratio)),
            Cell::number(claim.bound, format!("{:.2}", claim.bound)),
            Cell::from(verdict),
        ];
        table.row(format!("{}: {}", claim.scene, claim.text), cells)?;
    }
    Ok(table)
}

fn of_scene(section: &mut Section, result: &SceneResult, folder: &Path) -> Result<()> {
    let frames = result.settings.measured_frames();
    let mut comparison = Comparison::new(format!("Frame {}", frames.end - 1));
    for row in &result.rows {
        comparison.picture(row.name.as_str(), &Picture::read_png(picture(folder, &row.name))?)?;
    }
    comparison.picture(REFERENCE, &Picture::read_png(picture(folder, REFERENCE))?)?;
    let [width, height] = result.settings.size;
    for row in &result.rows {
        let map = HeatMap::of_flip(width, height, &read_error(folder, &row.name)?)?;
        comparison.heat_map(format!("FLIP of {}", row.name), &map)?;
    }
    let right = if result.row(BEST).is_some() { BEST } else { REFERENCE };
    comparison.start(NOISY, right)?;
    section.comparison(comparison)?;
    let mut table = Table::from(&mean_table(result)?);
    METRICS.iter().try_for_each(|metric| table.best(metric.name, metric.best()))?;
    section.table(table);
    for metric in &METRICS {
        // The noisy picture would make one line of all others.
        let denoised = result.rows.iter().filter(|row| row.name != NOISY);
        let curves = denoised.fold(Curves::new(metric.name).first_frame(frames.start), |curves, row| {
            curves.series(row.name.as_str(), row.frames.iter().map(metric.of).collect::<Vec<_>>())
        });
        section.curves(curves)?;
    }
    Ok(())
}
