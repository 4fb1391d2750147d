//! What moves before a flat mirror, against the same at rest.

use std::path::Path;
use std::sync::Arc;

use crate::Result;
use atrous_engine::scene::mirror_moving::{MIRROR, MOVERS};
use atrous_engine::{DenoiserOptions, Reflections, Scene, SceneOptions, TracerOptions};
use atrous_lab::pictures::Picture;

use super::regions::{errors, Errors};
use super::{Figures, Findings};
use crate::evaluate::claims::Claim;
use crate::evaluate::contenders::{Contender, BEST, NOISY};
use crate::evaluate::scene::Lab;
use crate::running;

const SCENE: &str = "mirror_moving";
/// Name of the filter that gets no hit ids.
const WITHOUT: &str = "best, no hit ids";
/// Name of the filter that gets the motion of what is hit instead.
const MOTION: &str = "best, motion of the hit";
/// Frames up to the measured one in which a pixel of the mirror shows a thing that moves, or it does not count.
const TRAIL: usize = 8;

pub fn run(lab: &Lab, folder: &Path) -> Result<Findings> {
    let moving = measure(lab, true, folder)?;
    let resting = measure(lab, false, folder)?;
    Ok(report(lab.settings.size, &moving, &resting))
}

fn filters() -> [Contender; 3] {
    let best = Contender::new(BEST, Default::default());
    let other = |name, reflections| Contender { name, options: DenoiserOptions { reflections, ..best.options }, over: None };
    [other(BEST, Reflections::Ids), other(WITHOUT, Reflections::AtRest), other(MOTION, Reflections::Motion)]
}

/// Of the last frame: of the noisy picture, then of each filter. Things at rest stand where they are in that frame.
fn measure(lab: &Lab, moves: bool, folder: &Path) -> Result<Vec<Errors>> {
    let scene = Arc::new(Scene::load(SCENE, &SceneOptions::default())?);
    let mut tracer = lab.tracer(&scene, TracerOptions::default())?;
    let contenders = filters();
    let mut running = lab.start(&tracer, &contenders)?;
    let last = lab.settings.frames - 1;
    lab.bar.inc_length(u64::from(lab.settings.frames));
    let mut shows: Vec<Vec<bool>> = Vec::new();
    for index in 0..=last {
        let moment = |frame: u32| {
            let moment = scene.moment(frame);
            atrous_engine::scene::Moment { object_time: scene.moment(if moves { frame } else { last }).object_time, ..moment }
        };
        tracer.begin_moment(index, &moment(index), &moment(index.saturating_sub(1)))?;
        running::denoise(lab.gpu, &mut tracer, &mut running)?;
        let outputs = tracer.outputs();
        let (surfaces, hits) = (lab.gpu.read_image_u32(&outputs.surface_id)?, lab.gpu.read_image_u32(&outputs.hit_id)?);
        shows.push(surfaces.iter().zip(&hits).map(|(surface, hit)| *surface == MIRROR && MOVERS.contains(hit)).collect());
        lab.bar.inc(1);
    }
    let frame = running::read(lab.gpu, &tracer, &mut running)?;
    let halves = lab.references.of_frame(&mut tracer, &scene, last)?;
    let names = [NOISY].into_iter().chain(contenders.iter().map(|c| c.name));
    let tag = if moves { "moving" } else { "at rest" };
    for (name, pixels) in names.zip(frame.pictures()) {
        let [width, height] = frame.extent;
        Picture::from_linear(width, height, pixels, 1.0)?.write_png(folder.join(format!("{name}, {tag}.png")))?;
    }
    let counts: Vec<bool> = (0..shows[0].len()).map(|p| shows.iter().rev().take(TRAIL).any(|shows| shows[p])).collect();
    frame.pictures().map(|picture| errors(picture, &halves, frame.extent, &counts)).collect()
}

fn report(size: [u32; 2], moving: &[Errors], resting: &[Errors]) -> Findings {
    let mut table = Figures::new(
        SCENE,
        [("RMSE", 4), ("relMSE", 5), ("FLIP", 3), ("RMSE at rest", 4), ("relMSE at rest", 5), ("FLIP at rest", 3)],
    );
    for ((name, moving), resting) in [NOISY, BEST, WITHOUT, MOTION].iter().zip(moving).zip(resting) {
        let of = |errors: &Errors| [errors.rmse, errors.rel_mse, errors.flip];
        table.row(name, &[of(moving), of(resting)].concat());
    }
    let claim = |text: String, ratio: f64, bound: f64| Claim { text, scene: SCENE.into(), ratio, bound, accepted: bound };
    let mut claims = Vec::new();
    if let ([noisy, best, without, motion], [_, best_at_rest, without_at_rest, _]) = (moving, resting) {
        let (ids, none) = (best.rel_mse / best_at_rest.rel_mse, without.rel_mse / without_at_rest.rel_mse);
        claims.push(claim("relMSE of things that move in a mirror to that at rest, with hit ids".into(), ids, 2.0));
        claims.push(claim("the same without hit ids".into(), none, 5.0));
        claims.push(claim("relMSE with the motion of what is hit to that with its id".into(), motion.rel_mse / best.rel_mse, 1.05));
        for (name, errors) in [(BEST, best), (WITHOUT, without)] {
            claims.push(claim(
                format!("FLIP of things that move in a mirror to that of the noisy picture, {name}"),
                errors.flip / noisy.flip,
                1.0,
            ));
        }
    }
    Findings {
        title: "Things that move in a mirror".into(),
        text: format!(
            "`{SCENE}`, {}x{}, the last frame: pixels of the mirror that showed a thing that moves in one of the last {TRAIL} frames. At rest, the \
             things stand where they are in that frame. The camera moves.",
            size[0], size[1]
        ),
        tables: vec![table],
        claims,
        ..Findings::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn claims_fail_where_a_reflection_smears() {
        let errors = |rel_mse, flip| Errors { rmse: 0.1, rel_mse, flip };
        let (noisy, rest) = (errors(0.5, 0.3), errors(0.01, 0.1));
        let failing = |moving: [Errors; 3]| -> Vec<String> {
            let found = report([64, 36], &[noisy, moving[0], moving[1], moving[2]], &[noisy, rest, rest, rest]);
            found.claims.into_iter().filter(|claim| !claim.holds()).map(|claim| claim.text).collect()
        };
        assert_eq!(failing([errors(0.019, 0.2), errors(0.049, 0.3), errors(0.019, 0.2)]), [""; 0]);
        assert_eq!(failing([errors(0.021, 0.31), errors(0.051, 0.31), errors(0.03, 0.2)]).len(), 5);
    }
}
