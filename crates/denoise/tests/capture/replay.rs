//! A replay of a capture gives what the engine had.

use super::support::{assert_valid, session, upload, upload_traced};
use atrous::config::{AdaptiveRule, EawWeights, GradientSource, MotionDepth, MotionUnit, Preset, Sampling, Signals};
use atrous::reference::InstanceTransform;
use atrous::{Config, FrameParams, Input, ResetReason, Tuning};
use atrous_denoise::backend::{Backend, Passes};
use atrous_denoise::setup::{Options, Setup};
use atrous_denoise::{frame, frame_files};
use atrous_harness::DeviceTest;
use atrous_synthetic::scene::{random, rmse, Guides, Scene};
use std::path::Path;

pub const TESTS: &[DeviceTest] = &[
    ("a_replay_gives_the_same_bits", a_replay_gives_the_same_bits),
    ("a_capture_from_the_middle_is_replayed", a_capture_from_the_middle_is_replayed),
    ("a_part_of_larger_images_is_captured_alone", a_part_of_larger_images_is_captured_alone),
    ("conventions_tunables_and_resets_are_replayed", conventions_tunables_and_resets_are_replayed),
    ("values_that_are_not_finite_are_replayed", values_that_are_not_finite_are_replayed),
    ("every_preset_is_replayed", every_preset_is_replayed),
    ("every_source_of_gradients_is_replayed", every_source_of_gradients_is_replayed),
    ("volumes_are_replayed", volumes_are_replayed),
    ("transforms_and_changing_tunables_are_replayed", transforms_and_changing_tunables_are_replayed),
    ("hit_ids_are_replayed", hit_ids_are_replayed),
    ("classes_of_materials_are_replayed", classes_of_materials_are_replayed),
    ("moving_shadows_are_replayed", moving_shadows_are_replayed),
    ("four_coloured_lights_are_replayed", four_coloured_lights_are_replayed),
    ("ambient_occlusion_is_replayed", ambient_occlusion_is_replayed),
    ("the_motion_of_reflections_is_replayed", the_motion_of_reflections_is_replayed),
    ("light_and_output_of_other_sizes_are_replayed", light_and_output_of_other_sizes_are_replayed),
];

const EXTENT: [u32; 2] = [48, 27];
const FRAMES: u32 = 4;

type Picture = Vec<[f32; 4]>;

/// Frames of a moving camera through a session that captures; what came out, cropped to the render extent.
pub fn capture(folder: &Path, config: &Config, tuning: &Tuning, scene: &Scene, change: impl Fn(u32, &mut Inputs)) -> Vec<Picture> {
    let mut s = session(config);
    s.capture(folder, FRAMES).expect("a capture");
    let mut pictures = Vec::new();
    for i in 0..FRAMES {
        let mut inputs = Inputs {
            guides: scene.frame(i, i),
            params: scene.params(i),
            tuning: *tuning,
            images: Vec::new(),
            transforms: None,
            ids: None,
        };
        change(i, &mut inputs);
        upload(&mut s, &inputs.guides);
        for (name, texels) in &inputs.images {
            s.upload(name, texels).expect(name);
        }
        if let Some(transforms) = &inputs.transforms {
            s.upload_buffer("instance_transforms", bytemuck::cast_slice(transforms)).expect("transforms");
            s.unbind("motion").expect("unbound");
        }
        if let Some((name, ids)) = &inputs.ids {
            s.upload_ids(name, ids).expect(name);
        }
        if s.executor().denoiser().declaration().find("emission").is_some() && config.signals == Signals::Together {
            let emission: Picture = inputs.guides.clean.iter().map(|c| [c[0] * 0.1, 0.0, 0.03, 1.0]).collect();
            s.upload("emission", &emission).expect("emission");
        }
        s.run(&inputs.params, &inputs.tuning).expect("a frame");
        let outputs = ["denoised_radiance", "denoised_volume"];
        let declaration = s.executor().denoiser().declaration().clone();
        let mut image = vec![[0.0; 4]; (config.allocated_extent[0] * config.allocated_extent[1]) as usize];
        for name in outputs.into_iter().filter(|name| declaration.find(name).is_some()) {
            for (sum, [r, g, b, _]) in image.iter_mut().zip(s.download(name).expect("a picture")) {
                *sum = [sum[0] + r, sum[1] + g, sum[2] + b, 1.0];
            }
        }
        let rows = image.chunks_exact(config.allocated_extent[0] as usize).take(scene.extent[1] as usize);
        pictures.push(rows.flat_map(|row| row[..scene.extent[0] as usize].to_vec()).collect());
    }
    assert_eq!(s.executor().frames_to_capture(), 1, "the last frame is written when its slot comes round");
    assert_eq!(s.finish_capture().expect("written"), FRAMES);
    assert_valid();
    pictures
}

