//! A host that re-shades: it keeps surface and seed of every pixel, and shades the gradient samples with those of the previous frame.

use super::{random, scene::Scene, session_with, upload};
use atrous::executor::{Session, SessionOptions};
use atrous::{Config, FrameContext, FrameParams, Tuning, UseFrame};

/// What shading reads: the surface's radiance under a light of 1, and the seed.
#[derive(Clone, Copy)]
struct Record {
    surface: [f32; 4],
    is_sky: bool,
    seed: [u32; 3],
}

pub struct Host {
    pub session: Session,
    pub config: Config,
    records: Vec<Record>,
    frames: u32,
}

/// What a test looks at after a frame.
pub struct Shaded {
    /// δ, Δ, mean and deviation as the stage `gradient` wrote them.
    pub gradient: Vec<[f32; 4]>,
    /// Texels: previous pixel, 1 + place, 0.
    pub samples: Vec<[u16; 4]>,
    pub confidence: Vec<f32>,
    pub denoised: Vec<[f32; 4]>,
    pub clean: Vec<[f32; 4]>,
    /// Whether a pixel is not sky.
    pub surface: Vec<bool>,
}

impl Host {
    pub fn new(config: Config) -> Self {
        let options = SessionOptions { poison: true, keep_transients: true, ..Default::default() };
        Self { session: session_with(&config, options), config, records: Vec::new(), frames: 0 }
    }

    /// Renders frame `camera` of a scene with its light, with noise that is new in every frame, and filters it.
    pub fn frame(&mut self, scene: &Scene, camera: u32) -> Shaded {
        let params = FrameParams { reshaded: true, ..scene.params(camera) };
        self.frame_with(scene, camera, &params)
    }

    pub fn frame_with(&mut self, scene: &Scene, camera: u32, params: &FrameParams) -> Shaded {
        let light = scene.light;
        let guides = Scene { light: 1.0, noise: 0.0, ..*scene }.frame(camera, 0);
        upload(&mut self.session, &guides);
        let seed = self.frames;
        self.frames += 1;
        let width = scene.allocated[0];
        let fresh = guides.clean.iter().zip(&guides.surface_id).zip(0u32..).map(|((&surface, &id), i)| Record {
            surface,
            is_sky: id == 0,
            seed: [i % width, i / width, seed],
        });
        let mut records: Vec<Record> = fresh.collect();
        let previous = std::mem::take(&mut self.records);
        let (mut noisy, mut gradient) = (Vec::new(), Vec::new());
        let config = self.config;
        let trace = &mut |s: &mut Session, _: &FrameContext, pass: usize, done: bool| {
            let name = s.executor().denoiser().declaration().passes()[pass].name.clone();
            match (name.as_str(), done) {
                ("gradient" | "demodulate", false) if noisy.is_empty() => {
                    if params.reshaded {
                        take_over(&config, &samples(s), scene.allocated, &previous, &mut records);
                    }
                    noisy = records.iter().map(|r| shade(r, scene.noise, light)).collect();
                    s.upload("noisy_radiance", &noisy)?;
                }
                ("gradient", true) => gradient = s.download("gradient")?,
                _ => {}
            }
            Ok(())
        };
        self.session.run_traced(params, &Tuning::for_preset(config.preset), trace).expect("frame");
        self.records = records;
        let s = &mut self.session;
        let confidence = |s: &mut Session| s.download("history_confidence").map(|t| t.iter().map(|t| t[0]).collect());
        Shaded {
            gradient,
            samples: if gradient_samples(&config) { samples(s) } else { Vec::new() },
            confidence: confidence(s).unwrap_or_default(),
            denoised: s.download("denoised_radiance").expect("denoised_radiance"),
            clean: guides.clean.iter().map(|c| lit(*c, light)).collect(),
            surface: guides.surface_id.iter().map(|&id| id != 0).collect(),
        }
    }
}

fn gradient_samples(config: &Config) -> bool {
    config.declare().expect("valid").find("gradient_samples").is_some()
}

fn samples(s: &mut Session) -> Vec<[u16; 4]> {
    bytemuck::allocation::pod_collect_to_vec(&s.download_bytes("gradient_samples", UseFrame::Current).expect("gradient_samples"))
}

/// What `atrous_gradient_sample` in glsl/host does.
fn take_over(config: &Config, samples: &[[u16; 4]], extent: [u32; 2], previous: &[Record], records: &mut [Record]) {
    let size = config.stratum_size;
    let width = extent[0].div_ceil(size);
    for (i, &[x, y, place, _]) in (0u32..).zip(samples).filter(|(_, t)| t[2] != 0) {
        let place = u32::from(place) - 1;
        let pixel = [i % width * size + place % size, i / width * size + place / size];
        records[(pixel[1] * extent[0] + pixel[0]) as usize] = previous[(u32::from(y) * extent[0] + u32::from(x)) as usize];
    }
}

fn lit(surface: [f32; 4], light: f32) -> [f32; 4] {
    surface.map(|c| c * light)
}

fn shade(r: &Record, noise: f32, light: f32) -> [f32; 4] {
    let [x, y, frame] = r.seed;
    let factor = if r.is_sky { 1.0 } else { (1.0 + noise * 12f32.sqrt() * (random(x, y, frame) - 0.5)).max(0.0) };
    lit(r.surface.map(|c| c * factor), light)
}
