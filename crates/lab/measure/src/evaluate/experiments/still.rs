//! Nothing moves and no light changes: how much a picture changes from frame to frame.

use std::path::Path;
use std::sync::Arc;

use crate::measure::luminance;
use crate::Result;
use atrous_engine::{Scene, SceneOptions, TracerOptions};

use super::Lines;
use super::{Figures, Findings};
use crate::evaluate::contenders::{self, ASVGF, BEST, EAW_ACCUMULATED, NOISY, SVGF};
use crate::evaluate::scene::Lab;
use crate::running;

const SCENE: &str = "pillars";
const SHOWN: [&str; 5] = ["EAW", EAW_ACCUMULATED, SVGF, ASVGF, BEST];

pub fn run(lab: &Lab, _: &Path) -> Result<Findings> {
    let still = SceneOptions { static_light: true, static_camera: true, static_objects: true };
    let scene = Arc::new(Scene::load(SCENE, &still)?);
    let frames = if lab.settings.frames < 32 { 20 } else { 60 };
    lab.bar.inc_length(frames);
    let mut tracer = lab.tracer(&scene, TracerOptions::default())?;
    let contenders = contenders::named(&SHOWN);
    let mut filters = lab.start(&tracer, &contenders)?;
    let names: Vec<_> = std::iter::once(NOISY).chain(contenders.iter().map(|c| c.name)).collect();
    let mut changes = vec![Vec::new(); names.len()];
    let mut before: Option<Vec<Vec<f32>>> = None;
    for index in 0..frames as u32 {
        running::render(lab.gpu, &mut tracer, &mut filters, index)?;
        let now: Vec<_> = running::read(lab.gpu, &tracer, &mut filters)?.pictures().map(luminances).collect();
        if let Some(before) = &before {
            changes.iter_mut().zip(before.iter().zip(&now)).for_each(|(changes, (a, b))| changes.push(difference(a, b)));
        }
        before = Some(now);
        lab.bar.inc(1);
    }
    Ok(report(&names, changes))
}

fn luminances(pixels: &[[f32; 3]]) -> Vec<f32> {
    pixels.iter().map(|pixel| luminance(*pixel)).collect()
}

/// Mean difference of two pictures.
fn difference(a: &[f32], b: &[f32]) -> f64 {
    a.iter().zip(b).map(|(a, b)| f64::from((a - b).abs())).sum::<f64>() / a.len() as f64
}

/// `changes` begin with frame 1.
fn report(names: &[&str], changes: Vec<Vec<f64>>) -> Findings {
    let shown: Vec<usize> = [1, 5, 10, 19, 40, 59].into_iter().filter(|frame| *frame <= changes[0].len()).collect();
    let headings: Vec<_> = shown.iter().map(|frame| format!("frame {frame}")).collect();
    let columns = headings.iter().map(|heading| (heading.as_str(), 5)).chain([("frames until settled", 0)]);
    let mut table = Figures::new("mean difference from the frame before", columns);
    for (name, changes) in names.iter().zip(&changes) {
        let values = shown.iter().map(|frame| changes[frame - 1]).chain([settled(changes) as f64]);
        table.row(name, &values.collect::<Vec<_>>());
    }
    let series = names.iter().zip(changes).filter(|(name, _)| **name != NOISY).map(|(name, c)| ((*name).to_owned(), c)).collect();
    Findings {
        title: format!("Change from frame to frame while nothing moves: [SVGF] Fig. 10, `{SCENE}`"),
        text:
            "Mean difference of the luminance of consecutive frames, linear radiance, no light, object or camera moves. Settled: \
               from that frame on no frame is more than a quarter above the mean of the last ten."
                .into(),
        tables: vec![table],
        curves: vec![Lines { title: "mean difference from the frame before".into(), first_frame: 1, series }],
        claims: Vec::new(),
    }
}

/// The first frame from which on the change stays within a quarter of that at the end.
fn settled(changes: &[f64]) -> usize {
    let end = &changes[changes.len().saturating_sub(10)..];
    let bound = 1.25 * end.iter().sum::<f64>() / end.len() as f64;
    changes.iter().rposition(|change| *change > bound).map_or(1, |frame| frame + 2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_is_settled_where_its_change_is_that_of_the_end() {
        let mut changes = vec![1.0; 20];
        assert_eq!(settled(&changes), 1);
        changes[0] = 5.0;
        changes[3] = 2.0;
        // The fourth change is that of frame 4, so frame 5 is the first of the quiet ones.
        assert_eq!(settled(&changes), 5);
        assert_eq!(difference(&[1.0, 2.0], &[2.0, 0.0]), 1.5);
    }
}