pub struct Inputs {
    guides: Guides,
    params: FrameParams,
    tuning: Tuning,
    images: Vec<(&'static str, Vec<[f32; 4]>)>,
    transforms: Option<Vec<InstanceTransform>>,
    ids: Option<(&'static str, Vec<u32>)>,
}

pub fn load(folder: &Path) -> (Setup, Vec<frame::FrameInputs>) {
    let files = frame_files::find(&[folder.to_owned()]).expect("frames");
    assert_eq!(files.len(), FRAMES as usize);
    let setup = Setup::new(&files, &Options::default()).expect("a set-up");
    let frames = files.iter().map(|f| frame::load(f, &setup).expect("a frame")).collect();
    (setup, frames)
}

fn replayed(backend: &mut dyn Backend, frames: &[frame::FrameInputs]) -> Vec<Picture> {
    let picture = |f| backend.denoise(f, false).expect("a picture").radiance.into_iter().map(|[r, g, b]| [r, g, b, 1.0]).collect();
    frames.iter().map(picture).collect()
}

fn assert_replays(folder: &Path, pictures: &[Picture]) {
    let (setup, frames) = assert_same_bits(folder, pictures);
    let mut twin = Passes::reference(&setup.config).expect("the twin");
    for (i, (again, before)) in replayed(&mut twin, &frames).iter().zip(pictures).enumerate() {
        let error = rmse(again, before);
        assert!(error < 2e-3, "frame {i} differs on the CPU twin, RMSE {error}");
    }
}

fn assert_same_bits(folder: &Path, pictures: &[Picture]) -> (Setup, Vec<frame::FrameInputs>) {
    let (setup, frames) = load(folder);
    let mut gpu = Passes::gpu(None, &setup.config).expect("a device");
    for (i, (again, before)) in replayed(&mut gpu, &frames).iter().zip(pictures).enumerate() {
        assert!(again == before, "frame {i} differs on the GPU, RMSE {}", rmse(again, before));
    }
    (setup, frames)
}

fn a_replay_gives_the_same_bits() {
    for signals in Signals::ALL {
        let folder = tempfile::tempdir().expect("a folder");
        let scene = Scene { speed: 0.05, ..Scene::new(EXTENT) };
        let config = Config { signals, object_normal: signals == Signals::Apart, ..Config::new(EXTENT) };
        let pictures = capture(folder.path(), &config, &Tuning::default(), &scene, |_, _| {});
        assert!(pictures[2] != pictures[3]);
        assert_replays(folder.path(), &pictures);
        let (setup, _) = load(folder.path());
        assert_eq!((setup.config.signals, setup.config.object_normal), (config.signals, config.object_normal));
    }
}

/// Which pixels are re-shaded depends on how many frames the engine has counted.
fn a_capture_from_the_middle_is_replayed() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = Scene { speed: 0.05, ..Scene::new(EXTENT) };
    let config = Config { preset: Preset::Asvgf, ..Config::new(EXTENT) };
    let mut s = session(&config);
    s.restart_at(41);
    let mut pictures = Vec::new();
    for i in 0..2 + FRAMES {
        if i == 2 {
            s.invalidate();
            s.capture(folder.path(), FRAMES).expect("a capture");
        }
        upload(&mut s, &scene.frame(i, i));
        s.run(&FrameParams { reshaded: true, ..scene.params(i) }, &Tuning::for_preset(config.preset)).expect("a frame");
        let picture = s.download("denoised_radiance").expect("a picture");
        pictures.push(picture.into_iter().map(|[r, g, b, _]| [r, g, b, 1.0]).collect());
    }
    s.finish_capture().expect("written");
    assert_replays(folder.path(), &pictures[2..]);
    let (_, frames) = load(folder.path());
    assert_eq!(frames.iter().map(|f| f.index).collect::<Vec<_>>(), [43, 44, 45, 46]);
}

fn a_part_of_larger_images_is_captured_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let allocated = [60, 40];
    let scene = Scene { speed: 0.05, allocated, ..Scene::new(EXTENT) };
    let pictures = capture(folder.path(), &Config::new(allocated), &Tuning::default(), &scene, |_, _| {});
    assert_replays(folder.path(), &pictures);
}

