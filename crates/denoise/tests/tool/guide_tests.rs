//! Guides and parts of the light that are noise, or that lack something.

use super::look_tests::{folder, looked_at, red, written};
use crate::samples::scene::{Frame, Scene, SIZE};
use crate::samples::{self, frame_path, Sample, Type};
use atrous_denoise::exr_read::{read, Samples};
use atrous_denoise::roles::Role;
use atrous_denoise::setup::{Options, Setup};
use atrous_denoise::{first_look, frame, frame_files};
use atrous_lab::pictures::Picture;

#[test]
fn depth_is_looked_up_for_what_the_camera_carries() {
    let scene = Scene { is_carried: true, ..Scene::default() };
    let input = written(scene, 3, |_, frame| frame.plain());
    let (setup, _) = looked_at(input.path());
    assert!(setup.carries_depth && setup.report.iter().any(|line| line.contains("it is looked up")), "{:?}", setup.report);
    let frames = frame_files::find(&[input.path().to_owned()]).expect("frames");
    let mut loader = atrous_denoise::loader::Loader::new(&setup);
    let loaded: Vec<_> = frames.iter().map(|files| loader.load(files).expect("a frame")).collect();
    let pixels = scene.frame(2).pixels;
    let carried = |i: &usize| pixels[*i].id == 3;
    let differs = |i: &usize| (loaded[2].images["motion"][*i][2] / pixels[*i].depth - 1.0).abs() > 0.02;
    let ball = (0..pixels.len()).filter(carried).count();
    // At the rim, the ball was another pixel.
    assert!(ball > 30 && (0..pixels.len()).filter(carried).filter(differs).count() * 2 < ball, "of {ball}");
}

#[test]
fn guides_that_are_noise_are_not_trusted() {
    let input = folder();
    for number in 0..2 {
        let mut pixels = Scene::default().frame(number).pixels.to_vec();
        for (i, seen) in pixels.iter_mut().enumerate().filter(|(i, _)| samples::noise(*i as i32, 3, 50 + number) < 0.5) {
            (seen.albedo, seen.normal, seen.depth) = ([0.02; 3], [1.0, 0.0, 0.0], if i % 2 == 0 { 0.3 } else { 40.0 });
        }
        Frame { pixels: std::rc::Rc::new(pixels) }.plain().write(&frame_path(input.path(), number));
    }
    let (setup, _) = looked_at(input.path());
    assert!(setup.smoothed.contains("normal"), "{:?}", setup.report);
    assert!(!setup.mapping.has(Role::Albedo) && !setup.mapping.has(Role::Depth), "{:?}", setup.report);
    let frames = frame_files::find(&[input.path().to_owned()]).expect("frames");
    // Half of the pixels had one that points to the side: now none is as it was.
    let normals = frame::load(&frames[0], &setup).expect("a frame").images["normal"].clone();
    assert!(normals.iter().all(|normal| normal[0] < 0.9));
    // What the user names is taken.
    let options = Options { channels: vec![(Role::Albedo, "albedo".into())], ..Options::default() };
    let mut named = Setup::new(&frames, &options).expect("a setup");
    first_look::take(&frames, &mut named).expect("a look");
    assert!(named.mapping.has(Role::Albedo));
}

/// Frames with an albedo that is noise. `are_means`: where two surfaces meet, and in fog, normals are means. `fog`: half of the pixels have other depths.
fn noisy_albedos(are_means: bool, fog: Option<[f32; 2]>) -> tempfile::TempDir {
    let input = folder();
    for number in 0..6 {
        let mut pixels = Scene::default().frame(number).pixels.to_vec();
        let ids: Vec<u32> = pixels.iter().map(|seen| seen.id).collect();
        for (i, seen) in pixels.iter_mut().enumerate() {
            seen.albedo = [noisy_albedo(number, i); 3];
            let is_outline = [1, SIZE[0]].iter().any(|step| ids.get(i + step).is_some_and(|id| *id != ids[i]));
            let is_part = is_outline || (fog.is_some() && samples::noise(i as i32, 6, 50 + number) < 0.5);
            seen.normal = seen.normal.map(|v| if are_means && is_part { 0.7 * v } else { v });
            if let Some(depths) = fog {
                seen.depth = depths[usize::from(samples::noise(i as i32, 4, 50 + number) < 0.5)];
            }
        }
        Frame { pixels: std::rc::Rc::new(pixels) }.plain().write(&frame_path(input.path(), number));
    }
    input
}

