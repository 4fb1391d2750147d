//! Parameters, extents and tunables at the ends of what is allowed.

use super::{presets, Wall, LIGHT};
use crate::graphs::dice::Dice;
use crate::support::{assert_valid, gpu, soak};
use atrous::config::{PostProcess, Preset};
use atrous::{Config, Tuning};

const EXTENT: [u32; 2] = [19, 17];

pub fn any_exposure_ratio_gives_a_picture() {
    for config in presets(EXTENT) {
        let mut wall = Wall::new(&config);
        for ratio in [1e-45, 1e-38, 1e-20, 0.5, 1e3, 1e20, 1e38, f32::MAX] {
            let what = format!("{} {}, exposure_ratio {ratio:e}", config.preset, config.signals);
            wall.session.invalidate();
            wall.frame(|_| {}, &Tuning::default(), &what);
            wall.frame(|params| params.exposure_ratio = ratio, &Tuning::default(), &what);
            let texels: Vec<_> = (0..5).map(|_| wall.frame(|_| {}, &Tuning::default(), &what)).last().expect("a frame");
            // History that was made too bright saturates, and fades as the tunables say; too dark, it is gone as fast as black is.
            let is_light = |texel: &[f32; 4]| texel[..3].iter().all(|c| (c / LIGHT - 1.0).abs() < 0.2);
            assert!(ratio > 1.0 || texels.iter().all(is_light), "{what}: {:?}", texels[0]);
        }
    }
    assert_valid();
}

pub fn any_extent_gives_a_picture() {
    let host = gpu();
    let host = host.host();
    // SAFETY: the handles are live and belong together.
    let limits = unsafe { host.instance.get_physical_device_properties(host.physical_device) }.limits;
    let longest = limits.max_image_dimension2_d.min(Config::MAX_SIDE);
    for preset in Preset::ALL {
        let mut extents = vec![[1, 1], [1, 3]];
        if soak::is_on() {
            extents.extend([[longest, 1], [1, longest], [longest, 3], [5, longest], [1023, 1], [1, 1025], [257, 129]]);
        } else if preset == Preset::Svgf {
            extents.extend([[longest, 1], [1, longest]]);
        }
        for extent in extents {
            let config = Config { preset, volume: soak::is_on(), ..Config::new(extent) };
            let mut wall = Wall::new(&config);
            for index in 0..2 {
                let texels = wall.frame(|_| {}, &Tuning::default(), &format!("{preset}, {extent:?}"));
                let lit = texels.iter().filter(|t| (t[0] / LIGHT - 1.0).abs() < 0.01).count();
                assert_eq!(lit, texels.len(), "{preset}, {extent:?}, frame {index}");
            }
        }
    }
    assert_valid();
}

pub fn a_picture_of_sky_alone_passes_untouched() {
    for config in presets(EXTENT) {
        let mut wall = Wall::new(&config);
        let pixels = (EXTENT[0] * EXTENT[1]) as usize;
        let what = format!("{} {}", config.preset, config.signals);
        wall.session.upload("depth", &vec![[0.0; 4]; pixels]).expect("depth");
        wall.session.upload_ids("surface_id", &vec![0; pixels]).expect("ids");
        for index in 0..3 {
            for texel in wall.frame(|_| {}, &Tuning::default(), &what) {
                assert!(texel[..3].iter().all(|c| (c / LIGHT - 1.0).abs() < 0.01), "{what}, frame {index}: {texel:?}");
            }
        }
    }
    assert_valid();
}

pub fn every_tunable_may_be_at_either_end() {
    for (number, config) in (0..).zip(presets(EXTENT)) {
        let mut wall = Wall::new(&Config { post_process: PostProcess::ToneMapTaa, ..config });
        let mut dice = Dice::new(number);
        let mut run = |values: &[(&str, f32)]| {
            let mut tuning = Tuning::for_preset(config.preset);
            values.iter().for_each(|(name, value)| tuning.set(name, *value).expect("in range"));
            wall.frame(|_| {}, &tuning, &format!("{} {}, {values:?}", config.preset, config.signals));
        };
        for field in Tuning::FIELDS {
            run(&[(field.name, field.min)]);
            run(&[(field.name, field.max)]);
        }
        for _ in 0..soak::times(8) {
            let mut value = |min: f32, max: f32| match dice.below(4) {
                0 => min,
                1 => max,
                _ => min + (max - min) * (dice.below(1001) as f32 / 1000.0),
            };
            let values: Vec<_> = Tuning::FIELDS.iter().map(|f| (f.name, value(f.min, f.max))).collect();
            run(&values);
        }
    }
    assert_valid();
}
