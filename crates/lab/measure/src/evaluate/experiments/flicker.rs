//! A lamp that flickers in a part of the picture: who loses history where nothing changed, and how wrong the part is that did.

use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use crate::measure::luminance_around;
use crate::Result;
use atrous_engine::{FrameDenoiser, Scene, SceneOptions, TracerOptions};
use atrous_lab::pictures::Picture;
use atrous_lab::scores::{rmse, Rgb};

use super::{Figures, Findings};
use crate::evaluate::claims::Claim;
use crate::evaluate::contenders::{self, Contender, ASVGF, BEST, SVGF};
use crate::evaluate::scene::Lab;
use crate::running;

/// Frames in which the lamp of the scene is bright, then dim.
const STEP: u32 = 6;
/// Relative change of light from which on a pixel is inside.
const INSIDE: f32 = 0.1;
/// Relative change of light up to which a pixel is outside. From a change of 0.02 on λ is above 0.1 by its definition: `gradient_scale` is 5.
const OUTSIDE: f32 = 0.01;
/// Half the side of the square that light is averaged over before it is compared: references have noise.
const WINDOW: i32 = 3;
/// λ from which on history counts as lost.
const LOST: f32 = 0.1;

pub fn run(lab: &Lab, folder: &Path) -> Result<Findings> {
    let options = SceneOptions { static_objects: true, ..SceneOptions::default() };
    let scene = Arc::new(Scene::load("lamps", &options)?);
    // One period, behind as many frames as it takes for histories to be long.
    let frames = if lab.settings.frames < 32 { STEP..3 * STEP } else { 4 * STEP..6 * STEP };
    lab.bar.inc_length(u64::from(frames.end) + 2);
    let mut tracer = lab.tracer(&scene, TracerOptions::default())?;
    let contenders = contenders::named(&[SVGF, ASVGF, "percentile", BEST]);
    let mut filters = lab.start(&tracer, &contenders)?;
    let mut measured: Vec<Measured> = contenders.iter().map(|_| Measured::default()).collect();
    let mut pictures = Vec::new();
    for index in 0..frames.end {
        running::render(lab.gpu, &mut tracer, &mut filters, index)?;
        if frames.contains(&index) {
            for (filter, measured) in filters.iter_mut().zip(&mut measured) {
                measured.lambda.push(lambda(&mut filter.denoiser)?);
            }
            pictures.push(running::read(lab.gpu, &tracer, &mut filters)?);
        }
        lab.bar.inc(1);
    }
    let mut of_frame = |frame| {
        lab.bar.inc(1);
        lab.references.seeded(&mut tracer, &scene, frame, 0)
    };
    let references = [of_frame(0)?, of_frame(STEP)?];
    let change = change(&references, pictures[0].extent);
    let inside: Vec<_> = (0..change.len()).filter(|pixel| change[*pixel] >= INSIDE).collect();
    for picture in &pictures {
        let reference = &references[(picture.index / STEP % 2) as usize];
        for (denoised, measured) in picture.denoised.iter().zip(&mut measured) {
            measured.errors.push(error(&denoised.radiance, reference, &inside)?);
        }
    }
    write_maps(folder, pictures[0].extent, &contenders, &measured, &change)?;
    Ok(report(&contenders, &measured, &change, frames))
}

/// Grey values of λ in the first frame, in which the lamp steps, and ten times the change of light.
fn write_maps(
    folder: &Path,
    [width, height]: [u32; 2],
    contenders: &[Contender],
    measured: &[Measured],
    change: &[f32],
) -> Result<()> {
    let write = |name: &str, values: &[f32], scale: f32| -> Result<()> {
        let grey = values.iter().map(|value| [(255.0 * (scale * value).clamp(0.0, 1.0) + 0.5) as u8; 3]);
        Ok(Picture::from_pixels(width, height, grey.collect())?.write_png(folder.join(format!("{name}.png")))?)
    };
    write("change", change, 10.0)?;
    let mut with_lambda = contenders.iter().zip(measured).filter(|(_, measured)| !measured.lambda[0].is_empty());
    with_lambda.try_for_each(|(contender, measured)| write(&format!("lambda_{}", contender.name), &measured.lambda[0], 1.0))
}

/// What is measured of a filter, for each frame.
#[derive(Default)]
struct Measured {
    /// λ by pixel; empty for a filter without.
    lambda: Vec<Vec<f32>>,
    /// Root mean square error inside.
    errors: Vec<f64>,
}

fn lambda(denoiser: &mut FrameDenoiser) -> Result<Vec<f32>> {
    if denoiser.executor().denoiser().declaration().find("history_confidence").is_none() {
        return Ok(Vec::new());
    }
    Ok(denoiser.read("history_confidence")?.into_iter().map(|[confidence, ..]| 1.0 - confidence).collect())
}

/// Relative change of light between two pictures by pixel, of means over a window.
fn change([bright, dim]: &[Vec<[f32; 3]>; 2], extent: [u32; 2]) -> Vec<f32> {
    let [bright, dim] = [bright, dim].map(|pixels| luminance_around(pixels, extent, WINDOW));
    let pairs = bright.into_iter().zip(dim);
    pairs.map(|(before, now)| (before - now).abs() / before.max(now).max(f32::MIN_POSITIVE)).collect()
}