/// Frames of Blender in fog: at half of the pixels no surface has met the ray. `depth`: of the others.
fn in_fog(depth: impl Fn(u32, usize) -> f32) -> tempfile::TempDir {
    written(Scene::default(), 2, |number, frame| {
        let mut pixels = frame.pixels.to_vec();
        for (i, seen) in pixels.iter_mut().enumerate() {
            let is_met = samples::noise(i as i32, 5, 60 + number) < 0.5;
            (seen.id, seen.depth) = if is_met { (7, depth(number, i)) } else { (0, 1e10) };
        }
        let frame = Frame { pixels: std::rc::Rc::new(pixels) };
        let sample = frame.add(Frame::sample(), "ViewLayer.Combined", "RGB", |s| s.noisy);
        let sample = frame.add(sample, "ViewLayer.Depth", "Z", |s| [s.depth]);
        let sample = frame.add(sample, "ViewLayer.Vector", "XY", |_| [0.0; 2]);
        let sample = frame.add(sample, "ViewLayer.IndexOB", "X", |s| [s.id as f32]);
        let sample = frame.add(sample, "ViewLayer.VolumeDir", "RGB", |s| s.noisy.map(|v| 0.25 * v));
        frame.add(sample, "ViewLayer.VolumeInd", "RGB", |_| [0.0; 3])
    })
}

/// Gaps in depth are filled, and fog is filtered with what is behind it: each sample shows one of them.
#[test]
fn gaps_that_fog_makes_are_filled() {
    let input = in_fog(|_, _| 3.0);
    let (setup, _) = looked_at(input.path());
    assert!(setup.mapping.has(Role::Depth) && !setup.mapping.has(Role::Volume), "{:?}", setup.report);
    assert!(setup.report.iter().any(|line| line.contains("depth has gaps")), "{:?}", setup.report);
    let frames = frame_files::find(&[input.path().to_owned()]).expect("frames");
    let inputs = frame::load(&frames[0], &setup).expect("a frame");
    let ids = inputs.surface_id.expect("ids");
    let near = |i: &usize| inputs.images["depth"][*i][0] == 3.0 && ids[*i] == 8;
    let far = |i: &usize| inputs.images["depth"][*i][0] == 6.0 && ids[*i] != 0;
    let filled = (0..ids.len()).filter(near).count();
    assert!((0..ids.len()).all(|i| near(&i) || far(&i)) && filled * 50 > ids.len() * 49, "{filled} of {}", ids.len());
    // Beyond all depths of a device's buffer is no place.
    let options = Options { conventions: vec![("depth".into(), "device".into())], ..Options::default() };
    let mut of_device = Setup::new(&frames, &options).expect("a setup");
    first_look::take(&frames, &mut of_device).expect("a look");
    assert_eq!(of_device.beyond, None);
    // What depth of field mixes has no surface that fills it.
    let (setup, _) = looked_at(in_fog(|number, i| [0.3, 40.0][usize::from(samples::noise(i as i32, 6, 60 + number) < 0.5)]).path());
    assert!(!setup.mapping.has(Role::Depth) && setup.mapping.has(Role::Volume), "{:?}", setup.report);
}

fn noisy_albedo(number: u32, pixel: usize) -> f32 {
    0.2 + 0.6 * samples::noise(pixel as i32, 3, 50 + number)
}

/// Where it is a mean over a pixel, and depths say whose it is, its noise is averaged over frames instead of being left out.
#[test]
fn noise_of_an_albedo_is_averaged() {
    let input = noisy_albedos(true, None);
    let (setup, _) = looked_at(input.path());
    assert!(setup.mapping.has(Role::Albedo), "{:?}", setup.report);
    let frames = frame_files::find(&[input.path().to_owned()]).expect("frames");
    let mut loader = atrous_denoise::loader::Loader::new(&setup);
    let loaded: Vec<_> = frames.iter().map(|files| loader.load(files).expect("a frame")).collect();
    let pixels = SIZE[0] * SIZE[1];
    let squares = |of: &dyn Fn(usize) -> f32| (0..pixels).map(|i| (of(i) - 0.5).powi(2)).sum::<f32>() / pixels as f32;
    let (given, averaged) = (squares(&|i| noisy_albedo(5, i)), squares(&|i| loaded[5].images["albedo"][i][0]));
    assert!(averaged < 0.5 * given, "{averaged} of {given}");
    // In fog nobody knows whose it is.
    for (depths, are_gaps) in [([0.3, 40.0], false), ([3.0, 0.0], true)] {
        let setup = looked_at(noisy_albedos(true, Some(depths)).path()).0;
        assert_eq!(setup.beyond.is_some(), are_gaps, "{depths:?}");
        assert!(!setup.mapping.has(Role::Albedo), "{depths:?}");
    }
}

