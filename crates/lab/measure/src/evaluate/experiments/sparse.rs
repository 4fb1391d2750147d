//! EAW with a sample in every fourth or sixteenth pixel, and without the diffuse buffer.

use std::path::Path;
use std::sync::Arc;

use crate::measure::{Denoised, Frame, Scores};
use crate::report::mean;
use crate::Result;
use atrous::config::{Preset, Sampling};
use atrous::executor::{HeadlessDevice, Session, SessionOptions};
use atrous::nodes::{Albedo, Demodulate, Eaw, Import, Modulate};
use atrous::{presets, Config, Declaration, FrameParams, Tuning};
use atrous_engine::{PathTracer, Scene, SceneOptions, TracerOptions};

use super::{Figures, Findings};
use crate::evaluate::scene::Lab;
use crate::running;

/// White walls, and textures as fine as a pixel.
const SCENES: [&str; 2] = ["cornell", "tiles"];
/// Frames that are measured, each by itself.
const MEASURED: u32 = 2;

/// A row of the tables.
struct Case {
    name: &'static str,
    sampling: Sampling,
    diffuse_buffer: bool,
}

const CASES: [Case; 4] = [
    Case { name: "every pixel", sampling: Sampling::Full, diffuse_buffer: true },
    Case { name: "one of 2x2", sampling: Sampling::OneOf2x2, diffuse_buffer: true },
    Case { name: "one of 4x4", sampling: Sampling::OneOf4x4, diffuse_buffer: true },
    Case { name: "every pixel, no diffuse buffer", sampling: Sampling::Full, diffuse_buffer: false },
];

impl Case {
    /// The preset EAW, whose graph without a diffuse buffer no configuration has.
    fn declaration(&self, extent: [u32; 2]) -> std::result::Result<Declaration, atrous::Error> {
        let config = Config { preset: Preset::Eaw, sampling: self.sampling, ..Config::new(extent) };
        if self.diffuse_buffer {
            return config.declare();
        }
        let mut g = atrous::graph::Graph::new(extent);
        let guides = g.import(Import::default());
        let noisy = presets::noisy(&mut g, config.signals);
        let irradiance = g.demodulate(&guides, &noisy, Demodulate { albedo: Albedo::None, ..Demodulate::default() });
        let filtered = g.eaw(&guides, &irradiance, Eaw { levels: config.levels(), ..Eaw::default() });
        let denoised = g.modulate(&guides, &filtered, Modulate { albedo: false, ..Modulate::default() });
        g.output("denoised_radiance", &denoised);
        g.finish()
    }

    /// Side of the blocks of pixels of which one has a sample.
    fn side(&self) -> u32 {
        1 << self.sampling as u32
    }
}

pub fn run(lab: &Lab, _: &Path) -> Result<Findings> {
    let gpu = lab.headless()?;
    let tables = SCENES.into_iter().map(|name| on_scene(lab, &gpu, name)).collect::<Result<_>>()?;
    Ok(Findings {
        title: "Fewer samples, and no diffuse buffer: [EAW] 3, 3.2".into(),
        text: format!(
            "Of a block of 2x2 or 4x4 pixels one has a sample, at random; the first levels paint in the others. Without the diffuse buffer \
             textures are filtered along with the light. Each frame by itself, means of the last {MEASURED}."
        ),
        tables,
        ..Findings::default()
    })
}

