//! The run from options to the last line printed.

use crate::backend::{Backend, Passes};
use crate::check;
use crate::cli::Cli;
use crate::error::{Result, ToolError};
use crate::exr_write::{self, output_channels};
use crate::first_look;
use crate::frame_files::{self, Found, FrameFiles};
use crate::memory::{self, fitting_queue, Demands};
use crate::pictures;
use crate::pipeline;
use crate::plan::{self, Action, Step};
use crate::progress::Progress;
use crate::record::Record;
use crate::report;
use crate::results::{self, Expected, Extras};
use crate::roles::Role;
use crate::saver::{Saver, Wanted};
use crate::score::{self, ScoreBook};
use crate::setup::Setup;
use crate::terminal::tell;
use atrous::{Config, Tuning};
use atrous_files::Existing;
use std::time::Instant;

/// Runs the tool with its options.
pub fn run(cli: &Cli) -> Result<()> {
    if cli.step == Some(0) {
        return Err(ToolError::Usage("--step is 0; it must be at least 1".into()));
    }
    let step = cli.step.unwrap_or(1);
    let Found { mut frames, unused } = frame_files::search(&cli.frames, step)?;
    if let Some(folder) = &cli.guides {
        let guides = frame_files::search(std::slice::from_ref(folder), step)?.frames;
        frames = FrameFiles::with_guides(frames, guides, folder)?;
    }
    let mut setup = Setup::new(&frames, &cli.options())?;
    let first = frames[0].colour.clone();
    if cli.check {
        fitting_queue(&first, &setup, &Demands { frames: 2, ..Demands::default() }, memory::free())?;
        introduce(cli, &setup, &frames, &unused);
        return check::print(&check::run(&frames, &setup)?, &check::declared(&setup));
    }
    // Before the first frames are read: what is found in them makes no picture smaller.
    let scored = cli.score || (cli.report.is_some() && setup.mapping.has(Role::Reference));
    fitting_queue(&first, &setup, &demands(cli, &setup, [frames.len(); 2], scored), memory::free())?;
    let warnings = first_look::take(&frames, &mut setup)?;
    introduce(cli, &setup, &frames, &unused);
    warnings.iter().for_each(|warning| tell(&format!("warning: {warning}")));
    let wanted = wanted(cli, &setup, &frames)?;
    let steps = plan(cli, &setup, frames, &wanted)?;
    let queue = fitting_queue(
        &first,
        &setup,
        &demands(cli, &setup, [steps.len(), steps.iter().filter(|step| step.action != Action::Read).count()], wanted.score),
        memory::free(),
    )?;
    exr_write::prepare_folder(cli.output())?;
    if cli.resume {
        atrous_files::remove_abandoned(cli.output());
    }
    if steps.is_empty() {
        tell("all frames are finished");
        return Ok(());
    }
    let mut backend = open(cli, &setup)?;
    let device = backend.name();
    if !cli.quiet {
        tell(&format!("{} on {device}", setup.config.preset.title()));
    }
    let existing = wanted.existing;
    let mut saver = Saver::new(
        wanted,
        ScoreBook::new(setup.config.conventions, setup.shown, setup.step),
        Progress::new(steps.len(), cli.quiet),
    );
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

/// Says what is read.
fn introduce(cli: &Cli, setup: &Setup, frames: &[FrameFiles], unused: &[String]) {
    if cli.quiet {
        return;
    }
    let [w, h] = setup.config.allocated_extent;
    tell(&format!("{} frames of {w}x{h} pixels, first {}", frames.len(), frames[0].colour.display()));
    setup.report.iter().for_each(|line| tell(line));
    if !unused.is_empty() {
        tell(&format!("  not used: files {}", unused.join(", ")));
    }
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
        record: Record::new(setup, &cli.options())?,
        channels: output_channels(&setup.mapping, &setup.header, !cli.float),
        png: cli.png,
        strip,
        report,
        // Curves are of all frames.
        score: cli.score || (report.is_some() && setup.mapping.has(Role::Reference)),
        exposure: cli.exposure,
        preset: setup.config.preset.title().into(),
        shown_as: setup.shown,
        keeps_layers: cli.keep_layers,
        size: setup.output_size(),
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
    let expected = Expected {
        display: setup.output_size().map_or(setup.header.shared.display_window.size, |size| size.window().size),
        channels: wanted.channels.clone(),
        record: wanted.record.clone(),
    };
    plan::plan(frames, cli.output(), &expected, existing)
}

/// Frames after which what was before them weighs less than 0.1 % of a history.
fn remembered_frames(tuning: &Tuning) -> usize {
    let kept_by_a_frame = 1.0 - tuning.alpha.max(1.0 / tuning.max_history_length);
    (0.001f32.ln() / kept_by_a_frame.ln()).ceil() as usize
}

/// The demands on memory of so many frames, of which so many are filtered.
fn demands(cli: &Cli, setup: &Setup, [frames, filtered]: [usize; 2], scored: bool) -> Demands {
    Demands {
        frames,
        filtered: filtered > 0,
        reference: cli.is_reference(),
        score: scored,
        pictures: cli.png || cli.strip.is_some() || cli.report.is_some(),
        views: cli.views,
        kept: if cli.keep_layers { setup.header.channels.len() } else { 0 },
    }
}

fn open(cli: &Cli, setup: &Setup) -> Result<Passes> {
    let config = Config { debug_view: cli.views, ..setup.config };
    match cli.device.as_deref() {
        Some("reference") => Passes::reference(&config),
        _ => Passes::gpu(cli.device.clone(), &config),
    }
}

fn summary(cli: &Cli, saver: &Saver, seconds: f64, steps: usize) {
    for (role, count) in &saver.replaced {
        let became = role.stand_in().unwrap_or_default();
        tell(&format!("warning: {count} pixels of {} were not finite in all frames together and became {became}", role.name()));
    }
    if saver.negative > 0 {
        tell(&format!(
            "note: {} pixels of light are negative in all frames together; the pixels beside were darkened by as much",
            saver.negative
        ));
    }
    if saver.cut > 0 {
        tell(&format!(
            "warning: {} pixels are brighter than the filter can take beside the rest of the picture (radiance above 65504 after its scale), and were cut",
            saver.cut
        ));
    }
    if saver.bad_results > 0 {
        tell(&format!("warning: {} denoised pixels were not finite and became 0; please report this sequence", saver.bad_results));
    }
    if !cli.quiet {
        let rate = saver.taken as f64 / seconds.max(1e-9);
        tell(&format!(
            "{} of {steps} frames in {seconds:.1} s ({rate:.1} frames/s), {} written to {}",
            saver.taken,
            saver.written,
            cli.output().display()
        ));
    }
}

fn scores(cli: &Cli, preset: &str, existing: Existing, book: &ScoreBook, device: &str) -> Result<()> {
    if book.frames.is_empty() {
        tell("no frame has a reference: nothing was scored");
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
