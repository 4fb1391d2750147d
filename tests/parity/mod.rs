//! Every stage on the GPU against its CPU twin, on what the GPU itself was given: differences do not add up from stage to stage.

mod asvgf;
mod best;
mod captured;
mod debug_view;
mod import;
mod light;
mod specular;
mod tone_map;
mod viewport;
mod visibility;
mod volume;

use super::sampling::is_sampled;
use super::support::{
    self, assert_valid,
    scene::{Guides, Scene},
    session_with, svgf, svgf_tuning, upload,
};
use ::atrous::config::{AdaptiveRule, PostProcess, Preset, Sampling, Signals};
use ::atrous::executor::{Session, SessionOptions};
use ::atrous::{Config, Declaration, FrameContext, FrameParams, ResetReason, Tuning, Use};
use atrous_harness::DeviceTest;
use captured::{capture, Captured};

pub const TESTS: &[DeviceTest] = &[
    ("one_signal", || sequence(&svgf([67, 35]))),
    ("two_signals", || sequence(&Config { signals: Signals::Apart, ..svgf([67, 35]) })),
    ("specular", || sequence(&Config { signals: Signals::Specular, ..svgf([67, 35]) })),
    ("specular_in_a_larger_image", || sequence_of(&Config { signals: Signals::Specular, ..percentile([66, 40]) }, [37, 21])),
    ("mixed_signal", specular::mixed_signal),
    ("light_that_moves_between_blocks", light_between_blocks),
    ("specular_fast", || sequence(&Config { preset: Preset::Fast, signals: Signals::Specular, ..Config::new([40, 23]) })),
    ("specular_eaw", || sequence(&Config { preset: Preset::Eaw, signals: Signals::Specular, ..Config::new([40, 23]) })),
    ("specular_by_f0", specular::by_f0),
    ("moving_reflections", specular::moving_reflections),
    ("specular_at_other_resolutions", specular::other_resolutions),
    ("specular_at_unknown_distances", specular::unknown_distances),
    ("reactive_mask", || sequence(&Config { reactive_mask: true, ..Config::new([67, 35]) })),
    ("reactive_mask_two_signals", || sequence(&Config { reactive_mask: true, signals: Signals::Apart, ..svgf([40, 23]) })),
    ("object_normals", || sequence(&Config { object_normal: true, ..svgf([40, 23]) })),
    ("materials", materials),
    ("without_ids", || sequence(&Config { surface_id: false, ..svgf([40, 23]) })),
    ("one_pixel", || sequence(&svgf([1, 1]))),
    ("a_rect_in_a_larger_image", || sequence_of(&svgf([66, 40]), [37, 21])),
    ("firefly_filter", || sequence(&Config { firefly_filter: true, ..svgf([67, 35]) })),
    ("outliers", outliers),
    ("percentile", || sequence(&percentile([67, 35]))),
    ("percentile_two_signals", || sequence(&Config { signals: Signals::Apart, ..percentile([67, 35]) })),
    ("percentile_published", || sequence(&Config { adaptive_rule: AdaptiveRule::Percentiles, ..percentile([67, 35]) })),
    ("percentile_published_two_signals", || {
        sequence(&Config { adaptive_rule: AdaptiveRule::Percentiles, signals: Signals::Apart, ..percentile([40, 23]) })
    }),
    ("percentile_object_normals", || sequence(&Config { object_normal: true, signals: Signals::Apart, ..percentile([40, 23]) })),
    ("percentile_in_a_larger_image", || sequence_of(&percentile([66, 40]), [37, 21])),
    ("fast", || sequence(&Config { preset: Preset::Fast, ..Config::new([67, 35]) })),
    ("fast_two_signals", || sequence(&Config { preset: Preset::Fast, signals: Signals::Apart, ..Config::new([40, 23]) })),
    ("eaw", || sequence(&Config { preset: Preset::Eaw, ..Config::new([67, 35]) })),
    ("eaw_two_signals", || {
        sequence(&Config { preset: Preset::Eaw, signals: Signals::Apart, levels: Some(10), ..Config::new([40, 23]) })
    }),
    ("eaw_one_of_2x2", || sequence(&Config { preset: Preset::Eaw, sampling: Sampling::OneOf2x2, ..Config::new([67, 35]) })),
    ("eaw_one_of_4x4", || {
        sequence(&Config { preset: Preset::Eaw, sampling: Sampling::OneOf4x4, signals: Signals::Apart, ..Config::new([40, 23]) })
    }),
    ("eaw_in_a_larger_image", || sequence_of(&Config { preset: Preset::Eaw, levels: Some(2), ..Config::new([66, 40]) }, [37, 21])),
    ("volume", || sequence(&Config { preset: Preset::Volume, ..Config::new([67, 35]) })),
    ("volume_of_one_pixel", || sequence(&Config { preset: Preset::Volume, levels: Some(1), ..Config::new([1, 1]) })),
    ("volume_in_a_larger_image", || {
        sequence_of(&Config { preset: Preset::Volume, levels: Some(2), ..Config::new([66, 40]) }, [37, 21])
    }),
    ("volume_beside_svgf", || {
        sequence(&Config { volume: true, firefly_filter: true, signals: Signals::Apart, levels: Some(3), ..svgf([67, 35]) })
    }),
    ("volume_beside_eaw", || sequence(&Config { volume: true, preset: Preset::Eaw, ..Config::new([40, 23]) })),
    ("visibility", || sequence(&Config { visibility: 1, ..svgf([67, 35]) })),
    ("visibility_in_colour", || sequence(&Config { visibility: 1, coloured_visibility: true, ..svgf([67, 35]) })),
    ("visibility_of_three_lights", || sequence(&Config { visibility: 3, ..svgf([67, 35]) })),
    ("visibility_of_four_lights_in_colour", || {
        let tuning = Tuning { light_radius_1: 0.01, light_radius_2: 0.02, light_radius_3: 0.002, ..svgf_tuning() };
        tuned_sequence(&Config { visibility: 4, coloured_visibility: true, ..svgf([67, 35]) }, [67, 35], tuning);
    }),
    ("a_part_of_larger_images", || {
        viewport::sequence(&Config { signals: Signals::Apart, post_process: PostProcess::ToneMapTaa, ..Config::new([40, 24]) });
        viewport::sequence(&Config { visibility: 1, volume: true, ..svgf([40, 24]) });
    }),
    ("ambient_occlusion", || {
        let tuning = Tuning { ambient_radius: 0.01, ..svgf_tuning() };
        tuned_sequence(&Config { ambient_occlusion: true, visibility: 1, ..svgf([67, 35]) }, [67, 35], tuning);
    }),
    ("visibility_of_one_pixel", || sequence(&Config { visibility: 1, levels: Some(1), ..svgf([1, 1]) })),
    ("visibility_in_a_larger_image", || sequence_of(&Config { visibility: 1, ..svgf([66, 40]) }, [37, 21])),
    ("visibility_beside_best_and_volume", || {
        sequence(&Config { visibility: 1, volume: true, preset: Preset::Best, ..Config::new([40, 23]) })
    }),
    ("visibility_of_a_large_light", || {
        let tuning = Tuning { light_radius: 0.05, penumbra_blur: 1.0, visibility_alpha: 0.0, ..svgf_tuning() };
        tuned_sequence(&Config { visibility: 1, preset: Preset::Eaw, ..Config::new([67, 35]) }, [67, 35], tuning);
    }),
    ("moving_shadows", visibility::moving_shadows),
    ("volume_at_other_resolutions", volume::other_resolutions),
    ("volume_without_depths", volume::without_depths),
    ("import_in_every_encoding", import::every_encoding),
    ("import_with_instance_transforms", import::instance_transforms),
    ("normals_switched_off", || {
        tuned_sequence(&svgf([40, 23]), [40, 23], Tuning { sigma_n: 0.0, ..svgf_tuning() });
    }),
    ("tone_map_curves", tone_map::curves),
    ("asvgf_forward_projected", asvgf::forward_projected),
    ("asvgf_strata_of_every_size", asvgf::strata_of_every_size),
    ("asvgf_transforms_and_forward_motion", asvgf::transforms_and_forward_motion),
    ("asvgf_reshaded", asvgf::reshaded),
    ("asvgf_sparse_and_confidence", asvgf::sparse_and_confidence),
    ("asvgf_compared", asvgf::compared),
    ("asvgf_one_pixel", asvgf::one_pixel),
    ("asvgf_other_resolutions", asvgf::other_resolutions),
    ("exposure_beyond_half_floats", asvgf::exposure_beyond_half_floats),
    ("stabilize", asvgf::stabilize),
    ("best", best::forward_projected),
    ("best_reshaded", best::reshaded),
    ("best_compared", best::compared),
    ("best_without_parts", best::without_parts),
    ("best_without_ratio", best::sparse_and_confidence),
    ("best_without_samples", || sequence(&Config { preset: Preset::Best, ..Config::new([67, 35]) })),
    ("debug_views", debug_view::every_view),
    ("output_of_twice_the_extent", || sequence(&Config { output_extent: Some([122, 70]), ..svgf([67, 35]) })),
    ("output_of_other_ratios", || {
        sequence(&Config { output_extent: Some([40, 69]), signals: Signals::Specular, float_output: true, ..svgf([40, 23]) })
    }),
    ("output_of_one_pixel", || sequence(&Config { output_extent: Some([3, 2]), volume: true, ..svgf([1, 1]) })),
    ("output_of_a_rect_in_a_larger_image", || {
        sequence_of(&Config { output_extent: Some([96, 60]), volume: true, ..svgf([66, 40]) }, [37, 21])
    }),
    ("light_of_half_the_extent", || light::sequence(&light::half([60, 34]))),
    ("light_of_half_the_width", || light::sequence(&Config { light_extent: Some([20, 23]), ..light::half([40, 23]) })),
    ("light_and_output", || light::sequence(&Config { output_extent: Some([90, 34]), ..light::half([60, 34]) })),
    ("light_of_one_pixel", || light::sequence(&light::half([2, 2]))),
    ("light_with_object_normals_and_signals_apart", || {
        light::sequence(&Config { object_normal: true, signals: Signals::Apart, debug_view: true, ..light::half([40, 24]) });
    }),
    ("light_with_reflections", || {
        light::sequence(&Config { signals: Signals::Specular, float_output: true, ..light::half([40, 24]) });
    }),
    ("light_of_a_rect_in_a_larger_image", || light::sequence_of(&light::half([66, 40]), [38, 22])),
    ("light_with_visibility", || light::sequence(&Config { visibility: 1, debug_view: true, ..light::half([40, 24]) })),
    ("light_of_every_preset", light::every_preset),
    ("light_with_a_volume", || light::sequence(&Config { volume: true, ..light::half([40, 24]) })),
    ("light_of_a_volume", || light::sequence(&Config { preset: Preset::Volume, ..light::half([40, 24]) })),
    ("light_with_a_mask", || light::sequence(&Config { reactive_mask: true, surface_id: false, ..light::half([40, 24]) })),
    ("light_with_several_lights", || {
        light::sequence(&Config { visibility: 3, coloured_visibility: true, ..light::half([40, 24]) })
    }),
    ("holes", holes),
    ("best_with_holes", best::with_holes),
];

