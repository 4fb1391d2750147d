//! How long highlights and reflections stay where they were before the camera stopped.

use std::path::Path;
use std::sync::Arc;

use crate::measure::{luminance_around, Frame};
use crate::Result;
use atrous::ResetReason;
use atrous_engine::{Scene, SceneOptions, TracerOptions};
use atrous_lab::pictures::Picture;

use super::{Figures, Findings, Lines};
use crate::evaluate::claims::Claim;
use crate::evaluate::contenders::{self, ASVGF, BEST, ONE_SIGNAL, SVGF};
use crate::evaluate::scene::Lab;
use crate::evaluate::settings::Settings;
use crate::running;

/// Every surface is glossy or rough metal.
const SCENE: &str = "glossy";
const FILTERS: [&str; 6] = [SVGF, ASVGF, "percentile", "fast", ONE_SIGNAL, BEST];
/// Frame in which the camera is where it stays.
const STOP: u32 = 20;
/// Frames behind it.
const AFTER: u32 = 8;
/// Frames after which nothing may be left.
const GONE: usize = 4;
/// Excess over the light of a place from which on it shows what was there before.
const SHOWS: f32 = 0.25;
/// Half the side of the square whose light is compared.
const WINDOW: i32 = 2;
/// Runs in which the camera always stood there, with other random numbers before the stop. The first has those of the run that moves.
const STANDING: u32 = 3;

/// What leads to the stop.
#[derive(Clone, Copy, Default)]
struct Run {
    /// The camera moves.
    moves: bool,
    /// All history is dropped at the stop.
    forgets: bool,
    /// Which random numbers the frames before the stop have.
    numbers: u32,
}

/// Light around each pixel, by frame from the stop on and filter.
type Light = Vec<Vec<Vec<f32>>>;

pub fn run(lab: &Lab, folder: &Path) -> Result<Findings> {
    let came = light(lab, Run { moves: true, ..Run::default() })?;
    let mut others = vec![light(lab, Run { moves: true, forgets: true, ..Run::default() })?];
    for numbers in 0..STANDING {
        others.push(light(lab, Run { numbers, ..Run::default() })?);
    }
    let noise = light(lab, Run { numbers: STANDING, ..Run::default() })?;
    let (mut shares, mut floors) = (Vec::new(), Vec::new());
    for (filter, name) in FILTERS.iter().enumerate() {
        let frames_of = |light: &Light| -> Vec<_> {
            let frames = light.iter().enumerate();
            frames.map(|(frame, light)| excess(&light[filter], others.iter().map(|other| &*other[frame][filter]))).collect()
        };
        let frames = frames_of(&came);
        for after in [0, GONE] {
            write_map(&folder.join(format!("{name}, {after} after.png")), lab.settings.size, &frames[after])?;
        }
        shares.push(frames.iter().map(|frame| share(frame)).collect());
        floors.push(frames_of(&noise).iter().map(|frame| share(frame)).collect());
    }
    Ok(report(shares, &floors, lab.settings))
}

/// Of the frames from the stop on.
fn light(lab: &Lab, run: Run) -> Result<Light> {
    let options = SceneOptions { static_objects: true, ..SceneOptions::default() };
    let scene = Arc::new(Scene::load(SCENE, &options)?);
    let mut tracer = lab.tracer(&scene, TracerOptions::default())?;
    let mut filters = lab.start(&tracer, &contenders::named(&FILTERS))?;
    let pose = |index: u32| if run.moves { index.min(STOP) } else { STOP };
    lab.bar.inc_length(u64::from(STOP + AFTER + 1));
    let mut light = Vec::new();
    for index in 0..=STOP + AFTER {
        let [now, before] = [index, index.saturating_sub(1)].map(|index| scene.moment(pose(index)));
        let numbers = if index < STOP { run.numbers * (STOP + AFTER + 1) } else { 0 };
        tracer.begin_moment(index + numbers, &now, &before)?;
        if run.forgets && index == STOP {
            filters.iter_mut().for_each(|filter| filter.denoiser.reset(ResetReason::CameraCut));
        }
        running::denoise(lab.gpu, &mut tracer, &mut filters)?;
        if index >= STOP {
            let Frame { denoised, extent, .. } = running::read(lab.gpu, &tracer, &mut filters)?;
            light.push(denoised.iter().map(|denoised| luminance_around(&denoised.radiance, extent, WINDOW)).collect());
        }
        lab.bar.inc(1);
    }
    Ok(light)
}

