//! One scene from the first frame to the tables.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use atrous_demo::measure::{Frame, Scores};
use atrous_demo::{report, Error, FrameDenoiser, Gpu, PathTracer, Result, Scene};
use indicatif::{ProgressBar, ProgressStyle};

use crate::options::Options;

/// Renders, denoises and measures one scene, and writes what came out.
pub fn run(options: &Options, gpu: &Gpu, name: &str) -> Result<()> {
    let scene = Arc::new(Scene::load(name, &options.scene())?);
    let extent = ash::vk::Extent2D { width: options.size.0, height: options.size.1 };
    let mut tracer = PathTracer::new(gpu, &scene, extent, options.tracer())?;
    let mut denoiser = FrameDenoiser::new(gpu, &tracer, &options.denoiser()?)?;
    let folder = options.out.join(&scene.name);
    make(&folder.join("sequence"))?;
    let mut times = Times::default();
    let mut measured = sequence(options, gpu, &scene.name, &mut tracer, &mut denoiser, &folder, &mut times)?;
    references(options, &scene.name, &mut tracer, &mut measured)?;
    tables(options, &scene.name, &measured, &denoiser, &times, &folder)
}

/// GPU time of each pass, summed over frames.
#[derive(Default)]
struct Times {
    passes: Vec<(&'static str, f64)>,
    frames: u32,
}

impl Times {
    fn add(&mut self, denoiser: &FrameDenoiser) {
        let times = denoiser.times();
        if times.is_empty() {
            return;
        }
        self.passes.resize(times.len(), ("", 0.0));
        for (sum, time) in self.passes.iter_mut().zip(&times) {
            *sum = (time.name, sum.1 + time.milliseconds);
        }
        self.frames += 1;
    }

    fn means(&self) -> Vec<(&'static str, f64)> {
        self.passes.iter().map(|(name, sum)| (*name, sum / f64::from(self.frames))).collect()
    }
}

/// Renders and denoises every frame, writes them as pairs, and keeps those that are measured.
fn sequence(
    options: &Options,
    gpu: &Gpu,
    name: &str,
    tracer: &mut PathTracer,
    denoiser: &mut FrameDenoiser,
    folder: &Path,
    times: &mut Times,
) -> Result<Vec<Frame>> {
    let bar = progress(u64::from(options.frames), &format!("{name}: frames"));
    let kept = options.reference_frames();
    let mut measured = Vec::new();
    for index in 0..options.frames {
        tracer.begin_frame(index)?;
        denoiser.render(tracer)?;
        // The first frames of a device compile shaders.
        if index >= 2 {
            times.add(denoiser);
        }
        let frame = Frame::read(gpu, tracer, denoiser)?;
        report::write_pair(&folder.join("sequence").join(format!("{index:04}.png")), &frame)?;
        if kept.contains(&index) || (kept.is_empty() && index + 1 == options.frames) {
            measured.push(frame);
        }
        bar.inc(1);
    }
    bar.finish();
    Ok(measured)
}

fn references(options: &Options, name: &str, tracer: &mut PathTracer, measured: &mut [Frame]) -> Result<()> {
    if options.reference_spp == 0 {
        return Ok(());
    }
    let total = u64::from(options.reference_spp) * measured.len() as u64;
    let bar = progress(total, &format!("{name}: references"));
    for (i, frame) in measured.iter_mut().enumerate() {
        tracer.begin_frame(frame.index)?;
        let before = i as u64 * u64::from(options.reference_spp);
        let reference = tracer.render_reference(options.reference_spp, |done, _| bar.set_position(before + u64::from(done)))?;
        let sum = |i: usize| [0, 1, 2].map(|c| reference.direct[i][c] + reference.indirect[i][c] + reference.emission[i][c]);
        frame.reference = Some((0..reference.direct.len()).map(sum).collect());
    }
    bar.finish();
    Ok(())
}

fn tables(options: &Options, name: &str, measured: &[Frame], denoiser: &FrameDenoiser, times: &Times, folder: &Path) -> Result<()> {
    let by_index: BTreeMap<u32, &Frame> = measured.iter().map(|f| (f.index, f)).collect();
    let (mut noisy, mut denoised): (Vec<Scores>, Vec<Scores>) = (Vec::new(), Vec::new());
    for frame in measured {
        let previous = frame.index.checked_sub(1).and_then(|i| by_index.get(&i).copied());
        let scores = frame.scores(previous)?;
        if let Some([n, d]) = scores {
            noisy.push(n);
            denoised.push(d);
        }
        report::write_strip(&folder.join(format!("strip_{:04}.png", frame.index)), name, frame, scores)?;
    }
    let mut text = String::new();
    if !noisy.is_empty() {
        let rows = [(format!("{name}, noisy"), report::mean(&noisy)), (format!("{name}, svgf"), report::mean(&denoised))];
        let frames: Vec<_> = measured.iter().map(|f| f.index.to_string()).collect();
        text += &format!(
            "{}\nmean of frames {}; reference: {} paths per pixel\n\n",
            report::score_table(&rows)?,
            frames.join(", "),
            options.reference_spp
        );
    }
    if !times.passes.is_empty() {
        text += &format!("{}\n\n", report::time_table(&times.means())?);
    }
    text += &format!("{}\n", report::memory_table(denoiser)?);
    println!("\n{name}\n\n{text}");
    let path = folder.join("table.md");
    fs::write(&path, text).map_err(|e| Error::Folder { path, problem: e.to_string() })
}

fn make(folder: &PathBuf) -> Result<()> {
    fs::create_dir_all(folder).map_err(|e| Error::Folder { path: folder.clone(), problem: e.to_string() })
}

fn progress(length: u64, what: &str) -> ProgressBar {
    let bar = ProgressBar::new(length).with_message(what.to_owned());
    if let Ok(style) = ProgressStyle::with_template("{msg:24} [{bar:40}] {pos}/{len} {elapsed} (eta {eta})") {
        bar.set_style(style);
    }
    bar
}
