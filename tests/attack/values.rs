//! Values that no renderer should give.

use super::{configs, plain, presets, Wall, LIGHT};
use crate::graphs::dice::Dice;
use crate::support::{assert_valid, soak};
use atrous::Tuning;

const EXTENT: [u32; 2] = [19, 17];

/// Values that are not finite, and such as are.
const BAD: [f32; 5] = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e-40, 65504.0];

/// Frames of good input after which what is not finite has left no trace.
const FRAMES_TO_HEAL: u32 = 5;

/// What an input holds in the bad frame.
#[derive(Clone, Copy, Debug)]
enum Spoilt {
    Pixel(f32),
    Frame(f32),
}

impl Spoilt {
    fn is_finite(self) -> bool {
        let (Self::Pixel(value) | Self::Frame(value)) = self;
        value.is_finite()
    }

    fn texels(self, name: &str, count: usize) -> Vec<[f32; 4]> {
        let mut texels = vec![plain(name); count];
        match self {
            Self::Pixel(value) => texels[count / 2] = [value; 4],
            Self::Frame(value) => texels.fill([value; 4]),
        }
        texels
    }
}

/// Runs a bad frame between good ones. In how many of the good ones a pixel did not show the light, counted from the bad one.
fn frames_until_healed(wall: &mut Wall, (name, count): (&str, usize), spoilt: Spoilt, good: u32, what: &str) -> u32 {
    let tuning = Tuning::default();
    wall.session.invalidate();
    for _ in 0..3 {
        wall.frame(|_| {}, &tuning, what);
    }
    wall.session.upload(name, &spoilt.texels(name, count)).expect(what);
    wall.frame(|_| {}, &tuning, what);
    wall.session.upload(name, &vec![plain(name); count]).expect(what);
    let ill = (1..=good).filter(|_| !shows_light(&wall.frame(|_| {}, &tuning, what), 0.15));
    ill.last().unwrap_or(0)
}

/// Inputs that hold samples of light.
fn light(wall: &Wall) -> Vec<(String, usize)> {
    let is_light =
        |(name, _): &&(String, usize)| name.starts_with("noisy_") && !name.ends_with("visibility") || name.starts_with("other_");
    wall.inputs.iter().filter(is_light).cloned().collect()
}

/// Whether every pixel shows the light, within a share of it.
fn shows_light(texels: &[[f32; 4]], tolerance: f32) -> bool {
    texels.iter().flat_map(|texel| &texel[..3]).all(|c| (c / LIGHT - 1.0).abs() < tolerance)
}

pub fn a_hundred_bad_frames_are_forgotten_within_a_few() {
    const BAD_FRAMES: u32 = 100;
    for config in presets(EXTENT) {
        let mut wall = Wall::new(&config);
        let tuning = Tuning::default();
        let name_of = format!("{} {} {}", config.preset, config.signals, config.gradient_source);
        // With a history before them, and with none.
        for good in [3, 0] {
            wall.session.invalidate();
            for _ in 0..good {
                wall.frame(|_| {}, &tuning, &name_of);
            }
            let light = light(&wall);
            for (name, count) in &light {
                wall.session.upload(name, &vec![[f32::NAN; 4]; *count]).expect(name);
            }
            for _ in 0..BAD_FRAMES {
                wall.frame(|_| {}, &tuning, &name_of);
            }
            for (name, count) in &light {
                wall.session.upload(name, &vec![plain(name); *count]).expect(name);
            }
            let healed = (1..=FRAMES_TO_HEAL).find(|_| shows_light(&wall.frame(|_| {}, &tuning, &name_of), 0.02));
            println!("{name_of}: {good} good frames, {BAD_FRAMES} bad ones, healed after {healed:?}");
            assert!(healed.is_some(), "{name_of}: not healed after {FRAMES_TO_HEAL} frames");
        }
    }
    assert_valid();
}

/// A host whose every fourth sample is not finite loses samples, and no light.
pub fn samples_that_are_not_finite_take_no_light() {
    for (number, config) in (0..).zip(presets(EXTENT)) {
        let mut wall = Wall::new(&config);
        let mut dice = Dice::new(number);
        let name_of = format!("{} {} {}", config.preset, config.signals, config.gradient_source);
        for share in [10, 4] {
            wall.session.invalidate();
            for (name, count) in light(&wall) {
                wall.session.upload(&name, &vec![plain(&name); count]).expect(&name);
            }
            // Corners may have no sample around them, and then show their past.
            wall.frame(|_| {}, &Tuning::default(), &name_of);
            for frame in 0..8 {
                for (name, count) in light(&wall) {
                    let bad = BAD[dice.below(3) as usize];
                    let texel = |_| if dice.below(share) == 0 { [bad; 4] } else { plain(&name) };
                    wall.session.upload(&name, &(0..count).map(texel).collect::<Vec<_>>()).expect(&name);
                }
                let what = format!("{name_of}, frame {frame}, one of {share}");
                assert!(shows_light(&wall.frame(|_| {}, &Tuning::default(), &what), 0.01), "{what}: light is lost");
            }
        }
    }
    assert_valid();
}

pub fn bad_values_are_forgotten_within_a_few_frames() {
    for (number, config) in (0..).zip(configs(EXTENT)) {
        let mut wall = Wall::new(&config);
        let mut dice = Dice::new(number);
        let mut worst = 0;
        let name_of = format!("{} {} {}", config.preset, config.signals, config.gradient_source);
        for (name, count) in wall.inputs.clone() {
            let all = BAD.into_iter().flat_map(|value| [Spoilt::Pixel(value), Spoilt::Frame(value)]);
            let all: Vec<_> = all.filter(|_| soak::is_on() || dice.below(16) == 0).collect();
            for spoilt in all {
                let what = format!("{name_of}, {name}, {spoilt:?}");
                let frames = frames_until_healed(&mut wall, (&name, count), spoilt, FRAMES_TO_HEAL + 1, &what);
                // What is finite is light like any other: it fades as the tunables say.
                if !spoilt.is_finite() {
                    assert!(frames <= FRAMES_TO_HEAL, "{what}: a trace is left after {frames} frames");
                    worst = worst.max(frames);
                }
            }
        }
        println!("{name_of}: without a trace after {worst} frames, {FRAMES_TO_HEAL} are allowed");
    }
    assert_valid();
}