fn holes() {
    let base = Config { firefly_filter: true, ..Config::new([40, 23]) };
    for preset in [Preset::Svgf, Preset::Percentile, Preset::Fast] {
        for (sampling, signals) in [Sampling::OneOf2x2, Sampling::OneOf4x4].into_iter().zip([Signals::Apart, Signals::Specular]) {
            sequence(&Config { preset, sampling, signals, ..base });
        }
    }
}

/// With a limit so low that the firefly filter cuts pixels in every block, spreads all that it takes or a part of it, and passes holes by.
fn outliers() {
    let base = Config { firefly_filter: true, levels: Some(1), ..svgf([67, 35]) };
    for (config, extent, firefly_spread) in [
        (Config { signals: Signals::Apart, ..base }, [67, 35], 1024.0),
        (Config { sampling: Sampling::OneOf2x2, ..base }, [67, 35], 0.25),
        (Config { volume: true, ..base }, [37, 21], 2.0),
        (base, [67, 35], 0.0),
    ] {
        let tuning = Tuning { percentile_up: 0.75, percentile_range: 0.0, firefly_spread, ..Tuning::for_preset(config.preset) };
        tuned_sequence(&config, extent, tuning);
    }
}

/// Of two signals, of specular light, of mixed light, and of light of fewer pixels.
fn materials() {
    let fast = Config { preset: Preset::Fast, material_class: true, ..Config::new([24, 18]) };
    sequence(&Config { signals: Signals::Apart, ..fast });
    sequence(&Config { signals: Signals::Specular, ..fast });
    sequence(&Config { signals: Signals::Mixed, ..fast });
    light::sequence(&Config { light_extent: Some([12, 9]), ..fast });
}