/// Motion in NDC, of the other sign, with y up, jitter and an absolute depth; a cut and an exposure jump on the way.
fn conventions_tunables_and_resets_are_replayed() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = Scene { speed: 0.05, ..Scene::new(EXTENT) };
    let mut config = Config { levels: Some(3), ..Config::new(EXTENT) };
    let c = &mut config.conventions;
    (c.motion_unit, c.motion_y_up, c.motion_jittered, c.motion_depth) = (MotionUnit::Ndc, true, true, MotionDepth::Absolute);
    c.motion_direction = atrous::config::MotionDirection::CurrentMinusPrevious;
    c.background_depth = 50.0;
    let tuning = Tuning { alpha: 0.1, sigma_l: 2.5, ..Tuning::default() };
    let pictures = capture(folder.path(), &config, &tuning, &scene, |i, inputs| {
        for (motion, depth) in inputs.guides.motion.iter_mut().zip(&inputs.guides.depth) {
            *motion = [-2.0 * motion[0], 0.0, depth[0], 0.0];
        }
        inputs.params.jitter = [0.1 * i as f32, -0.05 * i as f32];
        inputs.params.exposure_ratio = if i == 1 { 1.3 } else { 1.0 };
        inputs.params.reset = (i == 2).then_some(ResetReason::ExposureJump);
    });
    assert_replays(folder.path(), &pictures);
    let (setup, frames) = load(folder.path());
    assert_eq!((setup.config.conventions, setup.config.levels), (config.conventions, Some(3)));
    assert_eq!(setup.tuning(0).expect("tunables"), tuning);
    let resets: Vec<_> = frames.iter().map(|f| f.params.reset).collect();
    assert_eq!(resets, [Some(ResetReason::Created), None, Some(ResetReason::ExposureJump), None]);
    assert_eq!(frames[3].params.view_from_world, scene.params(3).view_from_world);
    assert_eq!(frames[3].params.clip_from_view, scene.params(3).clip_from_view);
}

fn values_that_are_not_finite_are_replayed() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = Scene { speed: 0.05, ..Scene::new(EXTENT) };
    let pictures = capture(folder.path(), &Config::new(EXTENT), &Tuning::default(), &scene, |i, inputs| {
        let at = 48 * 13 + 10 * i as usize;
        inputs.guides.motion[at] = [f32::NAN; 4];
        inputs.guides.normal[at + 1] = [f32::INFINITY; 4];
        inputs.guides.noisy_radiance[at + 2] = [f32::NAN; 4];
        inputs.guides.depth[at + 3] = [f32::NAN; 4];
    });
    assert_replays(folder.path(), &pictures);
    let (_, frames) = load(folder.path());
    assert!(frames[0].images["motion"][48 * 13][0].is_nan(), "the texel is passed on as it was");
}

