//! Light of fewer pixels than the guides.

use super::support::display::{enlarged, reference, scene};
use super::support::{
    assert_finite, assert_valid, frame, pixels, rmse, scene::Guides, scene::Scene, session, upload, upload_traced,
};
use atrous::config::{Preset, Signals};
use atrous::executor::Session;
use atrous::{Config, Error, FrameParams, ResetReason, Tuning};
use atrous_harness::DeviceTest;

pub const TESTS: &[DeviceTest] = &[
    ("half_the_light_is_better_than_an_enlarged_picture", half_the_light_is_better_than_an_enlarged_picture),
    ("an_offset_that_changes_is_as_good_as_one_that_does_not", an_offset_that_changes_is_as_good_as_one_that_does_not),
    ("light_that_is_not_finite_leaves_no_hole", light_that_is_not_finite_leaves_no_hole),
    ("a_cut_with_half_the_light_is_a_first_frame", a_cut_with_half_the_light_is_a_first_frame),
    ("light_of_another_size_is_refused", light_of_another_size_is_refused),
    ("images_of_light_have_its_extent", images_of_light_have_its_extent),
    ("light_of_every_pixel_changes_nothing", light_of_every_pixel_changes_nothing),
    ("a_volume_of_half_the_light_ends_where_surfaces_do", a_volume_of_half_the_light_ends_where_surfaces_do),
    ("normals_change_nothing_of_a_volume_of_half_the_light", normals_change_nothing_of_a_volume_of_half_the_light),
    ("half_the_visibility_of_several_lights_is_of_each_its_own", half_the_visibility_of_several_lights_is_of_each_its_own),
    ("a_mask_of_half_the_light_marks_what_came_into_view", a_mask_of_half_the_light_marks_what_came_into_view),
];

const EXTENT: [u32; 2] = [96, 54];
const HALF: [u32; 2] = [48, 27];
const FRAMES: u32 = 20;

/// Some points around 0.
fn jitter(index: u32) -> [f32; 2] {
    [0.618_034, 0.754_878].map(|step| (index as f32 * step).fract() - 0.5)
}

/// Each of the four pixels of a cell in turn.
fn offset(index: u32) -> [u32; 2] {
    [[0, 0], [1, 1], [1, 0], [0, 1]][index as usize % 4]
}

fn half() -> Config {
    Config { light_extent: Some(HALF), output_extent: Some(EXTENT), ..Config::new(EXTENT) }
}

/// Runs a frame, of which each cell has light at the offset; returns the picture.
fn traced_frame(s: &mut Session, guides: &Guides, params: &FrameParams) -> Vec<[f32; 4]> {
    upload_traced(s, guides, params.light_offset);
    s.run(params, &Tuning::default()).expect("a frame");
    for name in ["denoised_radiance", "upscaled_radiance"] {
        assert_finite(&s.download(name).expect(name), EXTENT, EXTENT);
    }
    s.download("upscaled_radiance").expect("an output")
}

/// The error of the last frames, by the offset of each.
fn error_of(speed: f32, offset: fn(u32) -> [u32; 2]) -> f64 {
    let mut s = session(&half());
    let mut error = 0.0;
    for i in 0..FRAMES {
        let scene = scene(EXTENT, speed, jitter(i));
        let params = FrameParams { light_offset: offset(i), ..scene.params(i) };
        let picture = traced_frame(&mut s, &scene.frame(i, i), &params);
        error += if i >= FRAMES - 4 { rmse(&picture, &reference(EXTENT, speed, i)) / 4.0 } else { 0.0 };
    }
    assert_valid();
    error
}

fn half_the_light_is_better_than_an_enlarged_picture() {
    for speed in [0.0, 0.02] {
        let mut s = session(&Config::new(HALF));
        let mut bilinear = 0.0;
        for i in 0..FRAMES {
            let scene = scene(HALF, speed, jitter(i));
            let (_, image) = frame(&mut s, &scene.frame(i, i), &scene.params(i), &Tuning::default());
            bilinear += if i >= FRAMES - 4 {
                rmse(&enlarged(&image, HALF, EXTENT, jitter(i)), &reference(EXTENT, speed, i)) / 4.0
            } else {
                0.0
            };
        }
        let error = error_of(speed, offset);
        println!("at speed {speed}: {:.3} of the error of a bilinear enlargement", error / bilinear);
        assert!(error < 0.5 * bilinear, "at speed {speed}: {error} {bilinear}");
    }
    assert_valid();
}

