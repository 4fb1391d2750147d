//! Renders frames of a scene, and writes what each pass gives as PNG pictures.

mod preview;

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;

use atrous_demo::{Error, Gpu, GpuOptions, PathTracer, Result, Scene, SceneOptions, TracerOptions};
use clap::Parser;

/// Renders frames of a scene with one path for each pixel, and the ground truth if asked for.
#[derive(Parser)]
#[command(version)]
struct Arguments {
    /// cornell, pillars, glossy, hall, or a glTF 2.0 file (.glb, .gltf)
    #[arg(long, default_value = "cornell")]
    scene: String,
    /// Width and height in pixels
    #[arg(long, default_value = "320x180", value_parser = parse_size)]
    size: (u32, u32),
    /// How many frames
    #[arg(long, default_value_t = 1)]
    frames: u32,
    /// Index of the first one
    #[arg(long, default_value_t = 0)]
    first_frame: u32,
    /// Samples of the last frame's reference; 0: none
    #[arg(long, default_value_t = 0)]
    reference: u32,
    /// Folder for the pictures
    #[arg(long, default_value = "out/demo")]
    out: PathBuf,
    /// Index or a part of the name of the device
    #[arg(long)]
    device: Option<String>,
    /// Print the devices and stop
    #[arg(long)]
    list_devices: bool,
    /// Run under the Khronos validation layer; its messages are errors
    #[arg(long)]
    validate: bool,
    /// Lights keep their intensity
    #[arg(long)]
    static_light: bool,
    /// The camera stands still
    #[arg(long)]
    static_camera: bool,
    /// Objects stand still
    #[arg(long)]
    static_objects: bool,
    /// Move the primary rays within their pixels
    #[arg(long)]
    jitter: bool,
    /// Another seed gives other noise
    #[arg(long, default_value_t = 0)]
    seed: u32,
}

fn parse_size(text: &str) -> std::result::Result<(u32, u32), String> {
    let parsed = text
        .split_once('x')
        .and_then(|(w, h)| Some((w.parse().ok()?, h.parse().ok()?)));
    parsed.ok_or_else(|| format!("\"{text}\" is not a size: give width and height like 320x180"))
}

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(0) => ExitCode::SUCCESS,
        Ok(count) => {
            eprintln!("error: {count} validation messages");
            ExitCode::FAILURE
        }
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Gives the number of validation messages.
fn run(arguments: &Arguments) -> Result<usize> {
    if arguments.list_devices {
        Gpu::list_devices()?
            .iter()
            .for_each(|device| println!("{device}"));
        return Ok(0);
    }
    let options = SceneOptions {
        static_light: arguments.static_light,
        static_camera: arguments.static_camera,
        static_objects: arguments.static_objects,
    };
    let scene = Arc::new(Scene::load(&arguments.scene, &options)?);
    let gpu = Gpu::new(&GpuOptions {
        device: arguments.device.clone(),
        validation: arguments.validate,
    })?;
    println!("device {}", gpu.info());
    render(arguments, &gpu, &scene)?;
    let messages = gpu.validation_messages();
    messages.iter().for_each(|message| eprintln!("{message}"));
    Ok(messages.len())
}

fn render(arguments: &Arguments, gpu: &Gpu, scene: &Arc<Scene>) -> Result<()> {
    let extent = ash::vk::Extent2D {
        width: arguments.size.0,
        height: arguments.size.1,
    };
    let options = TracerOptions {
        jitter: arguments.jitter,
        seed: arguments.seed,
        ..Default::default()
    };
    let mut tracer = PathTracer::new(gpu, scene, extent, options)?;
    let folder = arguments.out.join(&scene.name);
    std::fs::create_dir_all(&folder).map_err(|e| Error::Picture {
        path: folder.clone(),
        problem: e.to_string(),
    })?;
    let start = std::time::Instant::now();
    for frame in arguments.first_frame..arguments.first_frame + arguments.frames {
        tracer.begin_frame(frame)?;
        gpu.submit(|cmd| {
            tracer.record_gbuffer(cmd);
            tracer.record_lighting(cmd);
            Ok(())
        })?;
    }
    println!(
        "{} frames in {:.2} s",
        arguments.frames,
        start.elapsed().as_secs_f32()
    );
    preview::write_outputs(gpu, &tracer, &folder)?;
    if arguments.reference > 0 {
        write_reference(arguments.reference, &mut tracer, &folder)?;
    }
    println!("pictures in {}", folder.display());
    Ok(())
}

fn write_reference(samples: u32, tracer: &mut PathTracer, folder: &Path) -> Result<()> {
    let bar = indicatif::ProgressBar::new(u64::from(samples));
    let start = std::time::Instant::now();
    let reference =
        tracer.render_reference(samples, |done, _| bar.set_position(u64::from(done)))?;
    bar.finish();
    println!(
        "reference of {samples} samples in {:.2} s",
        start.elapsed().as_secs_f32()
    );
    let sum = |i: usize| {
        [0, 1, 2]
            .map(|c| reference.direct[i][c] + reference.indirect[i][c] + reference.emission[i][c])
    };
    let radiance: Vec<_> = (0..reference.direct.len()).map(sum).collect();
    let extent = tracer.extent();
    preview::write_radiance(&folder.join("reference.png"), extent, &radiance)?;
    preview::write_radiance(
        &folder.join("reference_direct.png"),
        extent,
        &reference.direct,
    )?;
    preview::write_radiance(
        &folder.join("reference_indirect.png"),
        extent,
        &reference.indirect,
    )
}
