//! Shadow edges of the sun, filtered with all light and by a visibility of their own: error around them, width across them, with a strip.
//!
//! `cargo run --release --package atrous-measure --bin shadow_edges -- --scene hall`

use std::path::PathBuf;
use std::sync::Arc;

use ash::vk::Extent2D;
use atrous::config::Preset;
use atrous::Tuning;
use atrous_engine::{DenoiserOptions, FrameDenoiser, Gpu, GpuOptions, PathTracer, Scene, SceneOptions, TracerOptions};
use atrous_lab::pictures::{Column, Picture, Strip, TextTable};
use atrous_measure::measure::Frame;
use atrous_measure::shadows::{ShadowEdges, ShadowGuides};
use atrous_measure::Result;
use clap::Parser;

/// Measures the edges of the sun's shadows.
#[derive(Parser)]
struct Options {
    /// hall or leaves
    #[arg(long, default_value = "hall")]
    scene: String,
    /// Frames of the animation
    #[arg(long, default_value_t = 60)]
    frames: u32,
    /// Frames that are measured
    #[arg(long, value_delimiter = ',', default_value = "19,39,59")]
    measured: Vec<u32>,
    /// Paths and shadow rays for each pixel of a reference
    #[arg(long, default_value_t = 1024)]
    reference_spp: u32,
    /// Width of the picture; its height is 9/16 of that
    #[arg(long, default_value_t = 320)]
    width: u32,
    /// A number of the filter with the visibility, for example penumbra_blur=0.5
    #[arg(long = "set")]
    numbers: Vec<String>,
    /// The camera stands still
    #[arg(long)]
    static_camera: bool,
    /// Folder that references are kept in, and taken from where an earlier run left them
    #[arg(long)]
    references: Option<PathBuf>,
    /// Folder for the strips
    #[arg(long, default_value = "out")]
    out: PathBuf,
}

const PRESETS: [Preset; 2] = [Preset::Asvgf, Preset::Best];

/// A tracer with the filters of its frames.
struct Setup {
    tracer: PathTracer,
    denoisers: Vec<FrameDenoiser>,
    frames: Vec<Frame>,
    visibility: Vec<Vec<f32>>,
}

impl Setup {
    fn new(gpu: &Gpu, scene: &Arc<Scene>, options: &Options, lamps_apart: bool) -> Result<Self> {
        let extent = Extent2D { width: options.width, height: options.width * 9 / 16 };
        let tracer = PathTracer::new(gpu, scene, extent, TracerOptions { lamps_apart, ..TracerOptions::default() })?;
        let denoisers = PRESETS
            .map(|preset| {
                let mut tuning = Tuning::for_preset(preset);
                for (name, value) in options.numbers.iter().filter_map(|number| number.split_once('=')) {
                    tuning.set(name, value.parse().unwrap_or(f32::NAN))?;
                }
                FrameDenoiser::new(gpu, &tracer, &DenoiserOptions { tuning, ..DenoiserOptions::new(preset) })
            })
            .into_iter()
            .collect::<atrous_engine::Result<_>>()?;
        Ok(Self { tracer, denoisers, frames: Vec::new(), visibility: Vec::new() })
    }

    fn frame(&mut self, gpu: &Gpu, index: u32, is_measured: bool) -> Result<()> {
        self.tracer.begin_frame(index)?;
        gpu.submit(|cmd| {
            self.tracer.record_gbuffer(cmd);
            self.denoisers.iter_mut().try_for_each(|d| d.record(cmd, &mut self.tracer))
        })?;
        if is_measured {
            if let (Some(_), Some(first)) = (self.tracer.lamps_apart().first(), self.denoisers.first_mut()) {
                self.visibility.push(first.read("denoised_visibility")?.iter().map(|v| v[0]).collect());
            }
            self.frames.push(Frame::read(gpu, &self.tracer, &mut self.denoisers)?);
        }
        Ok(())
    }
}

fn main() -> Result<()> {
    let options = Options::parse();
    let gpu = Gpu::new(&GpuOptions::default())?;
    let scene =
        Arc::new(Scene::load(&options.scene, &SceneOptions { static_camera: options.static_camera, ..SceneOptions::default() })?);
    let mut setups = [Setup::new(&gpu, &scene, &options, false)?, Setup::new(&gpu, &scene, &options, true)?];
    for index in 0..options.frames {
        for setup in &mut setups {
            setup.frame(&gpu, index, options.measured.contains(&index))?;
        }
    }
    let mut rows = Rows::default();
    for i in 0..setups[1].frames.len() {
        measure(&gpu, &options, &mut setups, i, &mut rows)?;
    }
    println!("{}, {} edges in profile, {} pixels in the band\n", options.scene, rows.profiles, rows.pixels);
    println!("{}", rows.table()?);
    Ok(())
}

/// Sums over the frames that are measured.
#[derive(Default)]
struct Rows {
    rows: Vec<(String, [f64; 4])>,
    frames: f64,
    profiles: usize,
    pixels: usize,
}

impl Rows {
    fn add(&mut self, row: usize, name: String, values: [f64; 4]) {
        self.rows.resize(self.rows.len().max(row + 1), Default::default());
        self.rows[row].0 = name;
        self.rows[row].1.iter_mut().zip(values).for_each(|(sum, value)| *sum += value);
    }

    fn table(&self) -> Result<TextTable> {
        let columns =
            [Column::new("RMSE in the band", 4), Column::new("width, pixels", 2), Column::new("RMSE", 4), Column::new("SSIM", 4)];
        let mut table = TextTable::new("mean of the frames", columns);
        for (name, sums) in &self.rows {
            table.row(name.clone(), &sums.map(|sum| sum / self.frames))?;
        }
        Ok(table)
    }
}