fn an_offset_that_changes_is_as_good_as_one_that_does_not() {
    for speed in [0.0, 0.02] {
        let (changing, steady) = (error_of(speed, offset), error_of(speed, |_| [0; 2]));
        println!("at speed {speed}: {:.3} of the error with a steady offset", changing / steady);
        assert!(changing < 1.02 * steady, "at speed {speed}: {changing} {steady}");
    }
}

fn light_that_is_not_finite_leaves_no_hole() {
    let mut s = session(&Config { signals: Signals::Specular, visibility: 1, ..half() });
    for i in 0..4 {
        let scene = scene(EXTENT, 0.02, jitter(i));
        let mut guides = scene.frame(i, i);
        for images in [&mut guides.noisy_diffuse, &mut guides.noisy_specular] {
            // Whole neighbourhoods, and everything in one frame.
            let is_bad = |k: usize| i == 2 || k % 96 < 40 || k % 7 < 2;
            images.iter_mut().enumerate().filter(|(k, _)| is_bad(*k)).for_each(|(_, texel)| *texel = [f32::NAN; 4]);
        }
        traced_frame(&mut s, &guides, &FrameParams { light_offset: offset(i), ..scene.params(i) });
        assert_finite(&s.download("denoised_visibility").expect("an output"), EXTENT, EXTENT);
    }
    assert_valid();
}

fn a_cut_with_half_the_light_is_a_first_frame() {
    let run = |frames: u32| {
        let mut s = session(&half());
        let mut last = Vec::new();
        for i in 0..frames {
            let is_last = i + 1 == frames;
            // What was before is a darker place.
            let scene = Scene { light: if is_last { 1.0 } else { 0.3 }, ..scene(EXTENT, 0.0, jitter(7)) };
            let reset = is_last.then_some(ResetReason::CameraCut);
            let light_offset = if is_last { [1, 0] } else { offset(i) };
            last = traced_frame(&mut s, &scene.frame(0, 5), &FrameParams { reset, light_offset, ..scene.params(0) });
        }
        last
    };
    assert!(run(1) == run(4), "a cut shows something of the past");
    assert_valid();
}

fn light_of_another_size_is_refused() {
    let declare = |light| Config { light_extent: Some(light), ..Config::new(EXTENT) }.declare();
    for light in [EXTENT, HALF, [48, 54], [96, 27]] {
        declare(light).expect("all of the pixels, or half of them");
    }
    for light in [[0, 27], [47, 27], [48, 28], [36, 18], [192, 108]] {
        let error = declare(light).expect_err("neither");
        let text = error.to_string();
        assert!(matches!(error, Error::LightExtent { .. }) && text.contains(&format!("{light:?}")), "{text}");
        assert!(text.contains("[96, 54]") && text.contains("half") && text.contains("Config::light_extent"), "{text}");
    }
    let odd = Config { light_extent: Some([47, 27]), ..Config::new([95, 54]) }.declare().expect_err("half of an odd number");
    assert!(odd.to_string().contains("[95, 54]"), "{odd}");
    // Frames.
    let mut s = session(&Config { light_extent: Some([48, 54]), ..Config::new(EXTENT) });
    upload_traced(&mut s, &Scene::new(EXTENT).frame(0, 0), [0; 2]);
    let error = s.run(&FrameParams::new([95, 54]), &Tuning::default()).expect_err("an odd width").to_string();
    assert!(error.contains("[95, 54]") && error.contains("even"), "{error}");
    s.run(&FrameParams::new([94, 53]), &Tuning::default()).expect("an even width");
    for light_offset in [[2, 0], [0, 1]] {
        let params = FrameParams { light_offset, ..FrameParams::new(EXTENT) };
        let error = s.run(&params, &Tuning::default()).expect_err("beyond the cell").to_string();
        assert!(error.contains("light_offset") && error.contains(&format!("{light_offset:?}")), "{error}");
    }
    let set = |text: &str| Config::new(EXTENT).set("light_extent", text);
    assert_eq!((set("48x27"), set("none")), (Ok(()), Ok(())));
}

