//! A lamp that is hit ever more rarely from left to right: what the estimate of the variance leaves of stripes of light.

use std::path::Path;
use std::sync::Arc;

use crate::Result;
use atrous::config::Preset;
use atrous::executor::{HeadlessDevice, Session, SessionOptions};
use atrous::{Config, FrameParams, Tuning};

use super::{Figures, Findings};
use crate::evaluate::contenders::{ASVGF, BEST, NOISY, SVGF};
use crate::evaluate::scene::Lab;

const EXTENT: [u32; 2] = [320, 64];
/// Of the last of these the pictures are measured.
const FRAMES: u32 = 48;
const MEASURED: u32 = 8;
/// Rows of a stripe.
const STRIPE: u32 = 8;
/// Light of the dark stripes and of the bright ones.
const LIGHT: [f32; 2] = [1.0, 2.0];
/// Parts of the picture, from often hit to rarely hit.
const PARTS: usize = 4;

type Picture = Vec<[f32; 4]>;

/// A filter, with its numbers.
struct Filter {
    name: &'static str,
    preset: Preset,
    tuning: Tuning,
}

fn filters() -> Vec<Filter> {
    let filter = |name, preset| Filter { name, preset, tuning: Tuning::for_preset(preset) };
    let spatial = filter("SVGF, spatial variance alone", Preset::Svgf);
    // More frames than there are.
    let spatial = Filter { tuning: Tuning { spatial_variance_frames: 64.0, ..spatial.tuning }, ..spatial };
    vec![spatial, filter(SVGF, Preset::Svgf), filter(ASVGF, Preset::Asvgf), filter(BEST, Preset::Best)]
}

pub fn run(lab: &Lab, _: &Path) -> Result<Findings> {
    lab.bar.inc_length(filters().len() as u64);
    let mut columns: Vec<_> = (0..PARTS).map(|part| (format!("contrast, {}", range(part)), 3)).collect();
    columns.extend((0..PARTS).map(|part| (format!("noise, {}", range(part)), 3)));
    let mut table = Figures::new("a", columns.iter().map(|(name, decimals)| (name.as_str(), *decimals)));
    let first = FRAMES - MEASURED;
    table.row(NOISY, &Stripes::of((first..FRAMES).map(|frame| noisy(frame, lab.settings.seed))).values());
    let gpu = lab.headless()?;
    for filter in filters() {
        table.row(filter.name, &filtered(&gpu, lab.settings.seed, &filter)?.values());
        lab.bar.inc(1);
    }
    Ok(Findings {
        title: "Variance over time and over space: [SVGF] Fig. 9".into(),
        text: format!(
            "A wall in stripes of {STRIPE} rows, lit by {} and {}. A sample is 0 with the probability a, which rises from 0 on the left to 1 on \
             the right, else 1/(1 − a) times the light. Of the last {MEASURED} of {FRAMES} frames the difference of the stripes, 1 in the \
             reference, and the standard deviation within stripes, 0 there. The spatial estimate takes stripes for noise and blurs them.",
            LIGHT[0], LIGHT[1]
        ),
        tables: vec![table],
        ..Findings::default()
    })
}

fn range(part: usize) -> String {
    format!("a to {:.2}", (part + 1) as f32 / PARTS as f32)
}

/// 0: dark, 1: bright.
fn stripe_of(y: u32) -> usize {
    (y / STRIPE % 2) as usize
}

fn light_of(y: u32) -> f32 {
    LIGHT[stripe_of(y)]
}

/// \[SVGF\] Fig. 9: 0 for a random number below a, else 1 / (1 − a).
fn noisy(frame: u32, seed: u32) -> Picture {
    let mut random = fastrand::Rng::with_seed(u64::from(seed) << 32 | u64::from(frame));
    let pixels = (0..EXTENT[1]).flat_map(|y| (0..EXTENT[0]).map(move |x| (x, y)));
    let texel = |(x, y)| {
        let a = x as f32 / EXTENT[0] as f32;
        let value = if random.f32() < a { 0.0 } else { light_of(y) / (1.0 - a) };
        [value, value, value, 1.0]
    };
    pixels.map(texel).collect()
}

fn filtered(gpu: &Arc<HeadlessDevice>, seed: u32, filter: &Filter) -> Result<Stripes> {
    let config = Config { preset: filter.preset, surface_id: false, ..Config::new(EXTENT) };
    let mut session = Session::new(gpu.clone(), config.declare()?, SessionOptions::default())?;
    let count = (EXTENT[0] * EXTENT[1]) as usize;
    let (depth, normal) = (vec![[4.0, 0.0, 0.0, 0.0]; count], vec![[0.0, 0.0, 1.0, 0.0]; count]);
    let mut pictures = Vec::new();
    for frame in 0..FRAMES {
        session.upload("depth", &depth)?;
        session.upload("normal", &normal)?;
        session.upload("noisy_radiance", &noisy(frame, seed))?;
        session.run(&FrameParams::new(EXTENT), &filter.tuning)?;
        if frame + MEASURED >= FRAMES {
            pictures.push(session.download("denoised_radiance")?);
        }
    }
    Ok(Stripes::of(pictures.into_iter()))
}

/// Sums over the pixels of dark and of bright stripes, for each part of the picture.
#[derive(Default)]
struct Stripes([[Sum; 2]; PARTS]);

#[derive(Clone, Copy, Default)]
struct Sum {
    count: f64,
    values: f64,
    squares: f64,
}

impl Sum {
    fn mean(&self) -> f64 {
        self.values / self.count
    }

    fn deviation(&self) -> f64 {
        (self.squares / self.count - self.mean().powi(2)).max(0.0).sqrt()
    }
}

impl Stripes {
    fn of(pictures: impl Iterator<Item = Picture>) -> Self {
        let mut stripes = Self::default();
        for (i, texel) in pictures.flat_map(|picture| picture.into_iter().enumerate()) {
            let (x, y) = (i as u32 % EXTENT[0], i as u32 / EXTENT[0]);
            let sum = &mut stripes.0[x as usize * PARTS / EXTENT[0] as usize][stripe_of(y)];
            let value = f64::from(texel[0]);
            (sum.count, sum.values, sum.squares) = (sum.count + 1.0, sum.values + value, sum.squares + value * value);
        }
        stripes
    }

    /// Contrast of every part, then noise of every part.
    fn values(&self) -> Vec<f64> {
        let contrast = self.0.iter().map(|[dark, bright]| (bright.mean() - dark.mean()) / f64::from(LIGHT[1] - LIGHT[0]));
        contrast.chain(self.0.iter().map(|[dark, bright]| 0.5 * (dark.deviation() + bright.deviation()))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_are_as_bright_in_the_mean_as_the_light() {
        let values = Stripes::of((0..64).map(|frame| noisy(frame, 0))).values();
        for (part, contrast) in values[..PARTS].iter().enumerate() {
            assert!((contrast - 1.0).abs() < 0.2, "part {part}: {contrast}");
        }
        assert!(values[PARTS..].windows(2).all(|pair| pair[0] < pair[1]), "rarer light is noisier: {values:?}");
    }

    #[test]
    fn stripes_that_are_blurred_by_half_have_half_the_contrast() {
        let picture = (0..EXTENT[0] * EXTENT[1]).map(|i| [1.25 + 0.5 * (light_of(i / EXTENT[0]) - 1.0); 4]).collect();
        assert_eq!(Stripes::of(std::iter::once(picture)).values(), [0.5, 0.5, 0.5, 0.5, 0.0, 0.0, 0.0, 0.0]);
    }
}
