//! Pictures of display size from light of fewer pixels, against the filter at display size.

use std::path::Path;
use std::sync::Arc;

use crate::Result;
use ash::vk::Extent2D;
use atrous::config::{PostProcess, Preset};
use atrous_engine::{DenoiserOptions, PathTracer, Scene, SceneOptions, TracerOptions};
use atrous_lab::pictures::Picture;
use atrous_lab::scores::{tone_map, unbiased_rmse, Rgb};

use super::{Figures, Findings};
use crate::evaluate::claims::Claim;
use crate::evaluate::contenders::NOISY;
use crate::evaluate::scene::Lab;
use crate::measure::{rgb, Denoised, Frame, Scores};
use crate::running::{self, Running};

/// Patterns as fine as pixels under a moving camera, thin railings and edges of shadows, things that move.
const SCENES: [&str; 3] = ["tiles", "hall", "pillars"];
/// Frames that are measured: each takes a reference of many positions in the pixel.
const MEASURED: u32 = 4;

const AT_DISPLAY: &str = "best at display size";
const BOUND: &str = "best at display size, gathered";
const HALF: &str = "light of half the size, gathered";
const HALF_ALONE: &str = "light of half the size, not gathered";
const LOW: [&str; 2] = ["1 / 2 of the size, gathered", "1 / 1.5 of the size, gathered"];
const ENLARGED: [&str; 2] = ["1 / 2 of the size, bilinear", "1 / 1.5 of the size, bilinear"];
const ROWS: [&str; 9] = [NOISY, AT_DISPLAY, BOUND, HALF, HALF_ALONE, LOW[0], ENLARGED[0], LOW[1], ENLARGED[1]];

/// What a row means over the frames.
#[derive(Clone, Copy, Default)]
struct Means {
    /// RMSE of tone-mapped values.
    tm: f64,
    ssim: f64,
    flip: f64,
    temporal: f64,
}

/// A tracer with a filter, and the rows that its outputs make.
struct Way {
    tracer: PathTracer,
    filter: [Running; 1],
    outputs: &'static [(&'static str, &'static str)],
}

pub fn run(lab: &Lab, folder: &Path) -> Result<Findings> {
    let mut tables = Vec::new();
    let mut claims = Vec::new();
    for name in SCENES {
        let means = on_scene(lab, name, folder)?;
        tables.push(table(name, &means));
        claims.extend(claims_of(name, &means));
    }
    let [width, height] = lab.settings.size;
    Ok(Findings {
        title: "Pictures of display size".into(),
        text: format!(
            "{width}x{height}, `best`, means of the last frames; `tm`: RMSE of tone-mapped values. References are means over the pixel. Gathered: \
             jittered frames, by `Config::output_extent`."
        ),
        tables,
        claims,
        ..Findings::default()
    })
}

fn ways(lab: &Lab, scene: &Arc<Scene>) -> Result<Vec<Way>> {
    let display = lab.settings.size;
    let way = |size: [u32; 2], options: TracerOptions, outputs: &'static [(&'static str, &'static str)]| -> Result<Way> {
        let options = TracerOptions { seed: lab.settings.seed, noise: lab.settings.noise, ..options };
        let tracer = PathTracer::new(lab.gpu, scene, Extent2D { width: size[0], height: size[1] }, options)?;
        let filter = DenoiserOptions::new(Preset::Best).with(|config| {
            config.post_process = PostProcess::None;
            config.output_extent = options.jitter.then_some(display);
        });
        Ok(Way { filter: [Running::new(lab.gpu, &tracer, outputs[0].0, &filter)?], tracer, outputs })
    };
    let still = TracerOptions::default();
    let jittered = TracerOptions { jitter: true, ..still };
    let share = |of: f32| display.map(|side| (side as f32 / of) as u32);
    Ok(vec![
        way(display, still, &[(AT_DISPLAY, "denoised_radiance")])?,
        way(display, jittered, &[(BOUND, "upscaled_radiance")])?,
        way(
            display,
            TracerOptions { half_light: true, ..jittered },
            &[(HALF, "upscaled_radiance"), (HALF_ALONE, "denoised_radiance")],
        )?,
        way(share(2.0), jittered, &[(LOW[0], "upscaled_radiance"), (ENLARGED[0], "denoised_radiance")])?,
        way(share(1.5), jittered, &[(LOW[1], "upscaled_radiance"), (ENLARGED[1], "denoised_radiance")])?,
    ])
}