fn percentile(extent: [u32; 2]) -> Config {
    Config { preset: Preset::Percentile, ..Config::new(extent) }
}

fn sequence(config: &Config) {
    sequence_of(config, config.allocated_extent);
}

fn sequence_of(config: &Config, extent: [u32; 2]) {
    tuned_sequence(config, extent, Tuning::for_preset(config.preset));
}

/// A few frames with a moving camera and a reset, every pass of each against its twin.
fn tuned_sequence(config: &Config, extent: [u32; 2], tuning: Tuning) {
    let config = Config { post_process: PostProcess::ToneMapTaa, ..*config };
    let scene = Scene { speed: 0.12, allocated: config.allocated_extent, ..Scene::new(extent) };
    let mut s = session_with(&config, SessionOptions { poison: true, keep_transients: true, ..Default::default() });
    let emission = vec![[0.25, 0.5, 0.125, 0.0]; (config.allocated_extent[0] * config.allocated_extent[1]) as usize];
    if config.preset != Preset::Volume {
        s.upload("emission", &emission).expect("emission");
    }
    for i in 0..6 {
        let mut guides = scene.frame(i, i);
        leave_holes(&config, i, &mut guides);
        upload(&mut s, &guides);
        let jitter = [0.3 - 0.1 * i as f32, 0.05 * i as f32];
        let reset = (i == 4).then_some(ResetReason::CameraCut);
        let params = FrameParams { jitter, reset, exposure_ratio: if i == 3 { 1.5 } else { 1.0 }, ..scene.params(i) };
        run(&mut s, &params, &tuning);
    }
    assert_valid();
}

