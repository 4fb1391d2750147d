//! Memory does not grow with the number of frames. A program of its own: what other tests allocate would count.

#[allow(dead_code)] // the tests of the tool use the rest
mod samples;

use atrous_denoise::backend::{Backend, FrameOutputs};
use atrous_denoise::error::Result;
use atrous_denoise::exr_write::output_channels;
use atrous_denoise::frame::FrameInputs;
use atrous_denoise::frame_files;
use atrous_denoise::memory;
use atrous_denoise::pipeline::{self, Finished, Sink};
use atrous_denoise::plan;
use atrous_denoise::progress::Progress;
use atrous_denoise::record::Record;
use atrous_denoise::results::Expected;
use atrous_denoise::saver::{Saver, Wanted};
use atrous_denoise::score::ScoreBook;
use atrous_denoise::setup::{Options, Setup};
use atrous_files::Existing;

/// Gives the input back.
struct Copy;

impl Backend for Copy {
    fn name(&self) -> String {
        "copy".into()
    }

    fn denoise(&mut self, frame: &FrameInputs, _: bool) -> Result<FrameOutputs> {
        Ok(FrameOutputs { radiance: frame.noisy.clone(), ..FrameOutputs::default() })
    }
}

/// Looks at the resident memory on the way.
struct Watched {
    saver: Saver,
    resident: Vec<u64>,
}

impl Sink for Watched {
    fn take(&mut self, finished: Finished) -> Result<()> {
        let output = finished.step.output.clone();
        self.saver.take(finished)?;
        let _ = std::fs::remove_file(output);
        self.resident.push(resident_bytes());
        Ok(())
    }
}

fn resident_bytes() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|l| l.strip_prefix("VmRSS:"));
    line.and_then(|l| l.trim().trim_end_matches("kB").trim().parse::<u64>().ok()).unwrap_or_default() * 1024
}

#[cfg(target_os = "linux")]
#[test]
fn a_thousand_frames_take_no_more_memory_than_a_hundred() {
    let (input, output) = (tempfile::tempdir().expect("a temporary folder"), tempfile::tempdir().expect("a temporary folder"));
    let first = samples::frame_path(input.path(), 0);
    let wide = samples::Sample { display: samples::bounds(0, 0, 64, 36), data: samples::bounds(0, 0, 64, 36), ..samples::frame(0) };
    wide.write(&first);
    for number in 1..1000 {
        std::fs::hard_link(&first, samples::frame_path(input.path(), number)).expect("a link");
    }
    let frames = frame_files::find(&[input.path().to_owned()]).expect("frames");
    let setup = Setup::new(&frames, &Options::default()).expect("a layout");
    assert_eq!(setup.config.allocated_extent, [64, 36]);
    let (record, channels) = (Record::default(), output_channels(&setup.mapping, &setup.header, true));
    let expected = Expected { display: exr::prelude::Vec2(64, 36), channels: channels.clone(), record: record.clone() };
    let steps = plan::plan(frames, output.path(), &expected, plan::Existing::default()).expect("a plan");
    let wanted = Wanted {
        folder: output.path().to_owned(),
        existing: Existing::Kept,
        record,
        channels,
        png: false,
        strip: None,
        report: None,
        score: true,
        exposure: 1.0,
        preset: "copy".into(),
        shown_as: setup.shown,
        keeps_layers: false,
        size: None,
    };
    let saver = Saver::new(wanted, ScoreBook::new(setup.config.conventions, setup.shown, 1), Progress::new(steps.len(), true));
    let mut sink = Watched { saver, resident: Vec::new() };
    // Where none may wait, frames pass as well.
    pipeline::run(&steps[..20], &setup, &mut Copy, false, 0, &mut sink).expect("a run");
    pipeline::run(&steps, &setup, &mut Copy, false, memory::QUEUE, &mut sink).expect("a run");
    assert_eq!((sink.saver.written, sink.saver.book.frames.len()), (1020, 1020));
    // What a metric computes with comes and goes: the smallest value of each hundred frames is taken.
    let least: Vec<u64> = sink.resident.chunks(100).map(|c| c.iter().copied().min().unwrap_or_default()).collect();
    let grown = least[9].saturating_sub(least[1]);
    // A frame is 0.7 MiB in memory; 800 leaked ones would be 560 MiB.
    assert!(grown < 24 << 20, "resident memory grew by {} KiB: {least:?}", grown >> 10);
}
