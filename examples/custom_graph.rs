//! A graph of a host's own: accumulation, variance and modulation of the crate around a spatial filter of the host, which is a compute shader
//! with a function for the CPU beside it. Run on the GPU, and checked against the CPU engine: `cargo run --example custom_graph`.

use atrous::config::Preset;
use atrous::executor::{HeadlessDevice, HeadlessOptions, Session, SessionOptions, Validation};
use atrous::graph::{Feedback, Graph, Irradiance, Stage};
use atrous::nodes::{Accumulation, Import, Modulate, Variance};
use atrous::reference::{Bindings, Engine, Image};
use atrous::{Declaration, Error, FrameParams, Tuning, UseFrame};
use atrous_synthetic as synthetic;
use std::sync::Arc;

/// The mean of the 3×3 pixels whose luminance is within two standard deviations of the centre's. Names of bindings are the ports.
const FILTER: &str = include_str!("mean_3x3.comp");

/// The same filter on the CPU: it reads and writes by the names of the bindings.
fn filter_on_the_cpu(b: &mut Bindings) -> Result<(), Error> {
    let estimate = b.colour("estimate")?;
    let [width, height] = estimate.extent();
    let at =
        |x: i32, y: i32| estimate.get(x.clamp(0, width as i32 - 1), y.clamp(0, height as i32 - 1)).copied().unwrap_or_default();
    let luminance = |c: [f32; 4]| 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
    let texels = (0..height as i32).flat_map(|y| (0..width as i32).map(move |x| (x, y))).map(|(x, y)| {
        let centre = at(x, y);
        let taps = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (dx, dy))).map(|(dx, dy)| at(x + dx, y + dy));
        let near = taps.filter(|tap| (luminance(*tap) - luminance(centre)).abs() <= 2.0 * centre[3] + 1e-3);
        let sum = near.fold([0.0; 4], |s, t| [s[0] + t[0], s[1] + t[1], s[2] + t[2], s[3] + 1.0]);
        [sum[0] / sum[3], sum[1] / sum[3], sum[2] / sum[3], centre[3]]
    });
    b.write("filtered", Image::from_texels([width, height], texels.collect())?)
}

/// SPIR-V with its names, since bindings are matched by them.
fn compile(source: &str) -> Result<Vec<u32>, Box<dyn std::error::Error>> {
    let mut options = shaderc::CompileOptions::new()?;
    options.set_target_env(shaderc::TargetEnv::Vulkan, shaderc::EnvVersion::Vulkan1_1 as u32);
    let compiled =
        shaderc::Compiler::new()?.compile_into_spirv(source, shaderc::ShaderKind::Compute, "filter", "main", Some(&options))?;
    Ok(compiled.as_binary().to_vec())
}

fn graph(filter: &Stage) -> Result<Declaration, Error> {
    let mut g = Graph::new(synthetic::EXTENT);
    let guides = g.import(Import::default());
    let noisy = g.radiance("noisy_radiance");
    let irradiance = g.demodulate(&guides, &noisy, Default::default());
    // docs: begin
    let history = g.history(&irradiance, Feedback::Accumulated);
    let accumulated = g.temporal_accumulation(&guides, &irradiance, &history, Accumulation::default());
    let estimate = g.variance(&guides, &accumulated, &history, Variance::default());
    let filtered = g.stage(filter).bind("estimate", estimate.image()).add();
    let denoised = g.modulate(&guides, &Irradiance::of(filtered.written("filtered")), Modulate::default());
    g.output("denoised_radiance", &denoised);
    // docs: end
    g.finish()
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let filter = Stage::new("mean_3x3", &compile(FILTER)?)?.with_twin(filter_on_the_cpu);
    let declaration = graph(&filter)?;
    let options = HeadlessOptions { validation: Validation::On, ..HeadlessOptions::default() };
    let gpu = Arc::new(HeadlessDevice::new(&options)?);
    let mut session = Session::new(gpu.clone(), declaration.clone(), SessionOptions::default())?;
    let mut engine = Engine::new(declaration)?;
    let tuning = Tuning::for_preset(Preset::Svgf); // whose accumulation and variance these are
    for index in 0..synthetic::FRAMES {
        let frame = synthetic::Frame::new(index);
        for (name, texels) in synthetic::NAMES.iter().zip(&frame.images) {
            session.upload(name, texels)?;
            engine.upload(name, texels)?;
        }
        session.upload_ids("surface_id", &frame.surface_id)?;
        engine.upload_ids("surface_id", &frame.surface_id)?;
        let view_from_world = synthetic::view_from_world(index);
        let clip_from_view = synthetic::clip_from_view();
        let params = FrameParams { view_from_world, clip_from_view, ..FrameParams::new(synthetic::EXTENT) };
        session.run(&params, &tuning)?;
        engine.run(&params, &tuning)?;
        println!("{}", synthetic::report(index, &session.download_bytes("denoised_radiance", UseFrame::Current)?));
        let (on_gpu, on_cpu) = (session.download("denoised_radiance")?, engine.download("denoised_radiance")?);
        let differs = |(a, b): &(&[f32; 4], &[f32; 4])| (0..3).any(|c| (a[c] - b[c]).abs() > 5e-3 + 5e-3 * b[c].abs());
        let different = on_gpu.iter().zip(&on_cpu).filter(differs).count();
        println!("frame {index}: {different} of {} pixels differ between {} and the CPU engine", on_gpu.len(), gpu.name());
        if different * 200 > on_gpu.len() {
            return Err("the GPU and the CPU engine disagree".into());
        }
    }
    gpu.validation_errors().into_iter().next().map_or(Ok(()), |message| Err(message.into()))
}
