//! The run from options to the last line printed.

use crate::backend::{Backend, Passes};
use crate::check;
use crate::cli::Cli;
use crate::error::{Result, ToolError};
use crate::exr_write;
use crate::frame_files::{self, FrameFiles};
use crate::memory::{self, fitting_queue, Demands};
use crate::pictures;
use crate::pipeline;
use crate::plan::{self, Action, Step};
use crate::record::Record;
use crate::report;
use crate::results::{self, Expected, Extras};
use crate::roles::Role;
use crate::saver::{output_channels, Saver, Wanted};
use crate::score::{self, ScoreBook};
use crate::setup::Setup;
use atrous::{Config, Tuning};
use atrous_files::Existing;
use indicatif::{ProgressBar, ProgressStyle};
use std::time::Instant;

/// Runs the tool with its options.
pub fn run(cli: &Cli) -> Result<()> {
    let frames = frame_files::find(&cli.frames)?;
    let setup = Setup::new(&frames, &cli.options())?;
    if !cli.quiet {
        let [w, h] = setup.config.allocated_extent;
        eprintln!("{} frames of {w}x{h} pixels, first {}", frames.len(), frames[0].colour.display());
        setup.report.iter().for_each(|line| eprintln!("{line}"));
    }
    let first = frames[0].colour.clone();
    if cli.check {
        fitting_queue(&first, &setup, &Demands { frames: 2, ..Demands::default() }, memory::free())?;
        return check::print(&check::run(&frames, &setup)?);
    }
    let wanted = wanted(cli, &setup, &frames)?;
    let steps = plan(cli, &setup, frames, &wanted)?;
    let queue = fitting_queue(&first, &setup, &demands(cli, &steps, wanted.score), memory::free())?;
    exr_write::prepare_folder(cli.output())?;
    if steps.is_empty() {
        eprintln!("all frames are finished");
        return Ok(());
    }
    let mut backend = open(cli, &setup)?;
    let device = backend.name();
    if !cli.quiet {
        eprintln!("{} on {device}", setup.config.preset.title());
    }
    let existing = wanted.existing;
    let mut saver = Saver::new(wanted, ScoreBook::new(setup.config.conventions), progress(cli, &steps));
    let start = Instant::now();
    let result = pipeline::run(&steps, &setup, &mut backend, cli.views, queue, &mut saver);
    saver.finish();
    // What is finished is told even where the run failed.
    summary(cli, &saver, start.elapsed().as_secs_f64(), steps.len());
    result?;
    if cli.score {
        scores(cli, setup.config.preset.title(), existing, &saver.book, &device)?;
    }
    if let Some(shown) = saver.shown.take() {
        let [w, h] = setup.config.allocated_extent;
        let conditions = format!("{}, {w}x{h} pixels, on {device}.", setup.config.preset.title());
        report::write(&results::report(cli.output()), existing, &conditions, shown, &saver.book)?;
    }
    Ok(())
}

/// The outputs that the options ask for.
fn wanted(cli: &Cli, setup: &Setup, frames: &[FrameFiles]) -> Result<Wanted> {
    if cli.score && !setup.mapping.has(Role::Reference) {
        return Err(ToolError::Usage(
            "--score needs a reference; name its channels with --channel reference=LAYER, or leave --score out".into(),
        ));
    }
    if !(cli.exposure.is_finite() && cli.exposure > 0.0) {
        return Err(ToolError::Usage(format!("--exposure is {}; it must be above 0", cli.exposure)));
    }
    let [first, last] = [frames.first(), frames.last()].map(|f| f.map_or(0, |f| f.number));
    let shown = |option: &str, frame: Option<Option<u64>>| {
        let frame = frame.map(|frame| frame.unwrap_or(last));
        match frame.filter(|frame| frames.iter().all(|f| f.number != *frame)) {
            None => Ok(frame),
            Some(absent) => {
                let problem = format!("{option} {absent}: there is no such frame; the frames are {first} to {last}");
                Err(ToolError::Usage(problem))
            }
        }
    };
    let (strip, report) = (shown("--strip", cli.strip)?, shown("--report", cli.report)?);
    Ok(Wanted {
        folder: cli.output().to_owned(),
        existing: if cli.force || cli.resume { Existing::Replaced } else { Existing::Kept },
        record: Record::new(setup, cli)?,
        channels: output_channels(&setup.mapping, !cli.float),
        png: cli.png,
        strip,
        report,
        // Curves are of all frames.
        score: cli.score || (report.is_some() && setup.mapping.has(Role::Reference)),
        exposure: cli.exposure,
        preset: setup.config.preset.title().into(),
    })
}