/// Where neither motion nor depth and cameras tell the place in the frame before, a mean would smear what moves.
#[test]
fn averages_need_the_place_in_the_frame_before() {
    let without_motion = |_: u32, frame: &Frame| {
        let sample = frame.add(Frame::sample(), "", "RGB", |s| s.noisy);
        frame.add(sample, "depth", "Z", |s| [s.depth])
    };
    let averages = |input: &tempfile::TempDir| looked_at(input.path()).0.averages();
    let with_cameras = written(Scene::default(), 2, without_motion);
    assert!(averages(&with_cameras));
    std::fs::remove_file(with_cameras.path().join("sequence.json")).expect("a file");
    assert!(!averages(&with_cameras));
    let with_motion = written(Scene::default(), 2, |_, frame| frame.plain());
    std::fs::remove_file(with_motion.path().join("sequence.json")).expect("a file");
    assert!(averages(&with_motion));
}

/// In the middle of pixels a print differs from frame to frame as noise does, but a mean would blur it.
#[test]
fn albedos_of_the_middle_of_pixels_are_not_averaged() {
    let input = noisy_albedos(false, None);
    let (setup, _) = looked_at(input.path());
    assert!(!setup.has_means && !setup.mapping.has(Role::Albedo), "{:?}", setup.report);
    let frames = frame_files::find(&[input.path().to_owned()]).expect("frames");
    let options = Options { channels: vec![(Role::Albedo, "albedo".into())], ..Options::default() };
    let mut named = Setup::new(&frames, &options).expect("a setup");
    first_look::take(&frames, &mut named).expect("a look");
    let mut loader = atrous_denoise::loader::Loader::new(&named);
    for (number, files) in frames.iter().enumerate() {
        let albedo = loader.load(files).expect("a frame").images["albedo"].clone();
        let differs = |(i, texel): (usize, &[f32; 4])| (texel[0] - noisy_albedo(number as u32, i)).abs() > 1e-3;
        assert!(!albedo.iter().enumerate().any(differs), "frame {number}");
    }
}

/// The sky is a small part of the picture: it is noise all the same where fog is before it.
#[test]
fn parts_of_the_light_behind_fog_are_not_trusted() {
    let passes = |_: u32, frame: &Frame| {
        let sample = frame.add(Frame::sample(), "ViewLayer.Combined", "RGB", |s| s.noisy);
        let sample = frame.add(sample, "ViewLayer.Depth", "Z", |s| [if s.id == 0 { 1e10 } else { s.depth }]);
        frame.add(sample, "ViewLayer.Env", "RGB", |s| s.environment)
    };
    let is_taken = |fog: f32| {
        let scene = Scene { samples: 8, fog, ..Scene::default() };
        looked_at(written(scene, 2, passes).path()).0.mapping.has(Role::Environment)
    };
    assert!(is_taken(0.0) && !is_taken(0.12));
}

#[test]
fn noise_in_alpha_is_told_of() {
    let told = |is_noisy: bool| {
        let input = written(Scene::default(), 2, move |number, frame| {
            let alpha = move |x: i32, y: i32| if is_noisy { samples::noise(x, y, 70 + number) } else { 0.5 };
            frame.plain().channel("A", samples::Type::Half, alpha)
        });
        looked_at(input.path()).0.report.iter().any(|line| line.contains("alpha is noisy"))
    };
    assert!(told(true) && !told(false));
}

/// Without depth and motion nobody knows where a texture was: that it changes proves little.
#[test]
fn a_texture_that_moves_is_no_noise() {
    let scene = Scene { speed: 0.15, ..Scene::default() };
    let input = written(scene, 2, |_, frame| {
        let sample = frame.add(Frame::sample(), "", "RGB", |s| s.noisy);
        frame.add(sample, "albedo", "RGB", |s| s.albedo)
    });
    assert!(looked_at(input.path()).0.mapping.has(Role::Albedo));
}

