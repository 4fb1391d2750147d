//! Runs the points on the frames of a sequence, in turn, and measures time and error.

use super::filters::Filter;
use atrous::config::{Preset, Signals};
use atrous::executor::HeadlessDevice;
use atrous::Config;
use atrous_denoise::backend::Passes;
use atrous_denoise::frame::{self, FrameInputs};
use atrous_denoise::frame_files::{self, FrameFiles};
use atrous_denoise::score::{Metrics, ScoreBook};
use atrous_denoise::setup::{Options, Setup};
use atrous_options::ConfigArgs;
use cpu_time::ProcessTime;
use indicatif::{ProgressBar, ProgressStyle};
use serde::{Deserialize, Serialize};
use std::error::Error;
use std::path::Path;
use std::sync::Arc;

/// Frames of a sequence.
pub struct Frames<'a> {
    pub path: &'a Path,
    pub run: Option<u32>,
    pub scored: u32,
}

/// Points of a sequence.
#[derive(Serialize, Deserialize)]
pub struct Sequence {
    pub name: String,
    pub device: String,
    pub points: Vec<Point>,
    /// Scores of what was filtered.
    pub noisy: [f64; 4],
    pub extent: [u32; 2],
    pub frames: usize,
    pub scored: u32,
}

/// What a filter takes, and what it leaves.
#[derive(Clone, Serialize, Deserialize)]
pub struct Point {
    pub name: String,
    /// Name of its preset.
    pub group: String,
    /// CPU time of a frame, milliseconds: the median.
    pub ms: f64,
    /// The same over that of [`UNIT`] in the same frame: the median of the ratios, which leaves out how fast the machine was in turn.
    pub price: f64,
    /// In the order of [`COLUMNS`]; lower is better.
    pub errors: [f64; 4],
}

/// The point that prices are multiples of; the first point where it is not run.
pub const UNIT: &str = Preset::Svgf.name();

/// What is measured, and decimals in the table.
pub const COLUMNS: [(&str, usize); 4] = [("RMSE", 4), ("1 - SSIM", 4), ("FLIP", 4), ("temporal error", 5)];

/// Frames whose time does not count: shaders are compiled at their first dispatch, and gradients start with the second frame.
const WARM_UP: usize = 3;

struct Running<'f> {
    filter: &'f Filter,
    passes: Passes,
    times: Vec<f64>,
    book: ScoreBook,
}

impl Frames<'_> {
    pub fn measure(&self, gpu: &Arc<HeadlessDevice>, filters: &[Filter]) -> Result<Sequence, Box<dyn Error>> {
        let mut files = frame_files::find(&[self.path.to_owned()])?;
        files.truncate(self.run.map_or(usize::MAX, |run| run as usize));
        if files.len() <= WARM_UP {
            return Err(format!("{} has {} frames; {} or more are needed", self.path.display(), files.len(), WARM_UP + 1).into());
        }
        let setup = self.setup(&files)?;
        let start = |filter| -> Result<Running<'_>, Box<dyn Error>> {
            let passes = Passes::of(gpu.clone(), Filter::declare(filter, &setup.config)?)?;
            Ok(Running {
                filter,
                passes,
                times: Vec::new(),
                book: ScoreBook::new(setup.config.conventions, setup.shown, setup.step),
            })
        };
        let mut running = filters.iter().map(start).collect::<Result<Vec<_>, _>>()?;
        let first_scored = files.len().saturating_sub(self.scored as usize);
        let style = ProgressStyle::with_template("{msg} {bar:32} {pos}/{len} frames, {eta} left")?;
        let bar = ProgressBar::new(files.len() as u64).with_style(style).with_message(self.name());
        for (i, files) in files.iter().enumerate() {
            let mut inputs = frame::load(files, &setup)?;
            // There and back again, so that what grows or falls during a frame hits all alike.
            let order: Vec<usize> = if i % 2 == 0 { (0..running.len()).collect() } else { (0..running.len()).rev().collect() };
            for filter in order {
                running[filter].frame(&mut inputs, i >= WARM_UP, i >= first_scored)?;
            }
            bar.inc(1);
        }
        bar.finish();
        let noisy = running.first().map_or([f64::NAN; 4], |running| errors(&running.book.means().1));
        let unit = running.iter().find(|running| running.filter.name == UNIT).or(running.first());
        let unit = unit.map_or(Vec::new(), |unit| unit.times.clone());
        let points = running.iter().map(|running| running.point(&unit)).collect();
        let extent = setup.config.allocated_extent;
        Ok(Sequence {
            name: self.name(),
            device: gpu.name().to_owned(),
            points,
            noisy,
            extent,
            frames: files.len(),
            scored: self.scored,
        })
    }

    /// One signal, so that all points filter the same; with whatever gradients can be made of.
    fn setup(&self, files: &[FrameFiles]) -> Result<Setup, Box<dyn Error>> {
        let config = ConfigArgs::of("signals", Signals::Together.name());
        let mut setup = Setup::new(files, &Options { preset: Some(Preset::Best), config, ..Options::default() })?;
        if setup.config.volume || setup.config.visibility > 0 {
            return Err(
                format!("{} has a volume or a light apart, and the points filter surfaces alone", self.path.display()).into()
            );
        }
        setup.config = Config { levels: None, firefly_filter: false, ..setup.config };
        Ok(setup)
    }

    fn name(&self) -> String {
        let name = self.path.file_name().unwrap_or(self.path.as_os_str());
        name.to_string_lossy().into_owned()
    }
}

impl Running<'_> {
    fn frame(&mut self, inputs: &mut FrameInputs, is_timed: bool, is_scored: bool) -> Result<(), Box<dyn Error>> {
        inputs.tuning = self.filter.tuning();
        self.passes.upload(inputs)?;
        let start = ProcessTime::now();
        self.passes.run(inputs)?;
        if is_timed {
            self.times.push(start.elapsed().as_secs_f64() * 1e3);
        }
        if is_scored {
            let radiance = self.passes.radiance(inputs)?;
            self.book.add(inputs, &radiance)?;
        }
        Ok(())
    }

    fn point(&self, unit: &[f64]) -> Point {
        Point {
            name: self.filter.name.clone(),
            group: self.filter.preset.name().to_owned(),
            ms: median(self.times.iter().copied()),
            price: median(self.times.iter().zip(unit).map(|(time, unit)| time / unit)),
            errors: errors(&self.book.means().0),
        }
    }
}

fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut sorted: Vec<f64> = values.collect();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(f64::NAN)
}

fn errors(metrics: &Metrics) -> [f64; 4] {
    [metrics.rmse, 1.0 - metrics.ssim, metrics.flip, metrics.temporal_error.unwrap_or(f64::NAN)]
}