/// Light that two blocks hand to and fro, of which a mean over both knows nothing, in noise that hides single pixels and in little.
fn light_between_blocks() {
    for noise in [0.05, 0.5] {
        let config = Config { preset: Preset::Fast, ..Config::new([67, 35]) };
        let scene = Scene { noise, ..Scene::new(config.allocated_extent) };
        let mut s = session_with(&config, SessionOptions { poison: true, keep_transients: true, ..Default::default() });
        for i in 0..6 {
            let mut guides = scene.frame(i, i);
            for (at, texel) in guides.noisy_radiance.iter_mut().enumerate().filter(|(at, _)| (8..16).contains(&(at / 67))) {
                let darker = [0.4, 1.6][i as usize % 2];
                let factor = match at % 67 {
                    24..32 => darker,
                    32..40 => 2.0 - darker,
                    _ => 1.0,
                };
                texel[..3].iter_mut().for_each(|c| *c *= factor);
            }
            upload(&mut s, &guides);
            run(&mut s, &scene.params(i), &Tuning::for_preset(config.preset));
        }
    }
    assert_valid();
}

/// Where the input is sub-sampled, the pixels without a sample, others in each frame. Of two signals that are accumulated the first has all
/// of its samples in every other frame.
fn leave_holes(config: &Config, index: u32, guides: &mut Guides) {
    if config.sampling == Sampling::Full {
        return;
    }
    let side = 1 << config.sampling as u32;
    let stride = config.allocated_extent[0];
    let Guides { noisy_radiance, noisy_direct, noisy_indirect, noisy_diffuse, noisy_specular, .. } = guides;
    let holed = [noisy_radiance, noisy_indirect, noisy_specular];
    let not_always = [noisy_direct, noisy_diffuse].into_iter().filter(|_| config.preset == Preset::Eaw || index % 2 == 1);
    for images in holed.into_iter().chain(not_always) {
        for (i, texel) in (0..).zip(images.iter_mut()) {
            if !is_sampled(side, index, i % stride, i / stride) {
                *texel = [f32::NAN; 4];
            }
        }
    }
}

/// One frame, every pass against its twin.
pub fn run(s: &mut Session, params: &FrameParams, tuning: &Tuning) {
    let params = &FrameParams { materials: support::materials(), ..*params };
    let declaration = s.executor().denoiser().declaration().clone();
    let mut before = Captured::new();
    let trace = &mut |s: &mut Session, frame: &FrameContext, pass: usize, done: bool| {
        if !done {
            before = capture(s, pass, |access| access.reads())?;
            return Ok(());
        }
        let after = capture(s, pass, |access| access.writes())?;
        check(&declaration, frame, pass, &before, &after);
        Ok(())
    };
    s.run_traced(params, tuning, trace).expect("frame");
}

/// What the GPU wrote in a pass, against what the twin makes of the same inputs.
fn check(declaration: &Declaration, frame: &FrameContext, pass: usize, before: &Captured, after: &Captured) {
    let decl = &declaration.passes()[pass];
    let what = format!("{}, frame {} (reset: {:?})", decl.name, frame.index, frame.reset);
    let place = |u: &Use| decl.uses.iter().position(|other| other == u).expect("a use of the pass");
    let written =
        declaration.run_twin(frame, pass, |u| before[place(u)].as_ref()).unwrap_or_else(|error| panic!("{what}: {error}"));
    let Some(written) = written else { return };
    assert!(!written.is_empty(), "{what}: the twin wrote nothing");
    for (index, gpu) in after.iter().enumerate().filter_map(|(index, gpu)| Some((index, gpu.as_ref()?))) {
        // What is updated in place, and was not, is what it was.
        let twin = written.iter().find(|(i, _)| *i == index).map(|(_, texels)| texels).or(before[index].as_ref());
        let twin = twin.unwrap_or_else(|| panic!("{what}: the twin did not write use {index}"));
        let equal = declaration.compare_pass(frame, decl, index, gpu, twin);
        equal.unwrap_or_else(|message| panic!("{what}: {message}"));
    }
}
