//! One scene from the first frame to the tables.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use atrous::config::Preset;
use atrous_engine::{FrameDenoiser, Gpu, PathTracer, Scene};
use atrous_lab::pictures::Picture;
use atrous_measure::measure::{Frame, Scores};
use atrous_measure::running::{self, Running};
use atrous_measure::{apart, files, progress, report};

use crate::capture;
use crate::error::Result;
use crate::options::Options;

/// Renders, denoises and measures one scene, and writes what came out.
pub fn run(options: &Options, gpu: &Gpu, name: &str) -> Result<()> {
    let scene = Arc::new(Scene::load(name, &options.scene())?);
    let [width, height] = options.picture_size();
    let extent = ash::vk::Extent2D { width, height };
    let mut tracer = PathTracer::new(gpu, &scene, extent, options.tracer())?;
    let memory = memory(options, gpu, &tracer)?;
    let contender = |preset: Preset| Running::new(gpu, &tracer, preset.title(), &options.denoiser(preset)?);
    let mut contenders = options.presets().into_iter().map(contender).collect::<atrous_measure::Result<Vec<_>>>()?;
    let folder = options.out.join(&scene.name);
    files::make(&folder.join("sequence"))?;
    let captured = |name: &str| folder.join(format!("capture_{name}"));
    if options.capture {
        for c in &mut contenders {
            capture::start(&mut c.denoiser, &captured(c.name), options.frames)?;
        }
    }
    let mut measured = sequence(options, gpu, &scene.name, &mut tracer, &mut contenders, &folder)?;
    references(options, &scene.name, &mut tracer, &mut measured)?;
    if options.capture {
        for c in &mut contenders {
            capture::finish(&mut c.denoiser, &captured(c.name), &measured)?;
        }
    }
    let text = tables(options, &scene.name, &measured, &contenders, &folder)? + &memory;
    println!("\n{}\n\n{text}", scene.name);
    Ok(files::write(&folder.join("table.md"), text.as_bytes())?)
}

/// The memory of a single filter, as an engine has it: without the views of the strips, which cost some.
fn memory(options: &Options, gpu: &Gpu, tracer: &PathTracer) -> atrous_measure::Result<String> {
    let [only] = options.presets()[..] else { return Ok(String::new()) };
    let of_engine = options.denoiser(only)?.with(|config| config.debug_view = false);
    Ok(format!("{}\n", report::memory_table(&FrameDenoiser::new(gpu, tracer, &of_engine)?)?))
}

/// Renders and denoises every frame, writes them side by side, and keeps those that are measured.
fn sequence(
    options: &Options,
    gpu: &Gpu,
    name: &str,
    tracer: &mut PathTracer,
    contenders: &mut [Running],
    folder: &Path,
) -> atrous_measure::Result<Vec<Frame>> {
    if options.output_size.is_some() {
        contenders.iter().try_for_each(|c| files::make(&display_folder(folder, c)))?;
    }
    let bar = progress::bar(u64::from(options.frames), &format!("{name}: frames"));
    let kept = options.reference_frames();
    let mut measured = Vec::new();
    for index in 0..options.frames {
        running::render(gpu, tracer, contenders, index)?;
        let frame = running::read(gpu, tracer, contenders)?;
        report::write_row(&folder.join("sequence").join(format!("{index:04}.png")), &frame)?;
        if let Some([width, height]) = options.output_size {
            for c in contenders.iter_mut() {
                let display: Vec<_> = c.denoiser.read("display")?.iter().map(|&[r, g, b, _]| [r, g, b]).collect();
                let path = display_folder(folder, c).join(format!("{index:04}.png"));
                Picture::from_display(width, height, &display)?.write_png(path)?;
            }
        }
        if kept.contains(&index) || (kept.is_empty() && index + 1 == options.frames) {
            measured.push(frame);
        }
        bar.inc(1);
    }
    bar.finish();
    Ok(measured)
}

/// The folder of the pictures that have the size of the output.
fn display_folder(folder: &Path, of: &Running) -> PathBuf {
    folder.join(format!("display_{}", of.denoiser.preset()))
}