fn measure(gpu: &Gpu, options: &Options, setups: &mut [Setup; 2], i: usize, rows: &mut Rows) -> Result<()> {
    let index = setups[1].frames[i].index;
    let tracer = &mut setups[1].tracer;
    tracer.begin_frame(index)?;
    gpu.submit(|cmd| {
        tracer.record_gbuffer(cmd);
        tracer.record_lighting(cmd);
        Ok(())
    })?;
    let [reference, visibility] = references(options, tracer)?;
    let Some(mut guides) = ShadowGuides::read(gpu, tracer, 1)? else { return Ok(()) };
    guides.visibility = visibility.iter().map(|v| v[0]).collect();
    let light = tracer.lamps_apart().first().map_or(Ok(Vec::new()), |lamp| gpu.read_image(&lamp.unshadowed_direct))?;
    let seen: Vec<_> = guides.visibility.iter().map(|v| [*v; 3]).collect();
    let edges = ShadowEdges::new(guides);
    rows.profiles += edges.profiles();
    rows.pixels += edges.band.len();
    rows.frames += 1.0;
    let [w, h] = setups[1].frames[i].extent;
    let mut strip = Strip::new(format!("{}, frame {index}", options.scene)).columns(4);
    rows.add(0, "reference".to_owned(), [0.0, width(&edges, &reference, &reference), 0.0, 1.0]);
    for (setup, kind) in setups.iter_mut().zip(["all light", "visibility apart"]) {
        let frame = &mut setup.frames[i];
        frame.reference = Some(reference.clone());
        let scores = frame.scores(None)?.unwrap_or_default();
        for (k, (preset, denoised)) in PRESETS.iter().zip(&frame.denoised).enumerate() {
            let error = edges.error(&denoised.radiance, &reference)?;
            let width = width(&edges, &denoised.radiance, &reference);
            let row = 1 + 2 * k + usize::from(kind != "all light");
            rows.add(row, format!("{}, {kind}", preset.title()), [error, width, scores[k + 1].rmse, scores[k + 1].ssim]);
            let label = format!("{}, {kind}\nband {error:.4}, width {width:.2}", preset.title());
            strip = strip.panel(label, Picture::from_linear(w, h, &denoised.radiance, 1.0)?);
        }
    }
    // What would be left if the visibility had no error: the noise of all other light.
    let (filtered, frame) = (&setups[1].visibility[i], &setups[1].frames[i]);
    for (k, (preset, denoised)) in PRESETS.iter().zip(&frame.denoised).enumerate() {
        let exact = |p: usize| [0, 1, 2].map(|c| denoised.radiance[p][c] + (seen[p][0] - filtered[p]) * light[p][c]);
        let image: Vec<_> = (0..seen.len()).map(exact).collect();
        let values = [edges.error(&image, &reference)?, width(&edges, &image, &reference), f64::NAN, f64::NAN];
        rows.add(5 + k, format!("{}, with the reference's visibility", preset.title()), values);
    }
    strip = strip.panel("reference", Picture::from_linear(w, h, &reference, 1.0)?);
    let filtered: Vec<_> = filtered.iter().map(|v| [*v; 3]).collect();
    strip = strip
        .panel("visibility, filtered", Picture::from_display(w, h, &filtered)?)
        .panel("visibility, reference", Picture::from_display(w, h, &seen)?);
    let mut band = seen.clone();
    edges.band.iter().for_each(|i| band[*i][2] *= 0.3);
    let strip = strip.panel("the band", Picture::from_display(w, h, &band)?);
    std::fs::create_dir_all(&options.out)
        .map_err(|e| atrous_engine::Error::Folder { path: options.out.clone(), problem: e.to_string() })?;
    Ok(strip.render()?.write_png(options.out.join(format!("{}_{index:04}.png", options.scene)))?)
}

/// Radiance and visibility of the tracer's frame, from a file of an earlier run or by many samples.
fn references(options: &Options, tracer: &mut PathTracer) -> Result<[Vec<[f32; 3]>; 2]> {
    let extent = tracer.extent();
    let name = format!("{}_{}x{}_{}_{}", options.scene, extent.width, extent.height, tracer.frame(), options.reference_spp);
    let file = options.references.as_ref().map(|folder| folder.join(name));
    let pixels = (extent.width * extent.height) as usize;
    if let Some(bytes) = file.as_ref().and_then(|file| std::fs::read(file).ok()).filter(|bytes| bytes.len() == 24 * pixels) {
        let texels: Vec<[f32; 3]> = bytemuck::allocation::pod_collect_to_vec(&bytes);
        return Ok([texels[..pixels].to_vec(), texels[pixels..].to_vec()]);
    }
    let radiance = tracer.render_reference(options.reference_spp, |_, _| ())?.radiance();
    let seen = tracer.lamp_reference(0, options.reference_spp)?.unwrap_or_default();
    let both = [radiance, seen];
    if let Some(file) = file {
        let problem = |e: std::io::Error| atrous_engine::Error::Folder { path: file.clone(), problem: e.to_string() };
        file.parent().map_or(Ok(()), std::fs::create_dir_all).map_err(problem)?;
        std::fs::write(&file, bytemuck::cast_slice(&both.concat())).map_err(problem)?;
    }
    Ok(both)
}

/// Nothing to measure is not a number.
fn width(edges: &ShadowEdges, image: &[[f32; 3]], reference: &[[f32; 3]]) -> f64 {
    edges.width(image, reference).map_or(f64::NAN, f64::from)
}
