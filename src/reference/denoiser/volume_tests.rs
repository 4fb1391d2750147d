//! A volume in the chain: by itself, and beside surfaces.

use super::super::test_scene::*;
use super::*;
use crate::{FrameParams, FrameState, Tuning};
use glam::Vec3;

const EXTENT: [u32; 2] = [32, 18];

struct Host {
    depth: Image<[f32; 4]>,
    normal: Image<[f32; 4]>,
    scattering_depth: Image<[f32; 4]>,
}

impl Host {
    fn new() -> Self {
        Self {
            depth: Image::new(EXTENT, [4.0; 4]),
            normal: Image::new(EXTENT, [0.0, 0.0, 1.0, 0.0]),
            scattering_depth: Image::new(EXTENT, [2.0; 4]),
        }
    }

    /// Frames of a moving camera; the noise of frame i is the same for surfaces and volume.
    fn sequence(&self, config: Config, frames: u32, with_volume: bool) -> Result<Vec<DenoiserOutputs>, Error> {
        let (mut state, mut denoiser) = (FrameState::default(), Denoiser::new(config).expect("usable"));
        let mut frame = |i: u32| {
            let params: FrameParams = camera(EXTENT, Vec3::new(0.05 * i as f32, 0.0, 0.0));
            let context = state.begin(&config, &params, &Tuning::default()).expect("usable");
            let radiance = noise(EXTENT, i);
            let volume = VolumeInputs { noisy_volume: &radiance, scattering_depth: Some(&self.scattering_depth) };
            let noisy: &[&_] = if config.preset == Preset::Volume { &[] } else { &[&radiance] };
            let inputs = DenoiserInputs {
                volume: with_volume.then_some(volume),
                ..DenoiserInputs::new(ImportInputs::new(&self.depth, &self.normal), noisy)
            };
            denoiser.frame(&context, &inputs, false)
        };
        (0..frames).map(&mut frame).collect()
    }
}

fn config(preset: Preset) -> Config {
    Config { preset, surface_id: false, ..Config::new(EXTENT) }
}

#[test]
fn noise_falls_and_surfaces_do_not_see_the_volume() {
    let host = Host::new();
    let alone = host.sequence(config(Preset::Volume), 8, true).expect("usable");
    for preset in [Preset::Svgf, Preset::Eaw] {
        let both = host.sequence(Config { volume: true, ..config(preset) }, 8, true).expect("usable");
        let surfaces = host.sequence(config(preset), 8, false).expect("usable");
        for ((both, surfaces), alone) in both.iter().zip(&surfaces).zip(&alone) {
            assert_eq!(both.denoised_radiance, surfaces.denoised_radiance, "{preset:?}");
            assert_eq!((&both.denoised_volume, &surfaces.denoised_volume), (&alone.denoised_volume, &None), "{preset:?}");
        }
    }
    let last = alone.last().and_then(|outputs| outputs.denoised_volume.as_ref()).expect("a volume");
    let deviation = |image: &Image<[f32; 4]>| {
        (image.texels().iter().map(|t| (t[0] - 0.5) * (t[0] - 0.5)).sum::<f32>() / image.texels().len() as f32).sqrt()
    };
    assert!(deviation(last) < 0.2 * deviation(&noise(EXTENT, 7)), "{}", deviation(last));
}

#[test]
fn a_volume_that_is_not_given_is_named() {
    let error = Host::new().sequence(Config { volume: true, ..config(Preset::Svgf) }, 1, false).expect_err("no volume");
    assert!(error.to_string().contains("noisy_volume"), "{error}");
}
