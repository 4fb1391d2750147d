//! Steps behind the filter: a frame is written, previewed, scored, counted.

use crate::display_transform::DisplayTransform;
use crate::error::{Result, ToolError};
use crate::exr_write::{self, Content, OutputChannels};
use crate::output_size::OutputSize;
use crate::pictures;
use crate::pipeline::{Finished, Sink};
use crate::plan::Action;
use crate::progress::Progress;
use crate::record::Record;
use crate::report;
use crate::results;
use crate::roles::Role;
use crate::score::{FrameScore, ScoreBook};
use crate::terminal;
use crate::views::Views;
use atrous::Finding;
use atrous_files::Existing;
use atrous_lab::pages::Comparison;
use atrous_lab::pictures::Picture;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// The outputs that the user wants of every frame.
#[derive(Clone, Debug)]
pub struct Wanted {
    /// Output folder.
    pub folder: PathBuf,
    /// The treatment of files that are there already.
    pub existing: Existing,
    /// Options, for the headers of the frames.
    pub record: Record,
    /// Channels of the output.
    pub channels: OutputChannels,
    /// Previews.
    pub png: bool,
    /// The frame of which a strip is made.
    pub strip: Option<u64>,
    /// The frame that the report shows.
    pub report: Option<u64>,
    /// Scores.
    pub score: bool,
    /// Exposure of pictures.
    pub exposure: f32,
    /// Name of the preset, for titles.
    pub preset: String,
    /// How light is shown.
    pub shown_as: DisplayTransform,
    /// Whether the other layers of the input are kept.
    pub keeps_layers: bool,
    /// The size of the results, where not that of the frames.
    pub size: Option<OutputSize>,
}

/// Writes frames and collects the report for the end.
pub struct Saver {
    wanted: Wanted,
    progress: Progress,
    /// Scores.
    pub book: ScoreBook,
    /// Pictures for the report.
    pub shown: Option<Comparison>,
    /// Files that were written.
    pub written: usize,
    /// Values that were not finite, by role.
    pub replaced: BTreeMap<Role, usize>,
    /// Results that were not finite.
    pub bad_results: usize,
    /// Pixels of surfaces that are brighter than the filter can take.
    pub cut: usize,
    /// Pixels with negative light.
    pub negative: usize,
    /// Frames that came through.
    pub taken: usize,
    warned: usize,
}

/// Frames with bad pixels that are named one by one; later ones are only counted.
const NAMED: usize = 8;

impl Saver {
    /// A saver that moves a progress bar.
    pub fn new(wanted: Wanted, book: ScoreBook, progress: Progress) -> Self {
        Self {
            wanted,
            progress,
            book,
            shown: None,
            written: 0,
            replaced: BTreeMap::new(),
            bad_results: 0,
            cut: 0,
            negative: 0,
            taken: 0,
            warned: 0,
        }
    }

    /// Takes the progress bar away.
    pub fn finish(&self) {
        self.progress.finish();
    }

    fn warn(&mut self, finished: &Finished) {
        let path = finished.step.files.colour.display();
        if let Some(finding) = finished.outputs.as_ref().and_then(|outputs| outputs.finding) {
            let how = if matches!(finding, Finding::HistoryLoss(_)) { ": the option --check here" } else { "" };
            self.progress.suspend(|| terminal::tell(&format!("warning: {path}: {finding}{how}")));
        }
        self.cut += finished.inputs.excess.cut;
        self.negative += finished.inputs.negative;
        for (role, count) in &finished.inputs.replaced {
            *self.replaced.entry(*role).or_default() += count;
            self.warned += 1;
            if self.warned <= NAMED {
                let became = role.stand_in().unwrap_or_default();
                let line = format!("warning: {path}: {count} pixels of {} are not finite and became {became}", role.name());
                self.progress.suspend(|| terminal::tell(&line));
            }
        }
    }