/// A camera that moves under a light that jumps, filtered as `config` says; `change` adds what else it takes.
fn replay_of(config: Config, change: impl Fn(u32, &mut Inputs)) -> Setup {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = Scene { speed: 0.05, ..Scene::new(EXTENT) };
    let tuning = Tuning::for_preset(config.preset);
    let pictures = capture(folder.path(), &config, &tuning, &scene, |i, inputs| {
        if i == 2 {
            inputs.guides.noisy_radiance.iter_mut().for_each(|t| *t = t.map(|c| 0.2 * c));
        }
        change(i, inputs);
    });
    assert_replays(folder.path(), &pictures);
    let (setup, _) = load(folder.path());
    // What cannot be seen in a file is not asked for.
    let (levels, frames_in_flight) = (Some(config.levels()), setup.config.frames_in_flight);
    let seen = Config { allocated_extent: EXTENT, frames_in_flight, levels, ..config };
    assert_eq!(setup.config, seen);
    setup
}

fn every_preset_is_replayed() {
    let base = Config { firefly_filter: true, levels: Some(3), ..Config::new(EXTENT) };
    for signals in Signals::ALL {
        replay_of(Config { signals, ..base }, |_, _| {});
        replay_of(Config { signals, preset: Preset::Asvgf, stratum_size: 4, ..base }, |i, inputs| inputs.params.reshaded = i != 3);
        for adaptive_rule in [AdaptiveRule::ChangeTest, AdaptiveRule::Percentiles] {
            replay_of(Config { signals, preset: Preset::Percentile, adaptive_rule, ..base }, |_, _| {});
        }
    }
    let eaw = Config { preset: Preset::Eaw, eaw_weights: EawWeights::first(2), sampling: Sampling::OneOf2x2, ..base };
    replay_of(eaw, |_, inputs| {
        for (i, texel) in inputs.guides.noisy_radiance.iter_mut().enumerate() {
            if i % 4 != 0 {
                *texel = [f32::NAN; 4];
            }
        }
    });
}

fn every_source_of_gradients_is_replayed() {
    let base = Config { preset: Preset::Asvgf, ..Config::new(EXTENT) };
    replay_of(Config { gradient_source: GradientSource::Reshaded, ..base }, |_, inputs| {
        inputs.images.push(("reshaded_radiance", inputs.guides.noisy_radiance.iter().map(|t| t.map(|c| 0.9 * c)).collect()));
    });
    replay_of(Config { gradient_source: GradientSource::Sparse, ..base }, |i, inputs| {
        let texels = (0..16 * 9).map(|k| [random(k, i, 0) - 0.5, random(k, i, 1), 0.0, 0.0]).collect();
        inputs.images.push(("sparse_gradient", texels));
    });
    let texels = |i: u32, scale: f32| (0..EXTENT[0] * EXTENT[1]).map(|k| [scale * random(k, i, 3); 4]).collect();
    replay_of(Config { gradient_source: GradientSource::Confidence, ..base }, |i, inputs| {
        inputs.images.push(("confidence", texels(i, 1.0)));
    });
    replay_of(Config { forward_motion: true, ..base }, |i, inputs| {
        inputs.params.reshaded = true;
        inputs.images.push(("forward_motion", texels(i, 0.02)));
    });
    replay_of(Config { preset: Preset::Best, gradient_source: GradientSource::ChangeTest, ..base }, |_, _| ());
    for gradient_source in [GradientSource::ForwardProjected, GradientSource::Confidence] {
        replay_of(Config { preset: Preset::Stabilize, gradient_source, ..base }, |i, inputs| {
            inputs.params.reshaded = true;
            inputs.images.push(("other_denoised_radiance", texels(i, 2.0)));
            if gradient_source == GradientSource::Confidence {
                inputs.images.push(("confidence", texels(i, 1.0)));
            }
        });
    }
}