fn plan(cli: &Cli, setup: &Setup, frames: Vec<FrameFiles>, wanted: &Wanted) -> Result<Vec<Step>> {
    let tuning = setup.tuning(frames.first().map_or(0, |frame| frame.number))?;
    let Cli { png, views, score, strip, report, .. } = *cli;
    let extras = Extras { png, views, strip: strip.is_some(), report: report.is_some(), score };
    let existing = plan::Existing {
        force: cli.force,
        resume: cli.resume,
        warm_up: cli.warm_up.unwrap_or_else(|| remembered_frames(&tuning)),
        extras,
        scored: wanted.score,
        shown: [wanted.strip, wanted.report],
    };
    let expected =
        Expected { extent: setup.config.allocated_extent, channels: wanted.channels.clone(), record: wanted.record.clone() };
    plan::plan(frames, cli.output(), &expected, existing)
}

/// Frames after which what was before them weighs less than 0.1 % of a history.
fn remembered_frames(tuning: &Tuning) -> usize {
    let kept_by_a_frame = 1.0 - tuning.alpha.max(1.0 / tuning.max_history_length);
    (0.001f32.ln() / kept_by_a_frame.ln()).ceil() as usize
}

fn demands(cli: &Cli, steps: &[Step], scored: bool) -> Demands {
    Demands {
        frames: steps.len(),
        filtered: steps.iter().any(|step| step.action != Action::Read),
        reference: cli.device.as_deref() == Some("reference"),
        score: scored,
        pictures: cli.png || cli.strip.is_some() || cli.report.is_some(),
        views: cli.views,
    }
}

fn open(cli: &Cli, setup: &Setup) -> Result<Passes> {
    let config = Config { debug_view: cli.views, ..setup.config };
    match cli.device.as_deref() {
        Some("reference") => Passes::reference(&config),
        _ => Passes::gpu(cli.device.clone(), &config),
    }
}

/// The progress bar on stderr, hidden where that is no terminal.
fn progress(cli: &Cli, steps: &[Step]) -> ProgressBar {
    if cli.quiet {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template("{bar:32} {pos}/{len} frames, {per_sec}, {eta} left");
    ProgressBar::new(steps.len() as u64).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

fn summary(cli: &Cli, saver: &Saver, seconds: f64, steps: usize) {
    for (role, count) in &saver.replaced {
        eprintln!("warning: {count} pixels of {} were not finite in all frames together and became 0", role.name());
    }
    if saver.bad_results > 0 {
        eprintln!("warning: {} denoised pixels were not finite and became 0; please report this sequence", saver.bad_results);
    }
    if !cli.quiet {
        let rate = saver.taken as f64 / seconds.max(1e-9);
        eprintln!(
            "{} of {steps} frames in {seconds:.1} s ({rate:.1} frames/s), {} written to {}",
            saver.taken,
            saver.written,
            cli.output().display()
        );
    }
}

fn scores(cli: &Cli, preset: &str, existing: Existing, book: &ScoreBook, device: &str) -> Result<()> {
    if book.frames.is_empty() {
        eprintln!("no frame has a reference: nothing was scored");
        return Ok(());
    }
    let table = book.table().map_err(|e| ToolError::Usage(e.to_string()))?;
    print!("{table}");
    if book.without_reference > 0 {
        println!("{} frames have no reference and are not in the table", book.without_reference);
    }
    let [json, plots] = results::scores(cli.output());
    score::write_json(&json, existing, &book.json(preset, device))?;
    pictures::save(&plots, existing, pictures::plots(book, preset))
}

#[cfg(test)]
mod tests {
    use super::*;
    use atrous::config::Preset;

    #[test]
    fn a_resumed_run_remembers_what_the_history_does() {
        let of = |preset| remembered_frames(&Tuning::for_preset(preset));
        assert_eq!((of(Preset::Svgf), of(Preset::Best)), (31, 66));
        let with = |alpha, max_history_length| remembered_frames(&Tuning { alpha, max_history_length, ..Tuning::default() });
        assert_eq!((with(1.0, 256.0), with(0.0, 1.0)), (0, 0));
        // A running mean of 16 frames.
        assert_eq!(with(0.0, 16.0), 108);
    }
}