fn references(options: &Options, name: &str, tracer: &mut PathTracer, measured: &mut [Frame]) -> atrous_measure::Result<()> {
    if options.reference_spp == 0 {
        return Ok(());
    }
    let total = u64::from(options.reference_spp) * measured.len() as u64;
    let bar = progress::bar(total, &format!("{name}: references"));
    for (i, frame) in measured.iter_mut().enumerate() {
        tracer.begin_frame(frame.index)?;
        let before = i as u64 * u64::from(options.reference_spp);
        let reference = tracer.render_reference(options.reference_spp, |done, _| bar.set_position(before + u64::from(done)))?;
        frame.set_reference(reference);
        frame.read_references_apart(tracer, options.reference_spp)?;
    }
    bar.finish();
    Ok(())
}

/// Writes the strips, and gives the text of all tables.
fn tables(
    options: &Options,
    scene: &str,
    measured: &[Frame],
    contenders: &[Running],
    folder: &Path,
) -> atrous_measure::Result<String> {
    let names: Vec<_> = contenders.iter().map(|c| c.name).collect();
    let by_index: BTreeMap<u32, &Frame> = measured.iter().map(|f| (f.index, f)).collect();
    let mut scored: Vec<(u32, Vec<Scores>)> = Vec::new();
    for frame in measured {
        let previous = frame.index.checked_sub(1).and_then(|i| by_index.get(&i).copied());
        let scores = frame.scores(previous)?;
        let path = folder.join(format!("strip_{:04}.png", frame.index));
        report::write_strip(&path, scene, frame, &names, scores.as_deref())?;
        scored.extend(scores.map(|s| (frame.index, s)));
    }
    let mut text = String::new();
    if !scored.is_empty() {
        text += &score_tables(options, scene, &scored, contenders)?;
    }
    text += &signals_apart(scene, measured, &names, folder)?;
    if let [only] = contenders {
        if let Some(means) = only.times.means() {
            text += &format!("{}\n\n", report::time_table(&means)?);
        }
    }
    Ok(text)
}

/// The same of the volume, of shadows and of ambient occlusion by themselves, where the scene has them.
fn signals_apart(scene: &str, measured: &[Frame], names: &[&str], folder: &Path) -> atrous_measure::Result<String> {
    let mut text = String::new();
    let mut errors: BTreeMap<&str, Vec<(u32, Vec<f64>)>> = BTreeMap::new();
    for frame in measured {
        let composites: Vec<_> = frame.denoised.iter().map(|d| &d.radiance[..]).collect();
        for signal in frame.volume.iter().chain(&frame.shadows) {
            let file = format!("{}_{:04}.png", signal.name.replace(' ', "_"), frame.index);
            let title = format!("{scene}, {}, frame {}", signal.name, frame.index);
            apart::write_strip(&folder.join(file), &title, signal, names, &composites)?;
            errors.entry(&signal.name).or_default().extend(signal.errors()?.map(|e| (frame.index, e)));
        }
    }
    let names: Vec<_> = ["noisy"].iter().chain(names).copied().collect();
    for (signal, errors) in errors.iter().filter(|(_, errors)| !errors.is_empty()) {
        text += &format!("{}\n\n", apart::error_table(signal, &names, errors)?);
    }
    Ok(text)
}

fn score_tables(
    options: &Options,
    scene: &str,
    scored: &[(u32, Vec<Scores>)],
    contenders: &[Running],
) -> atrous_measure::Result<String> {
    let of = |i: usize| report::mean(&scored.iter().map(|(_, scores)| scores[i]).collect::<Vec<_>>());
    let mut names = vec!["noisy"];
    let mut rows = vec![(format!("{scene}, noisy"), of(0), f64::NAN)];
    for (i, contender) in contenders.iter().enumerate() {
        names.push(contender.name);
        rows.push((format!("{scene}, {}", contender.name), of(i + 1), contender.times.of_a_frame()));
    }
    let frames: Vec<_> = scored.iter().map(|(index, _)| index.to_string()).collect();
    Ok(format!(
        "{}\nmean of frames {}; reference: {} paths per pixel\n\n{}\n",
        report::score_table(&rows)?,
        frames.join(", "),
        options.reference_spp,
        report::frame_table(&names, scored)?
    ))
}