fn volumes_are_replayed() {
    let texels = |i: u32| (0..EXTENT[0] * EXTENT[1]).map(move |k| [0.4 * random(k, i, 5), 0.4 * random(k, i, 6), 0.2, 0.0]);
    let base = Config::new(EXTENT);
    for config in [
        Config { volume: true, ..base },
        Config { volume: true, preset: Preset::Percentile, signals: Signals::Apart, ..base },
        Config { preset: Preset::Volume, ..base },
    ] {
        replay_of(config, |i, inputs| {
            inputs.images.push(("noisy_volume", texels(i).collect()));
            inputs.images.push(("scattering_depth", texels(i).map(|t| [0.2 + 5.0 * t[0], 0.0, 0.0, 0.0]).collect()));
        });
    }
}

fn transforms_and_changing_tunables_are_replayed() {
    let setup = replay_of(Config { preset: Preset::Asvgf, ..Config::new(EXTENT) }, |i, inputs| {
        inputs.params.reshaded = true;
        inputs.tuning.alpha = [0.1, 0.3, 0.1, 0.7][i as usize];
        let identity = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
        let mut moved = identity;
        moved[0][3] = 0.02 * i as f32;
        inputs.transforms = Some(vec![identity, moved, identity]);
    });
    let alphas: Vec<f32> = (0..4).map(|i| setup.tuning(i).expect("tunables").alpha).collect();
    assert_eq!(alphas, [0.1, 0.3, 0.1, 0.7]);
}

/// Ids of things beside each other.
fn hit_ids(index: u32) -> Vec<u32> {
    (0..EXTENT[0] * EXTENT[1]).map(|k| (k / 7 + index) % 8).collect()
}

/// A thing that moves in the surfaces: what the frames give depends on its ids.
fn hit_ids_are_replayed() {
    let config = Config { signals: Signals::Specular, ..Config::new(EXTENT) };
    let frames = |folder: &Path, ids: bool| {
        let scene = Scene { speed: 0.05, ..Scene::new(EXTENT) };
        capture(folder, &config, &Tuning::default(), &scene, |i, inputs| {
            let mut moved = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
            moved[0][3] = 0.3;
            inputs.transforms = Some(vec![moved; 8]);
            inputs.ids = ids.then(|| ("specular_hit_id", hit_ids(i)));
        })
    };
    let [with, without] = [(); 2].map(|()| tempfile::tempdir().expect("a folder"));
    let pictures = frames(with.path(), true);
    assert!(pictures != frames(without.path(), false), "ids change nothing, so nothing was tested");
    assert_replays(with.path(), &pictures);
}

/// Classes, of which one is beyond the table, and the numbers of one, which change: what the frames give depends on them.
fn classes_of_materials_are_replayed() {
    let config = Config { preset: Preset::Svgf, material_class: true, ..Config::new(EXTENT) };
    let frames = |folder: &Path, light: f32| {
        capture(folder, &config, &Tuning::default(), &Scene::new(EXTENT), |i, inputs| {
            inputs.ids = Some(("material_class", (0..EXTENT[0] * EXTENT[1]).map(|k| (k / 7 + i) % 18).collect()));
            inputs.params.materials[3] = [1.0, 1.0, if i % 2 == 0 { light } else { 1.0 }, 3.0].into();
        })
    };
    let [with, without] = [(); 2].map(|()| tempfile::tempdir().expect("a folder"));
    let pictures = frames(with.path(), 0.1);
    assert!(pictures != frames(without.path(), 1.0), "classes change nothing, so nothing was tested");
    assert_same_bits(with.path(), &pictures);
}