    fn pictures(&self, finished: &Finished, radiance: &[[f32; 3]]) -> Result<()> {
        let Wanted { existing, exposure, shown_as, .. } = self.wanted;
        let frame = &finished.step.output;
        let extent = finished.inputs.params.render_extent;
        let [width, height] = self.wanted.size.map_or(extent, OutputSize::result);
        if self.wanted.png {
            pictures::save(
                &results::preview(frame),
                existing,
                Picture::from_linear(width, height, &shown_as.apply(radiance), exposure),
            )?;
        }
        for (view, picture) in finished.outputs.iter().flat_map(|outputs| &outputs.views) {
            let path = results::view(frame, *view);
            let folder = path.parent().unwrap_or(&path);
            std::fs::create_dir_all(folder).map_err(ToolError::write(folder))?;
            pictures::save(&path, existing, Ok(picture.clone()))?;
        }
        Ok(())
    }

    /// Draws a frame for the strip, the report, or both.
    fn show(&mut self, finished: &Finished, radiance: &[[f32; 3]], score: Option<&FrameScore>, shown: [bool; 2]) -> Result<()> {
        let Wanted { folder, existing, preset, exposure, shown_as, .. } = &self.wanted;
        let views = Views::new(&finished.inputs, radiance, *shown_as);
        let errors = report::errors(&views)?;
        let [in_strip, in_report] = shown;
        if in_strip {
            let strip = pictures::strip(preset, &views, errors.as_ref(), score, *exposure);
            pictures::save(&results::strip(folder), *existing, strip)?;
        }
        if in_report {
            self.shown = Some(report::comparison(&views, errors.as_ref(), *exposure)?);
        }
        Ok(())
    }
}

impl Sink for Saver {
    fn take(&mut self, mut finished: Finished) -> Result<()> {
        self.warn(&finished);
        let is = |frame: Option<u64>| frame == Some(finished.inputs.number);
        let (in_strip, in_report) = (is(self.wanted.strip), is(self.wanted.report));
        let filtered = finished.outputs.as_mut().map(|o| std::mem::take(&mut o.radiance));
        let further = finished.outputs.as_mut().map(|o| std::mem::take(&mut o.further)).unwrap_or_default();
        let radiance = match (finished.step.action, filtered) {
            (Action::Write, Some(mut radiance)) => {
                self.bad_results += clean(&mut radiance);
                let Wanted { channels, existing, record, .. } = &self.wanted;
                let (frame, size) = (&finished.inputs, self.wanted.size);
                let enlarged = size.map(|size| (size.header(&frame.header), frame.alpha.as_ref().map(|a| size.enlarged(a))));
                let (header, alpha) = match &enlarged {
                    Some((header, alpha)) => (header, alpha.as_deref()),
                    None => (&frame.header, frame.alpha.as_deref()),
                };
                let kept = self.wanted.keeps_layers.then_some(finished.step.files.colour.as_path());
                let content = Content { header, names: channels, record, radiance: &radiance, alpha, further: &further, kept };
                exr_write::write(&finished.step.output, *existing, &content)?;
                self.written += 1;
                self.pictures(&finished, &radiance)?;
                radiance
            }
            // Scored and shown as it was written, which is the same as filtered anew, but for the warm-up.
            _ if self.wanted.score || in_strip || in_report => exr_write::read_back(&finished.step.output, &self.wanted.channels)?,
            _ => Vec::new(),
        };
        let score = if self.wanted.score { self.book.add(&finished.inputs, &radiance)? } else { None };
        if in_strip || in_report {
            self.show(&finished, &radiance, score.as_ref(), [in_strip, in_report])?;
        }
        self.taken += 1;
        self.progress.advance();
        Ok(())
    }
}

fn clean(radiance: &mut [[f32; 3]]) -> usize {
    let bad = radiance.iter_mut().filter(|p| p.iter().any(|v| !v.is_finite()));
    bad.map(|p| *p = [0.0; 3]).count()
}
