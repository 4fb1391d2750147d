//! Values that no renderer should give.

use super::{configs, plain, Wall, LIGHT};
use crate::graphs::dice::Dice;
use crate::support::{assert_valid, soak};
use atrous::Tuning;

const EXTENT: [u32; 2] = [19, 13];

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
    let shows_light = |texel: &[f32; 4]| texel[..3].iter().all(|c| (c / LIGHT - 1.0).abs() < 0.15);
    let ill = (1..=good).filter(|_| !wall.frame(|_| {}, &tuning, what).iter().all(shows_light));
    ill.last().unwrap_or(0)
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