fn images_of_light_have_its_extent() {
    for preset in [Preset::Svgf, Preset::Asvgf, Preset::Percentile, Preset::Fast, Preset::Best, Preset::Eaw] {
        let config = Config { preset, visibility: 1, light_extent: Some(HALF), ..Config::new(EXTENT) };
        let declaration = config.declare().expect("valid");
        let extent = |declaration: &atrous::Declaration, name: &str| {
            declaration.resource(declaration.find(name).expect(name)).extent(declaration.setup()).expect(name)
        };
        for name in ["noisy_radiance", "noisy_visibility", "occluder_distance", "guide", "surface_motion"] {
            assert_eq!(extent(&declaration, name), HALF, "{preset}, {name}");
        }
        for name in ["depth", "albedo", "emission", "denoised_radiance", "denoised_visibility", "unshadowed_direct"] {
            assert_eq!(extent(&declaration, name), EXTENT, "{preset}, {name}");
        }
        let larger = declaration.with_extent([100, 60]).expect("another extent");
        assert_eq!(extent(&larger, "guide"), [50, 30]);
        assert!(matches!(declaration.with_extent([101, 60]), Err(Error::LightExtent { .. })));
    }
}

fn light_of_every_pixel_changes_nothing() {
    let declare = |light_extent| Config { light_extent, ..Config::new(EXTENT) }.declare().expect("valid");
    let (whole, none) = (declare(Some(EXTENT)), declare(None));
    assert_eq!((whole.resources(), whole.passes().len()), (none.resources(), none.passes().len()));
}

/// Beside edges of depth, where there is more of the volume on one side.
fn a_volume_of_half_the_light_ends_where_surfaces_do() {
    for preset in [Preset::Volume, Preset::Best] {
        let config = Config { preset, volume: preset != Preset::Volume, light_extent: Some(HALF), ..Config::new(EXTENT) };
        let mut s = session(&config);
        let mut low = session(&Config { preset: Preset::Volume, ..Config::new(HALF) });
        let (mut error, mut bilinear) = (0.0, 0.0);
        for i in 0..FRAMES {
            let (scene, small) = (scene(EXTENT, 0.02, [0.0; 2]), scene(HALF, 0.02, [0.0; 2]));
            let (guides, fewer) = (scene.frame(i, i), small.frame(i, i));
            // Fog without noise, the thicker the farther one sees.
            let fog = |guides: &Guides| -> Vec<[f32; 4]> {
                let sight = guides.depth.iter().map(|depth| if depth[0] > 0.0 { depth[0] } else { 1e6 });
                sight.map(|depth| [1.0 - (-0.3 * depth).exp(); 4]).collect()
            };
            let foggy = |guides: Guides| Guides {
                noisy_volume: fog(&guides),
                scattering_depth: vec![[0.0; 4]; guides.depth.len()],
                ..guides
            };
            let (clean, fewer) = (foggy(guides), foggy(fewer));
            upload_traced(&mut s, &clean, offset(i));
            s.run(&FrameParams { light_offset: offset(i), ..scene.params(i) }, &Tuning::default()).expect("a frame");
            upload(&mut low, &fewer);
            low.run(&small.params(i), &Tuning::default()).expect("a frame");
            let [volume, low] = [&mut s, &mut low].map(|s| s.download("denoised_volume").expect("an output"));
            assert_finite(&volume, EXTENT, EXTENT);
            let depth = |k: usize| if clean.depth[k][0] > 0.0 { clean.depth[k][0] } else { 1e6 };
            let is_edge = |k: &usize| {
                k % 96 > 1 && [k - 1, k - 2].iter().any(|other| depth(*k) > 1.2 * depth(*other) || depth(*other) > 1.2 * depth(*k))
            };
            let beside = |picture: &[[f32; 4]]| (2..picture.len()).filter(is_edge).map(|k| picture[k]).collect::<Vec<_>>();
            let right = beside(&clean.noisy_volume);
            assert!(right.len() > 50, "{}", right.len());
            error = rmse(&beside(&volume), &right);
            bilinear = rmse(&beside(&enlarged(&low, HALF, EXTENT, [0.0; 2])), &right);
        }
        println!("{preset}: {error:.4} beside edges, of an enlarged picture {bilinear:.4}");
        assert!(error < 0.9 * bilinear, "{preset}: {error} {bilinear}");
    }
    assert_valid();
}