/// Things that cast shadows, and a lamp, that move: what the frames give depends on each.
fn moving_shadows_are_replayed() {
    let config = Config { visibility: 1, ..Config::new(EXTENT) };
    let frames = |folder: &Path, left_out: &str| {
        let scene = Scene { speed: 0.05, ..Scene::new(EXTENT) };
        capture(folder, &config, &Tuning::default(), &scene, |i, inputs| {
            let mut moved = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
            moved[0][3] = 0.05;
            inputs.transforms = Some(vec![moved; 8]);
            inputs.ids = (left_out != "ids").then(|| ("occluder_id", hit_ids(i)));
            if left_out != "lights" {
                inputs.params.lights[0] = [0.004 * i as f32, 0.8, 0.6, 0.0];
            }
            if left_out == "nothing, with motion" {
                inputs.images.push(("occluder_motion", vec![[0.04, 0.0, 0.1, 0.0]; hit_ids(i).len()]));
            }
        })
    };
    let kinds = ["nothing", "ids", "lights", "nothing, with motion"];
    let folders = kinds.map(|_| tempfile::tempdir().expect("a folder"));
    let pictures: Vec<_> = folders.iter().zip(kinds).map(|(folder, kind)| frames(folder.path(), kind)).collect();
    assert!(pictures[1..].iter().all(|other| *other != pictures[0]), "one of them changes nothing, so nothing was tested");
    // Passes are compared with their twins in tests/parity; over whole frames a shadow's place carries rounding on.
    for (folder, pictures) in folders.iter().zip(&pictures) {
        assert_same_bits(folder.path(), pictures);
    }
}

/// Numbers that depend on pixel, frame and salt, one in two 0.
fn drawn(frame: u32, salt: u32) -> Vec<[f32; 4]> {
    let number = |p: u32, channel: u32| random(p, 64 * frame + salt, channel);
    (0..EXTENT[0] * EXTENT[1]).map(|p| [0, 1, 2, 3].map(|c| if number(p, 9) < 0.5 { 0.0 } else { number(p, c) })).collect()
}

/// Lights with shadows of each colour: what the frames give depends on the last one, and on colours.
fn four_coloured_lights_are_replayed() {
    let config = Config { visibility: 4, coloured_visibility: true, ..Config::new(EXTENT) };
    let frames = |folder: &Path, config: &Config, lights: usize| {
        let scene = Scene { speed: 0.05, ..Scene::new(EXTENT) };
        capture(folder, config, &Tuning::default(), &scene, |i, inputs| {
            for light in 0..lights {
                let seen = drawn(i, 10 + light as u32);
                let distance = seen.iter().map(|v| [if v[0] > 0.0 { 0.0 } else { 1.5 }, 0.0, 0.0, 0.0]).collect();
                inputs.images.push((Input::NOISY_VISIBILITY[light].name, seen));
                inputs.images.push((Input::OCCLUDER_DISTANCE[light].name, distance));
                let unshadowed = vec![[0.2 + 0.1 * light as f32, 0.3, 0.1, 1.0]; inputs.guides.clean.len()];
                inputs.images.push((Input::UNSHADOWED_DIRECT[light].name, unshadowed));
                inputs.params.lights[light] = [0.1 * light as f32 + 0.01 * i as f32, 2.0, 0.5, 1.0];
            }
        })
    };
    let folders = [(); 3].map(|()| tempfile::tempdir().expect("a folder"));
    let pictures = frames(folders[0].path(), &config, 4);
    assert!(pictures != frames(folders[1].path(), &Config { visibility: 3, ..config }, 3), "the fourth light changes nothing");
    assert!(pictures != frames(folders[2].path(), &Config { coloured_visibility: false, ..config }, 4), "colours change nothing");
    let (setup, _) = assert_same_bits(folders[0].path(), &pictures);
    assert_eq!((setup.config.visibility, setup.config.coloured_visibility), (4, true));
}

/// It is in no picture, so that its inputs are compared.
fn ambient_occlusion_is_replayed() {
    let config = Config { ambient_occlusion: true, ..Config::new(EXTENT) };
    let folder = tempfile::tempdir().expect("a folder");
    let inputs = [(Input::NOISY_AMBIENT.name, 20), (Input::AMBIENT_DISTANCE.name, 21)];
    let scene = Scene { speed: 0.05, ..Scene::new(EXTENT) };
    let pictures = capture(folder.path(), &config, &Tuning::default(), &scene, |i, own| {
        own.images.extend(inputs.map(|(name, salt)| (name, drawn(i, salt))));
    });
    let (setup, frames) = assert_same_bits(folder.path(), &pictures);
    assert!(setup.config.ambient_occlusion);
    for (i, frame) in (0..).zip(&frames) {
        for (name, salt) in inputs {
            let given = drawn(i, salt).into_iter().map(|v| v[0]);
            assert!(frame.images[name].iter().map(|v| v[0]).eq(given), "{name}, frame {i}");
        }
    }
}

