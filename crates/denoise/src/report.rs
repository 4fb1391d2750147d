//! The report of a run as one HTML file: pictures of a frame to compare, errors, every metric over the frames.

use crate::error::{Result, ToolError};
use crate::score::{FrameScore, Metrics, ScoreBook};
use crate::views::Views;
use atrous_files::Existing;
use atrous_lab::pages::{Comparison, Curves, HeatMap, Page, PageError};
use atrous_lab::pictures::Picture;
use atrous_lab::scores::{flip_map, Rgb};
use std::path::Path;

/// FLIP of the denoised picture of a frame, where it has a reference.
///
/// # Errors
/// Pictures with values that are not finite.
pub fn errors(views: &Views<'_>) -> Result<Option<HeatMap>> {
    views.reference.as_ref().map(|reference| heat_map(views.extent, &views.denoised, reference)).transpose()
}

fn heat_map([width, height]: [u32; 2], radiance: &[[f32; 3]], reference: &[[f32; 3]]) -> Result<HeatMap> {
    let rgb = |pixels| Rgb::new(width, height, pixels);
    let errors = rgb(radiance).and_then(|image| flip_map(image, rgb(reference)?));
    let errors = errors.map_err(|e| ToolError::Usage(format!("the frame cannot be scored: {e}")))?;
    Ok(HeatMap::of_flip(width, height, &errors)?)
}

/// The pictures of a frame: noisy, denoised, and where there is a reference that and the errors against it, of which `errors` are those of the
/// denoised one.
///
/// # Errors
/// Pictures with values that are not finite.
pub fn comparison(views: &Views<'_>, errors: Option<&HeatMap>, exposure: f32) -> Result<Comparison> {
    let extent = views.extent;
    let picture = |pixels: &[[f32; 3]]| Picture::from_linear(extent[0], extent[1], pixels, exposure).map_err(PageError::from);
    let mut comparison = Comparison::new(format!("Frame {}", views.number));
    comparison.picture("noisy", &picture(&views.noisy)?)?;
    comparison.picture("denoised", &picture(&views.denoised)?)?;
    if let (Some(reference), Some(errors)) = (&views.reference, errors) {
        comparison.picture("reference", &picture(reference)?)?;
        comparison.heat_map("FLIP of noisy", &heat_map(extent, &views.noisy, reference)?)?;
        comparison.heat_map("FLIP of denoised", errors)?;
    }
    comparison.start("noisy", "denoised")?;
    Ok(comparison)
}

/// Writes the page. `conditions`: how the pictures came about, in a sentence.
///
/// # Errors
/// A file that is there or cannot be written.
pub fn write(path: &Path, existing: Existing, conditions: &str, comparison: Comparison, book: &ScoreBook) -> Result<()> {
    let mut page = Page::new("Denoised frames");
    page.introduction(conditions);
    page.section("Pictures").comparison(comparison)?;
    if !book.frames.is_empty() {
        let section = page.section("Scores");
        for (index, (name, _)) in Metrics::COLUMNS.iter().enumerate() {
            match section.curves(curves(name, index, &book.frames)) {
                // A single frame has no temporal error.
                Ok(()) | Err(PageError::NothingToPlot(_)) => {}
                Err(other) => return Err(other.into()),
            }
        }
        let table = book.table().map_err(PageError::from)?;
        section.table(&table);
    }
    let written = match existing {
        Existing::Kept => page.write_new(path),
        Existing::Replaced => page.write(path),
    };
    written.map_err(|e| match e {
        PageError::File { source, .. } => ToolError::publish(path)(source),
        other => other.into(),
    })
}

fn curves(name: &str, metric: usize, frames: &[FrameScore]) -> Curves {
    let first = frames.first().map_or(0, |score| score.frame);
    let of = |metrics: fn(&FrameScore) -> &Metrics| {
        let mut values = Vec::new();
        for score in frames {
            // Frames without a reference are gaps.
            values.resize((score.frame - first) as usize, f64::NAN);
            values.push(metrics(score).values()[metric]);
        }
        values
    };
    let curves = Curves::new(name).first_frame(first as u32);
    curves.series("denoised", of(|score| &score.denoised)).series("noisy", of(|score| &score.noisy))
}