fn on_scene(lab: &Lab, name: &str, folder: &Path) -> Result<Vec<Means>> {
    let scene = Arc::new(Scene::load(name, &SceneOptions::default())?);
    let mut ways = ways(lab, &scene)?;
    let measured = lab.settings.measured.clamp(2, MEASURED);
    lab.bar.inc_length(u64::from(lab.settings.frames + measured));
    let mut frames = Vec::new();
    for index in 0..lab.settings.frames {
        for way in &mut ways {
            running::render(lab.gpu, &mut way.tracer, &mut way.filter, index)?;
        }
        if index + measured >= lab.settings.frames {
            frames.push(read(lab, &mut ways)?);
        }
        lab.bar.inc(1);
    }
    let options = TracerOptions { jitter: true, ..TracerOptions::default() };
    let mut tracer = lab.tracer(&scene, options)?;
    let mut sums = vec![Means::default(); ROWS.len()];
    for i in 0..frames.len() {
        let halves = lab.references.of_display(&mut tracer, &scene, frames[i].index)?;
        frames[i].set_halves(halves);
        let (before, now) = frames.split_at(i);
        for (sum, own) in sums.iter_mut().zip(means(&now[0], before.last())?) {
            let share = |value: f64, of: usize| value / of as f64;
            sum.tm += share(own.tm, measured as usize);
            sum.ssim += share(own.ssim, measured as usize);
            sum.flip += share(own.flip, measured as usize);
            // The first frame has none before it.
            sum.temporal += if own.temporal.is_nan() { 0.0 } else { share(own.temporal, measured as usize - 1) };
        }
        lab.bar.inc(1);
    }
    if let Some(last) = frames.last() {
        write_pictures(name, last, folder)?;
    }
    Ok(sums)
}

/// The frame at display size without jitter, whose guides say what moves, with the pictures of all others.
fn read(lab: &Lab, ways: &mut [Way]) -> Result<Frame> {
    let display = lab.settings.size;
    let (first, others) = ways.split_at_mut(1);
    let mut frame = running::read(lab.gpu, &first[0].tracer, &mut first[0].filter)?;
    for way in others {
        let (extent, jitter) = (way.tracer.extent(), way.tracer.camera(way.tracer.frame()).jitter);
        for (_, output) in way.outputs {
            let pixels = rgb(way.filter[0].denoiser.read(output)?);
            let radiance = match pixels.len() == frame.noisy.len() {
                true => pixels,
                false => enlarged(&pixels, [extent.width, extent.height], display, jitter),
            };
            frame.denoised.push(Denoised { radiance, views: Vec::new() });
        }
    }
    Ok(frame)
}

/// Bilinear. The sample of a small pixel lies at its middle plus the jitter, in small pixels.
fn enlarged(pixels: &[[f32; 3]], from: [u32; 2], to: [u32; 2], jitter: [f32; 2]) -> Vec<[f32; 3]> {
    let place = |p: u32, axis: usize| {
        let at = (p as f32 + 0.5) * from[axis] as f32 / to[axis] as f32 - 0.5 - jitter[axis];
        let at = at.clamp(0.0, from[axis] as f32 - 1.0);
        let low = (at as u32).min(from[axis].saturating_sub(2));
        (low, (low + 1).min(from[axis] - 1), at - low as f32)
    };
    let texel = |x: u32, y: u32| pixels[(y * from[0] + x) as usize];
    let mix = |a: [f32; 3], b: [f32; 3], t: f32| [0, 1, 2].map(|c| a[c] + (b[c] - a[c]) * t);
    let pixel = |x: u32, y: u32| {
        let ((x0, x1, u), (y0, y1, v)) = (place(x, 0), place(y, 1));
        mix(mix(texel(x0, y0), texel(x1, y0), u), mix(texel(x0, y1), texel(x1, y1), u), v)
    };
    (0..to[1]).flat_map(|y| (0..to[0]).map(move |x| (x, y))).map(|(x, y)| pixel(x, y)).collect()
}