/// Fog lies before surfaces: how rough they are is nothing to it, as it would be to their own light.
fn normals_change_nothing_of_a_volume_of_half_the_light() {
    let config = Config { preset: Preset::Volume, light_extent: Some(HALF), ..Config::new(EXTENT) };
    let [mut smooth, mut rough] = [(); 2].map(|()| session(&config));
    for i in 0..3 {
        let scene = scene(EXTENT, 0.02, [0.0; 2]);
        let guides = scene.frame(i, i);
        let normal = |k: usize| [(k as f32 * 2.4).sin(), 0.3, (k as f32 * 2.4).cos(), 0.0];
        let bumpy = Guides { normal: (0..guides.normal.len()).map(normal).collect(), ..guides.clone() };
        let pictures = [(&mut smooth, &guides), (&mut rough, &bumpy)].map(|(s, guides)| {
            upload_traced(s, guides, offset(i));
            s.run(&FrameParams { light_offset: offset(i), ..scene.params(i) }, &Tuning::default()).expect("a frame");
            s.download("denoised_volume").expect("an output")
        });
        assert!(pictures[0] == pictures[1], "frame {i}");
    }
    assert_valid();
}

fn half_the_visibility_of_several_lights_is_of_each_its_own() {
    let outputs = ["denoised_visibility", "denoised_visibility_1", "denoised_visibility_2"];
    for coloured_visibility in [false, true] {
        let config = Config { visibility: 3, coloured_visibility, light_extent: Some(HALF), ..Config::new(EXTENT) };
        let mut s = session(&config);
        let mut guides = None;
        for i in 0..FRAMES {
            let scene = Scene { speed: 0.02, ..Scene::new(EXTENT) };
            let now = scene.frame(i, i);
            upload_traced(&mut s, &now, offset(i));
            s.run(&FrameParams { light_offset: offset(i), ..scene.params(i) }, &Tuning::default()).expect("a frame");
            guides = Some(now);
        }
        let guides = guides.expect("frames");
        let [second, third, _] = &guides.further_lights;
        let red = |texels: &[[f32; 4]]| texels.iter().map(|texel| [texel[0]; 4]).collect::<Vec<_>>();
        let clean = [&guides.clean_visibility, &second.clean_visibility, &third.clean_visibility].map(|clean| red(clean));
        for (light, name) in outputs.into_iter().enumerate() {
            let picture = s.download(name).expect(name);
            assert_finite(&picture, EXTENT, EXTENT);
            let errors: Vec<f64> = clean.iter().map(|clean| rmse(&red(&picture), clean)).collect();
            println!("light {light}, coloured {coloured_visibility}: error against each light {errors:.3?}");
            let others = (0..3).filter(|other| *other != light).map(|other| errors[other]);
            assert!(others.fold(f64::INFINITY, f64::min) > 1.8 * errors[light], "light {light}: {errors:?}");
        }
    }
    assert_valid();
}

fn a_mask_of_half_the_light_marks_what_came_into_view() {
    let came = |x: u32, y: u32| (31..50).contains(&x) && (17..40).contains(&y);
    for light_extent in [None, Some(HALF)] {
        let mut s = session(&Config { reactive_mask: true, light_extent, ..Config::new(EXTENT) });
        for i in 0..9 {
            let scene = Scene::new(EXTENT);
            let mut guides = scene.frame(0, i);
            if i == 8 {
                let in_view = pixels(EXTENT).enumerate().filter(|(_, (x, y))| came(*x, *y));
                in_view.for_each(|(k, _)| guides.depth[k] = [0.5; 4]);
            }
            let light_offset = if light_extent.is_some() { offset(i) } else { [0; 2] };
            upload_traced(&mut s, &guides, light_offset);
            s.run(&FrameParams { light_offset, ..scene.params(0) }, &Tuning::default()).expect("a frame");
        }
        let mask = s.download("reactive_mask").expect("an output");
        assert_eq!(mask.len(), 96 * 54);
        let new = pixels(EXTENT).zip(&mask).filter(|(_, texel)| texel[0] > 0.9);
        let (right, wrong): (Vec<_>, Vec<_>) = new.partition(|((x, y), _)| came(*x, *y));
        println!("{light_extent:?}: {} pixels are new, and {} that are not are marked", right.len(), wrong.len());
        assert!(right.len() == 19 * 23 && wrong.len() < 20, "{light_extent:?}: {} {}", right.len(), wrong.len());
    }
    assert_valid();
}
