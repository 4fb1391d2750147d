//! Light of fewer pixels than the guides, with another pixel traced in each frame.

use super::super::support::upload_traced;
use super::*;

/// Light of half the extent in both axes.
pub fn half(extent: [u32; 2]) -> Config {
    Config { preset: Preset::Best, light_extent: Some(extent.map(|side| side / 2)), ..Config::new(extent) }
}

pub fn sequence(config: &Config) {
    sequence_of(config, config.allocated_extent);
}

/// With a patch that is background by its id alone, and one whose albedo keeps its light apart.
fn patched(mut guides: Guides, width: u32) -> Guides {
    let row = |i: usize| (4..10).contains(&(i / width as usize));
    let column = |i: usize| i % width as usize;
    for i in (0..guides.surface_id.len()).filter(|i| row(*i)) {
        match column(i) {
            4..10 => guides.surface_id[i] = 0,
            14..20 => guides.albedo[i] = [0.0; 4],
            _ => {}
        }
    }
    guides
}

/// A few frames with a moving camera, jitter and a reset.
pub fn sequence_of(config: &Config, extent: [u32; 2]) {
    let config = Config { post_process: PostProcess::ToneMapTaa, ..*config };
    let light = config.light_extent.expect("light of fewer pixels");
    let ratio = [0, 1].map(|i| config.allocated_extent[i] / light[i]);
    let tuning = Tuning::for_preset(config.preset);
    let scene = Scene { speed: 0.12, allocated: config.allocated_extent, ..Scene::new(extent) };
    let mut s = session_with(&config, SessionOptions { poison: true, keep_transients: true, ..Default::default() });
    for i in 0..6 {
        let light_offset = [i % 2 % ratio[0], i / 2 % 2 % ratio[1]];
        upload_traced(&mut s, &patched(scene.frame(i, i), config.allocated_extent[0]), light_offset);
        let jitter = [0.3 - 0.1 * i as f32, 0.05 * i as f32];
        let reset = (i == 4).then_some(ResetReason::CameraCut);
        run(&mut s, &FrameParams { jitter, reset, light_offset, ..scene.params(i) }, &tuning);
    }
    assert_valid();
}

pub fn every_preset() {
    for preset in [Preset::Svgf, Preset::Asvgf, Preset::Percentile, Preset::Fast, Preset::Eaw] {
        sequence(&Config { preset, ..half([40, 24]) });
    }
}