fn on_scene(lab: &Lab, gpu: &Arc<HeadlessDevice>, name: &str) -> Result<Figures> {
    let scene = Arc::new(Scene::load(name, &SceneOptions::default())?);
    let mut tracer = lab.tracer(&scene, TracerOptions::default())?;
    let extent = [tracer.extent().width, tracer.extent().height];
    let open = |case: &Case| Ok(Session::new(gpu.clone(), case.declaration(extent)?, SessionOptions::default())?);
    let mut sessions = CASES.iter().map(open).collect::<Result<Vec<_>>>()?;
    let mut scores: Vec<Vec<Scores>> = vec![Vec::new(); CASES.len()];
    let measured = lab.settings.measured_frames();
    let first = measured.end - MEASURED.min(lab.settings.measured);
    lab.bar.inc_length(u64::from(measured.end - first));
    for index in first..measured.end {
        running::render(lab.gpu, &mut tracer, &mut [], index)?;
        lab.gpu.submit(|cmd| {
            tracer.record_lighting(cmd);
            Ok(())
        })?;
        let mut frame = running::read(lab.gpu, &tracer, &mut [])?;
        let inputs = Inputs::read(lab, &tracer, index)?;
        for (case, session) in CASES.iter().zip(&mut sessions) {
            let radiance = inputs.filtered(session, case.side())?;
            frame.denoised.push(Denoised { radiance, views: Vec::new() });
        }
        frame.set_halves(lab.references.of_frame(&mut tracer, &scene, index)?);
        note(&frame, &mut scores)?;
        lab.bar.inc(1);
    }
    let mut table = Figures::new(name, [("RMSE", 4), ("SSIM", 3), ("FLIP", 3)]);
    for (case, scores) in CASES.iter().zip(&scores) {
        let mean = mean(scores);
        table.row(case.name, &[mean.rmse, mean.ssim, mean.flip]);
    }
    Ok(table)
}

fn note(frame: &Frame, scores: &mut [Vec<Scores>]) -> Result<()> {
    let of_frame = frame.scores(None)?.unwrap_or_default();
    // The first is the noisy picture's.
    scores.iter_mut().zip(of_frame.into_iter().skip(1)).for_each(|(scores, of_frame)| scores.push(of_frame));
    Ok(())
}

/// A frame of a tracer, as EAW takes it.
struct Inputs {
    noisy: Vec<[f32; 4]>,
    guides: Vec<(&'static str, Vec<[f32; 4]>)>,
    surface_id: Vec<u32>,
    params: FrameParams,
    /// Of which pixels have a sample.
    seed: u64,
}

impl Inputs {
    fn read(lab: &Lab, tracer: &PathTracer, index: u32) -> Result<Self> {
        let (outputs, camera, extent) = (tracer.outputs(), tracer.camera(index), tracer.extent());
        let images =
            [("depth", &outputs.depth), ("normal", &outputs.normal), ("emission", &outputs.emission), ("albedo", &outputs.albedo)];
        let read = |(name, image)| Ok((name, lab.gpu.read_image(image)?));
        Ok(Self {
            noisy: lab.gpu.read_image(&outputs.scattered)?,
            guides: images.into_iter().map(read).collect::<Result<_>>()?,
            surface_id: lab.gpu.read_image_u32(&outputs.surface_id)?,
            params: FrameParams {
                view_from_world: camera.view_from_world,
                clip_from_view: camera.clip_from_view,
                ..FrameParams::new([extent.width, extent.height])
            },
            seed: u64::from(lab.settings.seed) << 32 | u64::from(index),
        })
    }

    /// The noisy picture with one sample in each block of pixels.
    fn sparse(&self, side: u32) -> Vec<[f32; 4]> {
        let [width, height] = self.params.render_extent;
        let mut random = fastrand::Rng::with_seed(self.seed);
        let mut sparse = vec![[f32::NAN; 4]; self.noisy.len()];
        for y in (0..height).step_by(side as usize) {
            for x in (0..width).step_by(side as usize) {
                let [x, y] = [(x, width), (y, height)].map(|(at, end)| at + random.u32(0..side.min(end - at)));
                let pixel = (y * width + x) as usize;
                sparse[pixel] = self.noisy[pixel];
            }
        }
        sparse
    }

    fn filtered(&self, session: &mut Session, side: u32) -> Result<Vec<[f32; 3]>> {
        let declaration = session.executor().denoiser().declaration().clone();
        for (name, texels) in self.guides.iter().filter(|(name, _)| declaration.find(name).is_some()) {
            session.upload(name, texels)?;
        }
        session.upload_ids("surface_id", &self.surface_id)?;
        session.upload("noisy_radiance", &self.sparse(side))?;
        session.run(&self.params, &Tuning::for_preset(Preset::Eaw))?;
        Ok(session.download("denoised_radiance")?.into_iter().map(|[r, g, b, _]| [r, g, b]).collect())
    }
}