/// Jitter meets a print that is finer than pixels elsewhere in every frame.
#[test]
fn a_fine_print_of_jittered_frames_is_no_noise() {
    let is_taken = |jitter: &str, tiles: usize| {
        let input = written(Scene::default(), 2, |number, frame| {
            let mut pixels = frame.pixels.to_vec();
            for (i, seen) in pixels.iter_mut().enumerate() {
                let (x, y) = (i % SIZE[0], i / SIZE[0]);
                if 3 * (y / 16).min(1) + (x / 16).min(2) < tiles {
                    seen.albedo = [0.2 + 0.6 * samples::noise(x as i32, y as i32, 90 + number); 3];
                }
            }
            Frame { pixels: std::rc::Rc::new(pixels) }.plain()
        });
        let path = input.path().join("sequence.json");
        let cameras = std::fs::read_to_string(&path).expect("cameras");
        std::fs::write(&path, cameras.replace(r#""view""#, &format!(r#""jitter": {jitter}, "view""#))).expect("a file");
        looked_at(input.path()).0.mapping.has(Role::Albedo)
    };
    assert!(is_taken("[0.25, -0.25]", 3), "half of the picture is printed");
    assert!(!is_taken("[0.0, 0.0]", 3), "the same pixels of a surface cannot differ");
    assert!(!is_taken("[0.25, -0.25]", 6), "noise in all of the picture is no print");
}

/// Leaves before the sky: each of their pixels is at an outline, and shows more or less of it from frame to frame.
#[test]
fn noise_of_outlines_leaves_no_emission_out() {
    let is_taken = |has_outlines: bool| {
        let input = written(Scene::default(), 2, move |number, frame| {
            let sky = move |x: i32, y: i32| samples::noise(x, y, 110 + number);
            let id = move |x: i32, _: i32| if has_outlines { (x / 2 % 2) as f32 } else { 1.0 };
            let sample = frame.add(Frame::sample(), "ViewLayer.Combined", "RGB", |_| [2.0; 3]);
            let sample = frame.add(sample, "ViewLayer.Depth", "Z", |_| [3.0]);
            let sample = frame.add(sample, "ViewLayer.Vector", "XY", |_| [0.0; 2]).channel("ViewLayer.IndexOB.X", Type::Float, id);
            ["R", "G", "B"].iter().fold(sample, |sample, c| sample.channel(&format!("ViewLayer.Env.{c}"), Type::Half, sky))
        });
        looked_at(input.path()).0.mapping.has(Role::Environment)
    };
    assert!(is_taken(true) && !is_taken(false));
}

/// Rough metal of Mitsuba: its lobe by the angle to the eye. Others are wrong alike all over the ball.
#[test]
fn an_albedo_within_range_or_wrong_all_over_is_taken() {
    for (most, power) in [(1.0_f32, 2), (2.0, 0)] {
        let mut pixels = Scene::default().frame(0).pixels.to_vec();
        pixels.iter_mut().filter(|seen| seen.id == 3).for_each(|seen| seen.albedo = [most * seen.normal[2].powi(power); 3]);
        let input = folder();
        Frame { pixels: std::rc::Rc::new(pixels) }.plain().write(&frame_path(input.path(), 0));
        let setup = looked_at(input.path()).0;
        assert!(setup.mapping.has(Role::Albedo) && !setup.has_lobes, "{most} {:?}", setup.report);
    }
}

/// Frames of light of half the size of their guides, with the pixel that was traced.
fn light_and_guides(offset: &str) -> [tempfile::TempDir; 2] {
    light_and_guides_with(offset, |light| light, |guides| guides)
}

/// The same with further channels.
fn light_and_guides_with(
    offset: &str,
    more_light: impl Fn(Sample) -> Sample,
    more_guides: impl Fn(Sample) -> Sample,
) -> [tempfile::TempDir; 2] {
    let [light, guides] = [folder(), folder()];
    let cameras = super::layout_tests::cameras(&[0.0; 3]);
    std::fs::write(guides.path().join("sequence.json"), &cameras).expect("a file");
    let traced = cameras.replace(r#""view""#, &format!(r#""offset": {offset}, "view""#));
    std::fs::write(light.path().join("sequence.json"), traced).expect("a file");
    for number in 0..3 {
        // Of the light on a print of black and white columns the albedo says which column it fell on.
        let columns = |x: i32, _: i32| if x % 2 == 0 { 0.2 } else { 0.8 };
        let mut of_guides = samples::frame(number);
        of_guides.channels.retain(|(name, ..)| ["depth", "normal", "mv", "id", "prevz"].iter().any(|part| name.starts_with(part)));
        let of_guides =
            ["R", "G", "B"].iter().fold(of_guides, |sample, c| sample.channel(&format!("albedo.{c}"), Type::Half, columns));
        more_guides(of_guides).write(&frame_path(guides.path(), number));
        let of_light = Sample::new(samples::WIDTH / 2, samples::HEIGHT / 2).flat("noisy.R noisy.G noisy.B", Type::Half, 0.4);
        more_light(of_light).write(&frame_path(light.path(), number));
    }
    [light, guides]
}

#[test]
fn light_of_fewer_pixels_has_its_guides_elsewhere() {
    // Light of 0.4 on an albedo of 0.2 is an irradiance of 2, and on one of 0.8 of 0.5.
    for (offset, [even, odd]) in [("[0, 1]", [0.4, 1.6]), ("[1, 0]", [0.1, 0.4])] {
        let ([light, guides], output) = (light_and_guides(offset), folder());
        let guides = guides.path().to_str().expect("UTF-8");
        samples::denoise(light.path(), output.path(), &["--preset", "eaw", "--guides", guides]).expect("a run");
        let result = red(&frame_path(output.path(), 2));
        assert_eq!(result.len(), samples::WIDTH * samples::HEIGHT, "the size of the guides");
        let is_right = |(i, value): (usize, &f32)| (value - if i % 2 == 0 { even } else { odd }).abs() < 0.01;
        assert!(result.iter().enumerate().all(is_right), "{offset}: {:?}", &result[..4]);
    }
}

#[test]
fn visibility_of_fewer_pixels_goes_with_light_of_fewer_pixels() {
    let visibility = |light: Sample| light.flat("visibility.Z", Type::Half, 0.25).flat("occluder_distance.Z", Type::Half, 1.0);
    let parts = |mut guides: Sample| {
        for c in ["R", "G", "B"] {
            guides = guides.channel(&format!("unshadowed_direct.{c}"), Type::Half, |x, _| if x % 2 == 0 { 0.2 } else { 0.8 });
            // Only beside the traced pixels.
            guides = guides.channel(&format!("emission.{c}"), Type::Half, |x, _| if x % 2 == 0 { 0.0 } else { 3.0 });
        }
        guides
    };
    let ([light, guides], output) = (light_and_guides_with("[0, 1]", visibility, parts), folder());
    let arguments = ["--preset", "svgf", "--views", "--guides", guides.path().to_str().expect("UTF-8")];
    samples::denoise(light.path(), output.path(), &arguments).expect("a run");
    let result = red(&frame_path(output.path(), 2));
    // An irradiance of 2 by the albedo, the visible part of the direct light, and what shines.
    let [even, odd] = [2.0 * 0.2 + 0.25 * 0.2, 2.0 * 0.8 + 0.25 * 0.8 + 3.0];
    let is_right = |(i, value): (usize, &f32)| (value - if i % 2 == 0 { even } else { odd }).abs() < 0.02;
    assert!(result.iter().enumerate().all(is_right), "{:?}", &result[..4]);
    let planes = read(&frame_path(output.path(), 2), |channel| channel.name == "denoised_visibility.Z").expect("a frame").samples;
    let Some(Samples::Float(seen)) = planes.get("denoised_visibility.Z") else { panic!("{:?}", planes.keys()) };
    assert!(seen.len() == result.len() && seen.iter().all(|v| (v - 0.25).abs() < 1e-2), "{:?}", &seen[..4]);
    let views = std::fs::read_dir(output.path().join("views")).expect("views").map(|view| view.expect("a file").path());
    let sizes: Vec<_> = views.map(|view| Picture::read_png(&view).expect("a picture")).map(|view| view.width()).collect();
    assert!(sizes.len() > 2 && sizes.iter().all(|width| *width == samples::WIDTH as u32 / 2), "{sizes:?}");
}

#[test]
fn light_that_does_not_fit_its_guides_is_refused() {
    let run = |[light, guides]: &[tempfile::TempDir; 2]| {
        let guides = guides.path().to_str().expect("UTF-8");
        samples::denoise(light.path(), folder().path(), &["--preset", "eaw", "--guides", guides]).expect_err("refused").to_string()
    };
    let beyond = run(&light_and_guides("[0, 2]"));
    assert!(beyond.contains("[0, 2]") && beyond.contains("light_offset"), "{beyond}");
    let folders = light_and_guides("[0, 0]");
    std::fs::remove_file(frame_path(folders[1].path(), 2)).expect("a file");
    let missing = run(&folders);
    assert!(missing.contains("has no frame 2"), "{missing}");
    let folders = light_and_guides("[0, 0]");
    for number in 0..3 {
        Sample::new(10, 6).flat("noisy.R noisy.G noisy.B", Type::Half, 0.4).write(&frame_path(folders[0].path(), number));
    }
    let third = run(&folders);
    assert!(third.contains("[10, 6]") && third.contains("half"), "{third}");
}