fn error(image: &[[f32; 3]], reference: &[[f32; 3]], pixels: &[usize]) -> Result<f64> {
    let of = |image: &[[f32; 3]]| pixels.iter().map(|i| image[*i]).collect::<Vec<_>>();
    let (image, reference, count) = (of(image), of(reference), pixels.len() as u32);
    Ok(rmse(Rgb::new(count, 1, &image)?, Rgb::new(count, 1, &reference)?)?)
}

/// Share of the pixels for which something holds, among those that count.
fn share(values: &[f32], counts: impl Fn(usize) -> bool, holds: impl Fn(f32) -> bool) -> f64 {
    let counted: Vec<_> = values.iter().enumerate().filter(|(pixel, _)| counts(*pixel)).collect();
    counted.iter().filter(|(_, value)| holds(**value)).count() as f64 / counted.len() as f64
}

fn report(contenders: &[Contender], measured: &[Measured], change: &[f32], frames: Range<u32>) -> Findings {
    let is_step = |frame: u32| frame.is_multiple_of(STEP);
    let squares = |errors: &[f64]| (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt();
    let columns = [
        ("λ > 0.1 outside, step", 2),
        ("λ > 0.1 inside, step", 2),
        ("λ > 0.1, other frames", 2),
        ("RMSE inside", 4),
        ("of SVGF's", 3),
    ];
    let mut table = Figures::new("lamps, one flickers; % of the pixels", columns);
    let mut claims = Vec::new();
    let of_svgf = squares(&measured[0].errors);
    for (contender, measured) in contenders.iter().zip(measured) {
        let steps =
            |step: bool| frames.clone().zip(&measured.lambda).filter(move |(frame, l)| !l.is_empty() && is_step(*frame) == step);
        let mean = |values: Vec<f64>| values.iter().sum::<f64>() / values.len() as f64;
        let lost = |step: bool, counts: &dyn Fn(usize) -> bool| {
            mean(steps(step).map(|(_, lambda)| share(lambda, counts, |lambda| lambda > LOST)).collect())
        };
        let outside = lost(true, &|pixel| change[pixel] <= OUTSIDE);
        let inside = lost(true, &|pixel| change[pixel] >= INSIDE);
        let others = lost(false, &|_| true);
        let error = squares(&measured.errors);
        table.row(contender.name, &[100.0 * outside, 100.0 * inside, 100.0 * others, error, error / of_svgf]);
        if [ASVGF, BEST].contains(&contender.name) {
            // The picture of --quick is less than half as wide, and the band beside the wall between both halves is not narrower; its
            // histories are short.
            let accepted = if contender.name == BEST { 0.2 } else { 0.7 };
            claims.push(claim(format!("share outside that loses history, {}", contender.name), outside, [0.02, accepted]));
        }
        if contender.name == BEST {
            claims.push(claim(format!("RMSE inside of {} to that of SVGF", contender.name), error / of_svgf, [0.5; 2]));
        }
    }
    // A picture too small to have a part that nothing changes in.
    claims.retain(|claim: &Claim| claim.ratio.is_finite());
    let count = |holds: &dyn Fn(f32) -> bool| 100.0 * share(change, |_| true, holds);
    let text = format!(
        "Nothing moves; in frames {} to {} one of three lamps steps between 1 and 0.1 every {STEP} frames. By two references, \
         averaged over {side}x{side} pixels, light changes by at least {INSIDE} on {:.1} % of the pixels (inside), and by at most \
         {OUTSIDE} on {:.1} % (outside).",
        frames.start,
        frames.end - 1,
        count(&|change| change >= INSIDE),
        count(&|change| change <= OUTSIDE),
        side = 2 * WINDOW + 1,
    );
    let series = contenders.iter().zip(measured).map(|(c, m)| (c.name.to_owned(), m.errors.clone())).collect();
    let curves = vec![super::Lines { title: "RMSE inside".into(), first_frame: frames.start, series }];
    Findings { title: "A lamp that flickers in a part of the picture".into(), text, tables: vec![table], curves, claims }
}

fn claim(text: String, ratio: f64, [bound, accepted]: [f64; 2]) -> Claim {
    Claim { text, scene: "lamps".into(), ratio, bound, accepted }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_that_changes_is_inside_and_other_light_is_not() {
        let before = vec![[1.0; 3]; 32 * 16];
        let mut now = before.clone();
        now.iter_mut().enumerate().filter(|(i, _)| i % 32 >= 16).for_each(|(_, pixel)| *pixel = [0.5; 3]);
        let change = change(&[before, now], [32, 16]);
        assert_eq!((change[0], change[12]), (0.0, 0.0));
        assert!((change[31] - 0.5).abs() < 1e-6, "{}", change[31]);
        assert!(change[15] > 0.1 && change[15] < 0.5, "on the edge: {}", change[15]);
        assert_eq!(share(&change, |_| true, |c| c >= INSIDE), 18.0 / 32.0);
        assert_eq!(share(&change, |pixel| pixel % 32 < 13, |c| c > OUTSIDE), 0.0);
    }

    #[test]
    fn the_error_is_that_of_the_pixels_inside() {
        let (reference, mut image) = (vec![[1.0; 3]; 8], vec![[1.0; 3]; 8]);
        image[0] = [9.0; 3];
        image[5] = [1.5; 3];
        assert_eq!(error(&image, &reference, &[4, 5, 6, 7]).expect("finite"), 0.25);
    }
}