/// A thing that moves in the surfaces, by its motion: what the frames give depends on it.
fn the_motion_of_reflections_is_replayed() {
    let config = Config { signals: Signals::Specular, ..Config::new(EXTENT) };
    let frames = |folder: &Path, given: bool| {
        let scene = Scene { speed: 0.05, ..Scene::new(EXTENT) };
        capture(folder, &config, &Tuning::default(), &scene, |i, inputs| {
            let motion = drawn(i, 30).into_iter().map(|[x, y, z, _]| [0.3 * x, 0.2 * y, -0.1 * z, 0.0]).collect();
            inputs.images.extend(given.then_some((Input::SPECULAR_MOTION.name, motion)));
        })
    };
    let [with, without] = [(); 2].map(|()| tempfile::tempdir().expect("a folder"));
    let pictures = frames(with.path(), true);
    assert!(pictures != frames(without.path(), false), "it changes nothing, so nothing was tested");
    assert_replays(with.path(), &pictures);
}

/// Half the light, an output of another size, or both; a part of the images is rendered.
fn light_and_output_of_other_sizes_are_replayed() {
    let extent = [48, 26];
    for (allocated, halved, output) in [
        (extent, [true, true], Some([72, 40])),
        (extent, [true, false], None),
        (extent, [false; 2], Some([96, 52])),
        ([60, 40], [true, true], Some([62, 40])),
    ] {
        let folder = tempfile::tempdir().expect("a folder");
        let light = [0, 1].map(|i| if halved[i] { allocated[i] / 2 } else { allocated[i] });
        let config = Config {
            light_extent: (light != allocated).then_some(light),
            output_extent: output,
            visibility: 2,
            volume: output.is_none(),
            ..Config::new(allocated)
        };
        let scene = Scene { speed: 0.05, allocated, ..Scene::new(extent) };
        let mut s = session(&config);
        s.capture(folder.path(), FRAMES).expect("a capture");
        let offset = |i: u32| [i % 2 * u32::from(halved[0]), i / 2 % 2 * u32::from(halved[1])];
        let mut pictures = Vec::new();
        for i in 0..FRAMES {
            upload_traced(&mut s, &scene.frame(i, i), offset(i));
            let params = FrameParams { light_offset: offset(i), jitter: [0.1 * i as f32, -0.2], ..scene.params(i) };
            s.run(&params, &Tuning::default()).expect("a frame");
            let names: &[&str] = if output.is_some() { &["upscaled_radiance"] } else { &["denoised_radiance", "denoised_volume"] };
            let parts: Vec<Picture> = names.iter().map(|name| s.download(name).expect("a picture")).collect();
            let sum = |k: usize| {
                parts.iter().fold([0.0, 0.0, 0.0, 1.0], |sum: [f32; 4], part| {
                    let [r, g, b, _] = part[k];
                    [sum[0] + r, sum[1] + g, sum[2] + b, 1.0]
                })
            };
            pictures.push((0..parts[0].len()).map(sum).collect::<Picture>());
        }
        assert_eq!(s.finish_capture().expect("written"), FRAMES);
        assert_valid();
        if output.is_none() {
            let rows = |picture: Picture| {
                picture.chunks_exact(allocated[0] as usize).take(extent[1] as usize).flatten().copied().collect()
            };
            pictures = pictures.into_iter().map(rows).collect();
        }
        assert_replays(folder.path(), &pictures);
        let (setup, frames) = load(folder.path());
        assert_eq!(setup.config.output_extent, output);
        assert_eq!(setup.config.light_extent.is_some(), config.light_extent.is_some());
        assert_eq!(frames.iter().map(|f| f.params.light_offset).collect::<Vec<_>>(), (0..FRAMES).map(offset).collect::<Vec<_>>());
    }
}