/// Of each of [`ROWS`].
fn means(frame: &Frame, before: Option<&Frame>) -> Result<Vec<Means>> {
    let (Some(scores), Some(halves)) = (frame.scores(before)?, &frame.halves) else { return Ok(Vec::new()) };
    let [width, height] = frame.extent;
    let toned = |pixels: &[[f32; 3]]| pixels.iter().map(|pixel| pixel.map(tone_map)).collect::<Vec<_>>();
    let halves = halves.each_ref().map(|half| toned(half));
    let halves = [Rgb::new(width, height, &halves[0])?, Rgb::new(width, height, &halves[1])?];
    let of = |(picture, scores): (&[[f32; 3]], &Scores)| {
        let tm = unbiased_rmse(Rgb::new(width, height, &toned(picture))?, halves)?;
        Ok(Means { tm, ssim: scores.ssim, flip: scores.flip, temporal: scores.temporal_error })
    };
    frame.pictures().zip(&scores).map(of).collect()
}

fn write_pictures(scene: &str, frame: &Frame, folder: &Path) -> Result<()> {
    let [width, height] = frame.extent;
    let reference = frame.reference.iter().map(|reference| ("reference", &reference[..]));
    for (name, pixels) in ROWS.into_iter().zip(frame.pictures()).chain(reference) {
        let file = format!("{scene}, {}.png", name.replace(" / ", " of "));
        Picture::from_linear(width, height, pixels, 1.0)?.write_png(folder.join(file))?;
    }
    Ok(())
}

fn table(scene: &str, means: &[Means]) -> Figures {
    let columns =
        [("tm", 4), ("SSIM", 3), ("FLIP", 3), ("temporal", 4), ("tm to the bound", 2), ("SSIM", 3), ("FLIP", 2), ("temporal", 2)];
    let mut table = Figures::new(scene, columns);
    let bound = row(means, BOUND);
    for (name, own) in ROWS.iter().zip(means) {
        let to_bound = [own.tm / bound.tm, own.ssim - bound.ssim, own.flip / bound.flip, own.temporal / bound.temporal];
        table.row(name, &[[own.tm, own.ssim, own.flip, own.temporal], to_bound].concat());
    }
    table
}

fn row(means: &[Means], name: &str) -> Means {
    ROWS.iter().position(|row| *row == name).and_then(|i| means.get(i)).copied().unwrap_or_default()
}

fn claims_of(scene: &str, means: &[Means]) -> Vec<Claim> {
    let (plain, gathered, half) = (row(means, AT_DISPLAY), row(means, BOUND), row(means, HALF));
    let claim =
        |text: &str, ratio: f64, bound: f64| Claim { text: text.into(), scene: scene.into(), ratio, bound, accepted: bound };
    vec![
        claim("tm of light of half the size to that of light of every pixel, both gathered", half.tm / gathered.tm, 1.28),
        claim("tm of `best` gathered to that without", gathered.tm / plain.tm, 0.68),
        claim("SSIM lost to `best` without gathering, plus .028", plain.ssim - gathered.ssim + 0.028, 0.0),
        claim("FLIP of `best` gathered to that without", gathered.flip / plain.flip, 0.9),
        claim("temporal error of `best` gathered to that without", gathered.temporal / plain.temporal, 0.6),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_enlarged_slope_stays_one_and_follows_the_jitter() {
        let slope: Vec<_> = (0..8).flat_map(|_| (0..8).map(|x| [x as f32; 3])).collect();
        let large = enlarged(&slope, [8, 8], [16, 16], [0.25, 0.0]);
        // The middle of large pixel 7 is at 3.75 small pixels, where the sample of pixel 3 is.
        assert!((large[8 * 16 + 7][0] - 3.0).abs() < 1e-6, "{:?}", large[8 * 16 + 7]);
        assert_eq!((large[0][0], large[15][0]), (0.0, 7.0), "nothing is beyond the border");
    }
}
