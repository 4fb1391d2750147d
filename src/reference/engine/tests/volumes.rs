//! A volume: by itself, and beside surfaces.

use super::super::super::test_scene::*;
use super::*;
use crate::config::Preset;
use glam::Vec3;

const EXTENT: [u32; 2] = [32, 18];
const FRAMES: u32 = 8;

fn config(preset: Preset) -> Config {
    Config { preset, surface_id: false, ..Config::new(EXTENT) }
}

/// Denoised surfaces and volume of a moving camera, where there are such; the noise of a frame is the same for both.
fn sequence(config: &Config) -> Vec<[Option<Image<[f32; 4]>>; 2]> {
    let mut host = Host::new(config);
    let mut frame = |i| {
        host.frame(&camera(EXTENT, Vec3::new(0.05 * i as f32, 0.0, 0.0)), &noise(EXTENT, i));
        let declared = |name: &&str| host.engine.declaration.find(name).is_some();
        ["denoised_radiance", "denoised_volume"].map(|name| Some(name).filter(declared).map(|name| host.image(name)))
    };
    (0..FRAMES).map(&mut frame).collect()
}

#[test]
fn noise_falls_and_surfaces_do_not_see_the_volume() {
    let alone = sequence(&config(Preset::Volume));
    for preset in [Preset::Svgf, Preset::Eaw] {
        let both = sequence(&Config { volume: true, ..config(preset) });
        let surfaces = sequence(&config(preset));
        for (([both_surfaces, both_volume], [surfaces, none]), [black, alone]) in both.iter().zip(&surfaces).zip(&alone) {
            assert!(both_surfaces.is_some() && both_surfaces == surfaces, "{preset:?}");
            assert!(both_volume.is_some() && both_volume == alone, "{preset:?}");
            assert!(none.is_none() && black.is_none(), "{preset:?}");
        }
    }
    let deviation = |image: &Image<[f32; 4]>| {
        (image.texels().iter().map(|t| (t[0] - 0.5) * (t[0] - 0.5)).sum::<f32>() / image.texels().len() as f32).sqrt()
    };
    let last = alone.last().and_then(|[_, volume]| volume.as_ref()).expect("a volume");
    assert!(deviation(last) < 0.2 * deviation(&noise(EXTENT, FRAMES - 1)), "{}", deviation(last));
}
