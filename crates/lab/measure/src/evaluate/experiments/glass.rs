//! What is seen through a pane and a glass ball, and in them: guides and signals of the glass itself, or of what is seen.

use std::path::Path;
use std::sync::Arc;

use crate::Result;
use atrous::config::{Preset, Signals};
use atrous_engine::scene::vitrine::{BALL, BLOCK, PANE, ROLLING};
use atrous_engine::{DenoiserOptions, GlassShown, PathTracer, Reflections, Scene, SceneOptions, TracerOptions};
use atrous_lab::pictures::Picture;

use super::regions::{errors, Errors};
use super::{Figures, Findings};
use crate::evaluate::claims::Claim;
use crate::evaluate::contenders::NOISY;
use crate::evaluate::scene::Lab;
use crate::measure::Frame;
use crate::running::{self, Running};

const SCENE: &str = "vitrine";
/// Frames up to the last one in which a pixel shows a thing that moves, or it does not count as one that does.
const TRAIL: usize = 8;

const ITSELF: &str = "nothing replaced, one signal";
const ITSELF_SPECULAR: &str = "nothing replaced, all specular";
const REPLACED: &str = "replaced, one signal";
const NO_MOTION: &str = "the same without motion";
const LAYERS: &str = "replaced, reflection as specular light";
const TWO: &str = "two denoisers";

/// A part of the picture.
const PARTS: [&str; 5] = ["pane", "moving thing behind it", "moving thing in its reflection", "ball", "rest"];

