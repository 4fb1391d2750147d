//! Time and traffic of every pass: `cargo run --release --example bench -- --help`.
//!
//! Times are GPU timestamps; the median of the frames, since other work on the machine only ever adds. Bytes are each declared image once,
//! read or written: what a perfect cache would move, so that `GB/s` against the device's bandwidth is a roofline.

use atrous::config::{PostProcess, Preset, Signals};
use atrous::executor::{HeadlessDevice, HeadlessOptions, Session, SessionOptions};
use atrous::{Config, Error, FrameParams, Shape, Tuning};
use clap::Parser;
use std::sync::Arc;

/// Times every pass of a preset on synthetic input.
#[derive(Parser)]
struct Options {
    /// Width and height in pixels
    #[arg(long, default_value = "1920x1080", value_parser = parse_size)]
    size: [u32; 2],
    /// Frames that are timed, after five that are not
    #[arg(long, default_value_t = 30, value_parser = clap::value_parser!(u32).range(1..))]
    frames: u32,
    /// Index or a part of the name of the device
    #[arg(long)]
    device: Option<String>,
    /// Filter: svgf, asvgf (with forward-projected gradients), percentile or eaw
    #[arg(long, default_value_t)]
    preset: Preset,
    /// Signals: together or apart
    #[arg(long, default_value_t)]
    signals: Signals,
    /// À-trous levels
    #[arg(long, default_value_t = 5)]
    levels: u32,
    /// Tone map and temporal anti-aliasing as well
    #[arg(long)]
    post_process: bool,
}

fn parse_size(text: &str) -> Result<[u32; 2], String> {
    let parsed = text.split_once('x').and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
    parsed.ok_or_else(|| format!("\"{text}\" is not a size: give width and height like 1920x1080"))
}

const UNTIMED: u32 = 5;

fn main() {
    if let Err(error) = bench(&Options::parse()) {
        eprintln!("error: {error}");
        std::process::exit(1);
    }
}

fn bench(options: &Options) -> Result<(), Error> {
    let config = Config {
        signals: options.signals,
        preset: options.preset,
        levels: options.levels,
        post_process: if options.post_process { PostProcess::ToneMapTaa } else { PostProcess::None },
        ..Config::new(options.size)
    };
    let gpu = Arc::new(HeadlessDevice::new(&HeadlessOptions { device: options.device.clone(), ..Default::default() })?);
    println!("{}, {}x{}, {} frames", gpu.name(), options.size[0], options.size[1], options.frames);
    let mut session = Session::new(gpu, config.declare()?, SessionOptions { timestamps: true, ..Default::default() })?;
    upload(&mut session, options.size)?;
    let mut samples: Vec<Vec<f64>> = Vec::new();
    for i in 0..UNTIMED + options.frames {
        let params = FrameParams { frame_slot: i % config.frames_in_flight, reshaded: true, ..FrameParams::new(options.size) };
        session.run(&params, &Tuning::for_preset(config.preset))?;
        if i >= UNTIMED {
            samples.resize(session.times().len(), Vec::new());
            samples.iter_mut().zip(session.times()).for_each(|(s, t)| s.push(t.milliseconds));
        }
    }
    report(&session, &mut samples, options.size);
    Ok(())
}

/// A wall seen head-on with noise on it: every pixel has a history and takes every tap, which is the most work.
fn upload(session: &mut Session, [w, h]: [u32; 2]) -> Result<(), Error> {
    let count = (w * h) as usize;
    let noise: Vec<[f32; 4]> = (0..count as u32)
        .map(|i| {
            let v = (i.wrapping_mul(0x9e37_79b9) ^ i >> 7).wrapping_mul(0x85eb_ca6b);
            [v & 0xff, v >> 8 & 0xff, v >> 16 & 0xff, 0].map(|c| c as f32 / 128.0)
        })
        .collect();
    session.upload("depth", &vec![[5.0; 4]; count])?;
    session.upload("normal", &vec![[0.0, 0.0, 1.0, 0.0]; count])?;
    session.upload("motion", &vec![[0.0; 4]; count])?;
    session.upload("albedo", &vec![[0.5; 4]; count])?;
    session.upload_ids("surface_id", &vec![1; count])?;
    let declaration = session.executor().denoiser().declaration().clone();
    for name in ["noisy_radiance", "noisy_direct", "noisy_indirect"] {
        if declaration.find(name).is_some() {
            session.upload(name, &noise)?;
        }
    }
    Ok(())
}

fn report(session: &Session, samples: &mut [Vec<f64>], [w, h]: [u32; 2]) {
    let declaration = session.executor().denoiser().declaration();
    if samples.is_empty() {
        println!("the device's queue has no timestamps");
        return;
    }
    let medians: Vec<f64> = samples
        .iter_mut()
        .map(|s| {
            s.sort_by(f64::total_cmp);
            s[s.len() / 2]
        })
        .collect();
    let total: f64 = medians.iter().sum();
    println!("{:24} {:>9} {:>6} {:>10} {:>9}", "pass", "ms", "%", "MB", "GB/s");
    for (pass, ms) in declaration.passes().iter().zip(&medians) {
        let images = pass.uses.iter().map(|u| declaration.resource(u.resource)).filter(|r| matches!(r.shape, Shape::Image { .. }));
        let bytes: u64 = images.map(|r| r.bytes([w, h])).sum();
        let megabytes = bytes as f64 / 1e6;
        println!("{:24} {ms:9.4} {:6.1} {megabytes:10.2} {:9.2}", pass.name, 100.0 * ms / total, megabytes / ms);
    }
    println!("{:24} {total:9.4}", "all passes");
    let memory = declaration.memory();
    let pixels = f64::from(w) * f64::from(h);
    println!(
        "{:.2} ns per pixel; {:.1} bytes per pixel",
        total * 1e6 / pixels,
        (memory.history + memory.transient) as f64 / pixels
    );
}