/// Of the light of each place, over the most that it is in any of the other runs: what is as bright in one of them is noise, or a bright
/// neighbour that a filter without a history takes in, and no ghost.
fn excess<'a>(came: &[f32], others: impl Iterator<Item = &'a [f32]>) -> Vec<f32> {
    let mut most = vec![f32::MIN_POSITIVE; came.len()];
    for other in others {
        most.iter_mut().zip(other).for_each(|(most, light)| *most = most.max(*light));
    }
    came.iter().zip(most).map(|(came, most)| came / most - 1.0).collect()
}

/// Per cent of the pixels that show what was there before.
fn share(excess: &[f32]) -> f64 {
    100.0 * excess.iter().filter(|excess| **excess > SHOWS).count() as f64 / excess.len() as f64
}

/// Red where a place is too bright, blue where it is too dark; full at its own light too much or too little.
fn write_map(path: &Path, [width, height]: [u32; 2], excess: &[f32]) -> Result<()> {
    let colour = |excess: &f32| [*excess, 0.0, -*excess].map(|value| (255.0 * value.clamp(0.0, 1.0) + 0.5) as u8);
    Ok(Picture::from_pixels(width, height, excess.iter().map(colour).collect())?.write_png(path)?)
}

/// Of the share of each filter in each frame from the stop on, and of what noise alone gives.
fn report(shares: Vec<Vec<f64>>, floors: &[Vec<f64>], settings: &Settings) -> Findings {
    let headings: Vec<_> = (0..=AFTER).map(|frame| frame.to_string()).collect();
    let table = |title: &str, shares: &[Vec<f64>]| {
        let mut table = Figures::new(title, headings.iter().map(|heading| (heading.as_str(), 2)));
        FILTERS.iter().zip(shares).for_each(|(name, shares)| table.row(name, shares));
        table
    };
    let tables = vec![
        table("% of the pixels, frames after the stop", &shares),
        table("the same of a camera that always stood there, with random numbers of its own", floors),
    ];
    let named = FILTERS.iter().zip(&shares);
    let claims = named.filter(|(name, _)| [ASVGF, BEST].contains(name)).map(|(name, shares)| Claim {
        text: format!("% of the pixels that show a highlight of {GONE} frames ago, {name}"),
        scene: SCENE.into(),
        ratio: shares[GONE],
        bound: 0.0,
        accepted: 0.0,
    });
    Findings {
        title: "Highlights behind a camera that stops".into(),
        text: format!(
            "`{SCENE}`, {}x{}: the camera moves up to frame {STOP} and stays. Against {} runs in which it always stood there, with other random \
             numbers before the stop, and one in which all history was dropped at the stop: where the light of {side}x{side} pixels is more \
             than {:.0} % brighter than in all of them.",
            settings.size[0],
            settings.size[1],
            STANDING,
            100.0 * SHOWS,
            side = 2 * WINDOW + 1
        ),
        claims: claims.collect(),
        tables,
        curves: vec![Lines {
            title: "% of the pixels that show a highlight of before".into(),
            first_frame: STOP,
            series: FILTERS.iter().zip(shares).map(|(name, shares)| ((*name).to_owned(), shares)).collect(),
        }],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_that_is_too_bright_counts_and_noise_does_not() {
        let mut light = vec![[1.0; 3]; 256];
        let smoothed = |light: &[[f32; 3]]| luminance_around(light, [16; 2], WINDOW);
        let stayed = smoothed(&light);
        let shown = |light: &[[f32; 3]]| share(&excess(&smoothed(light), [&*stayed].into_iter())) * 2.56;
        light[8 * 16 + 8] = [6.0; 3];
        assert_eq!(shown(&light), 0.0, "one pixel is a fifth too much in 5x5");
        light[8 * 16 + 9] = [6.0; 3];
        assert_eq!(shown(&light).round(), 20.0, "both are in 4x5 windows");
    }

    #[test]
    fn what_another_run_shows_as_well_is_no_ghost() {
        let others: [&[f32]; 3] = [&[1.0, 1.0, 2.0, 1.0], &[2.0, 1.0, 1.0, 1.0], &[1.0, 1.0, 1.0, 1.5]];
        assert_eq!(excess(&[2.0, 2.0, 2.0, 3.0], others.into_iter()), [0.0, 1.0, 0.0, 1.0]);
    }

    #[test]
    fn a_ghost_of_four_frames_is_a_claim_that_fails() {
        let still = |left: f64| vec![vec![9.0, 5.0, 2.0, 1.0, left, 0.0, 0.0, 0.0, 0.0]; FILTERS.len()];
        let failed =
            |left| report(still(left), &still(0.0), &Settings::default()).claims.iter().filter(|claim| !claim.holds()).count();
        assert_eq!((failed(0.0), failed(0.1)), (0, 2));
    }
}