/// Filters on one tracer, whose pictures are added up by name.
struct Layer {
    shown: GlassShown,
    filters: Vec<(&'static str, DenoiserOptions)>,
}

fn layers() -> Vec<Layer> {
    let best = |signals| DenoiserOptions::new(Preset::Best).with(|config| config.signals = signals);
    let one = best(Signals::Together);
    // Only by the engine's motion are they followed: the ids of what is seen through glass say nothing of the glass.
    let apart = DenoiserOptions { reflections: Reflections::Motion, ..best(Signals::Specular) };
    vec![
        Layer { shown: GlassShown::Itself, filters: vec![(ITSELF, one), (ITSELF_SPECULAR, best(Signals::Specular))] },
        Layer {
            shown: GlassShown::Layers,
            filters: vec![(REPLACED, one), (NO_MOTION, DenoiserOptions { motion: false, ..one }), (LAYERS, apart)],
        },
        Layer { shown: GlassShown::Through, filters: vec![(TWO, one)] },
        Layer { shown: GlassShown::Reflection, filters: vec![(TWO, one)] },
    ]
}

const ROWS: [&str; 7] = [NOISY, ITSELF, ITSELF_SPECULAR, REPLACED, NO_MOTION, LAYERS, TWO];

struct Started {
    tracer: PathTracer,
    filters: Vec<Running>,
    /// The ids of the last frames.
    seen: Vec<Vec<u32>>,
}

pub fn run(lab: &Lab, folder: &Path) -> Result<Findings> {
    let scene = Arc::new(Scene::load(SCENE, &SceneOptions::default())?);
    let start = |layer: &Layer| -> Result<Started> {
        let tracer = lab.tracer(&scene, TracerOptions { glass: layer.shown, ..TracerOptions::default() })?;
        let filters = layer.filters.iter().map(|(name, options)| Running::new(lab.gpu, &tracer, name, options));
        Ok(Started { filters: filters.collect::<Result<_>>()?, tracer, seen: Vec::new() })
    };
    let mut started = layers().iter().map(start).collect::<Result<Vec<_>>>()?;
    lab.bar.inc_length(u64::from(lab.settings.frames));
    let last = lab.settings.frames - 1;
    for index in 0..=last {
        for Started { tracer, filters, seen } in &mut started {
            running::render(lab.gpu, tracer, filters, index)?;
            seen.push(lab.gpu.read_image_u32(&tracer.outputs().surface_id)?);
        }
        lab.bar.inc(1);
    }
    let frames = started.iter_mut().map(|s| running::read(lab.gpu, &s.tracer, &mut s.filters)).collect::<Result<Vec<_>>>()?;
    let counts = counts(&started);
    let halves = lab.references.of_frame(&mut started[1].tracer, &scene, last)?;
    let mean: Vec<[f32; 3]> = halves[0].iter().zip(&halves[1]).map(|(a, b)| [0, 1, 2].map(|c| 0.5 * (a[c] + b[c]))).collect();
    let [width, height] = lab.settings.size;
    Picture::from_linear(width, height, &mean, 1.0)?.write_png(folder.join("reference.png"))?;
    let mut found = Vec::new();
    for (name, picture) in ROWS.iter().zip(pictures(&frames, &started)) {
        Picture::from_linear(width, height, &picture, 1.0)?.write_png(folder.join(format!("{name}.png")))?;
        found.push(counts.iter().map(|counts| errors(&picture, &halves, [width, height], counts)).collect::<Result<Vec<_>>>()?);
    }
    Ok(report(lab.settings.size, &found))
}

/// Those of [`ROWS`].
fn pictures(frames: &[Frame], started: &[Started]) -> Vec<Vec<[f32; 3]>> {
    let mut pictures = vec![frames[1].noisy.clone()];
    for name in &ROWS[1..] {
        let mut sum = vec![[0.0; 3]; frames[0].noisy.len()];
        for (frame, started) in frames.iter().zip(started) {
            for (filter, denoised) in started.filters.iter().zip(&frame.denoised).filter(|(filter, _)| filter.name == *name) {
                debug_assert_eq!(filter.name, *name);
                sum.iter_mut().zip(&denoised.radiance).for_each(|(sum, own)| (0..3).for_each(|c| sum[c] += own[c]));
            }
        }
        pictures.push(sum);
    }
    pictures
}

/// The pixels of each of [`PARTS`].
fn counts(started: &[Started]) -> [Vec<bool>; 5] {
    let last = |layer: usize| started[layer].seen.last().map_or(&[][..], Vec::as_slice);
    let glass = |id: u32| last(0).iter().map(|seen| *seen == id).collect::<Vec<_>>();
    // Behind the first thousand, ids tell how a thing is seen.
    let showed = |layer: usize, id: u32| -> Vec<bool> {
        let of_pixel = |p: usize| started[layer].seen.iter().rev().take(TRAIL).any(|seen| seen[p] % 1000 == id);
        glass(PANE).iter().enumerate().map(|(p, is_pane)| *is_pane && of_pixel(p)).collect()
    };
    let rest = last(0).iter().map(|seen| ![PANE, BALL].contains(seen)).collect();
    [glass(PANE), showed(2, ROLLING), showed(3, BLOCK), glass(BALL), rest]
}

/// `found`: for each of [`ROWS`], then each of [`PARTS`].
fn report(size: [u32; 2], found: &[Vec<Errors>]) -> Findings {
    let table = |(part, title): (usize, &&str)| {
        let mut table = Figures::new(title, [("RMSE", 4), ("relMSE", 4), ("FLIP", 3)]);
        for (name, errors) in ROWS.iter().zip(found) {
            let Errors { rmse, rel_mse, flip } = errors[part];
            table.row(name, &[rmse, rel_mse, flip]);
        }
        table
    };
    let rmse =
        |name: &str, part: usize| ROWS.iter().zip(found).find(|(row, _)| **row == name).map_or(f64::NAN, |(_, e)| e[part].rmse);
    let claim = |name: &str, other: &str, part: usize| Claim {
        text: format!("RMSE of \"{name}\" to that of \"{other}\", {}", PARTS[part]),
        scene: SCENE.into(),
        ratio: rmse(name, part) / rmse(other, part),
        bound: 1.0,
        accepted: 1.0,
    };
    Findings {
        title: "Glass".into(),
        text: format!(
            "`{SCENE}`, {}x{}, `best`, the last frame. The camera moves, a ball behind the pane, and a block that is seen in the pane alone. Each \
             filter has the same light: one path for what is seen through glass, one for its reflection.",
            size[0], size[1]
        ),
        tables: PARTS.iter().enumerate().map(table).collect(),
        claims: vec![claim(TWO, ITSELF, 0), claim(LAYERS, ITSELF, 0), claim(TWO, ITSELF, 3)],
        ..Findings::default()
    }
}
