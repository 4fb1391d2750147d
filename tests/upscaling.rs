//! An output larger than what is rendered.

use super::support::display::{enlarged, reference, scene};
use super::support::{assert_valid, frame, rmse, scene::Scene, session, upload, upload_traced};
use atrous::config::{PostProcess, Preset};
use atrous::reference::luminance;
use atrous::{Config, Error, FrameParams, ResetReason, Setup, ToneCurve, Tuning};
use atrous_harness::DeviceTest;

pub const TESTS: &[DeviceTest] = &[
    ("the_output_is_better_than_an_enlarged_picture", the_output_is_better_than_an_enlarged_picture),
    ("a_render_extent_that_changes_resets_nothing", a_render_extent_that_changes_resets_nothing),
    ("an_output_that_changes_resets_nothing", an_output_that_changes_resets_nothing),
    ("an_output_beyond_the_allocated_one_is_refused", an_output_beyond_the_allocated_one_is_refused),
    ("a_lamp_that_switches_causes_no_lag", a_lamp_that_switches_causes_no_lag),
    ("a_cut_is_a_first_frame", a_cut_is_a_first_frame),
    ("a_ratio_out_of_range_is_refused", a_ratio_out_of_range_is_refused),
    ("images_of_the_output_have_its_extent", images_of_the_output_have_its_extent),
];

const EXTENT: [u32; 2] = [96, 54];
const FRAMES: u32 = 24;

/// Halton's points of the bases 2 and 3, around 0.
fn jitter(index: u32) -> [f32; 2] {
    [2, 3].map(|base| {
        let (mut i, mut digit, mut sum) = (index % 16 + 1, 1.0, 0.0);
        while i > 0 {
            digit /= base as f32;
            sum += digit * (i % base) as f32;
            i /= base;
        }
        sum - 0.5
    })
}

fn the_output_is_better_than_an_enlarged_picture() {
    for (output, speed) in [([192, 108], 0.0), ([192, 108], 0.02), ([144, 81], 0.02), ([288, 162], 0.0)] {
        let mut s = session(&Config { output_extent: Some(output), ..Config::new(EXTENT) });
        let (mut upscaled, mut bilinear) = (0.0, 0.0);
        for i in 0..FRAMES {
            let scene = scene(EXTENT, speed, jitter(i));
            let (_, image) = frame(&mut s, &scene.frame(i, i), &scene.params(i), &Tuning::default());
            if i >= FRAMES - 4 {
                let right = reference(output, speed, i);
                upscaled += rmse(&s.download("upscaled_radiance").expect("an output"), &right);
                bilinear += rmse(&enlarged(&image, EXTENT, output, jitter(i)), &right);
            }
        }
        println!("{output:?} at speed {speed}: {:.3} of the error of a bilinear enlargement", upscaled / bilinear);
        assert!(upscaled < 0.75 * bilinear, "{output:?} at speed {speed}: {upscaled} {bilinear}");
    }
    assert_valid();
}

fn a_render_extent_that_changes_resets_nothing() {
    let output = [192, 108];
    let error = |extent: &dyn Fn(u32) -> [u32; 2]| {
        let mut s = session(&Config { output_extent: Some(output), ..Config::new(EXTENT) });
        let mut last = Vec::new();
        for i in 0..FRAMES {
            let scene = Scene { allocated: EXTENT, ..scene(extent(i), 0.0, jitter(i)) };
            let (context, image) = frame(&mut s, &scene.frame(0, i), &scene.params(0), &Tuning::default());
            assert_eq!(context.reset, (i == 0).then_some(ResetReason::Created), "frame {i}");
            assert_eq!(context.output_extent, output);
            last = image;
        }
        // The last frame has the whole extent.
        [s.download("upscaled_radiance").expect("an output"), enlarged(&last, EXTENT, output, jitter(FRAMES - 1))]
            .map(|picture| rmse(&picture, &reference(output, 0.0, 0)))
    };
    let ([steady, _], [changing, bilinear]) = (error(&|_| EXTENT), error(&|i| if i % 3 == 1 { [80, 45] } else { EXTENT }));
    println!("error with a steady extent {steady:.4}, with one that changes {changing:.4}");
    assert!(changing < 1.15 * steady, "{steady} {changing}");
    assert!(changing < 0.75 * bilinear, "{changing}, of an enlarged picture {bilinear}");
    assert_valid();
}

/// The top left of a picture.
fn corner(picture: &[[f32; 4]], allocated: [u32; 2], [width, height]: [u32; 2]) -> Vec<[f32; 4]> {
    picture.chunks_exact(allocated[0] as usize).take(height as usize).flat_map(|row| row[..width as usize].to_vec()).collect()
}

fn an_output_that_changes_resets_nothing() {
    let (allocated, small) = ([192, 108], [150, 84]);
    for (before, after, speed) in [(allocated, small, 0.02), (small, allocated, 0.0)] {
        // The error in the frame `at`, from whose first change on the output is another.
        let error = |at: u32, output: &dyn Fn(u32) -> [u32; 2]| {
            let mut s = session(&Config { output_extent: Some(allocated), ..Config::new(EXTENT) });
            for i in 0..=at {
                let scene = scene(EXTENT, speed, jitter(i));
                let params = FrameParams { output_extent: Some(output(i)), ..scene.params(i) };
                let (context, _) = frame(&mut s, &scene.frame(i, i), &params, &Tuning::default());
                assert_eq!(context.reset, (i == 0).then_some(ResetReason::Created), "frame {i}");
                assert_eq!(context.output_extent, output(i));
            }
            let picture = s.download("upscaled_radiance").expect("an output");
            rmse(&corner(&picture, allocated, output(at)), &reference(output(at), speed, at))
        };
        let change = |at: u32| error(at, &|i| if i < FRAMES { before } else { after });
        let steady = |at: u32| error(at, &|_| after);
        // A picture that was smaller has less in it, until new frames are gathered.
        let (blurs, later) = (after[0] > before[0], FRAMES + 16);
        let was = if blurs { error(FRAMES, &|_| before) } else { steady(FRAMES) };
        let (changed, settled, first) = (change(FRAMES), change(later) / steady(later), error(0, &|_| after));
        println!(
            "{before:?} to {after:?} at speed {speed}: {changed:.4} after {was:.4}, later {settled:.3} of steady, first {first:.4}"
        );
        assert!(changed < if blurs { 1.15 } else { 1.05 } * was && settled < 1.12, "{changed} {was} {settled}");
    }
    assert_valid();
}

fn an_output_beyond_the_allocated_one_is_refused() {
    let run = |config: Option<[u32; 2]>, output: [u32; 2]| {
        let mut s = session(&Config { output_extent: config, ..Config::new(EXTENT) });
        upload(&mut s, &Scene::new(EXTENT).frame(0, 0));
        s.run(&FrameParams { output_extent: Some(output), ..FrameParams::new(EXTENT) }, &Tuning::default()).map(|_| ())
    };
    run(Some([192, 108]), [100, 108]).expect("a part of it");
    let beyond = run(Some([192, 108]), [193, 108]).expect_err("too wide");
    assert!(matches!(beyond, Error::FrameOutput { .. }), "{beyond}");
    assert!(beyond.to_string().contains("[193, 108]") && beyond.to_string().contains("[192, 108]"), "{beyond}");
    let ratio = run(Some([192, 108]), [95, 108]).expect_err("a ratio below 1").to_string();
    assert!(ratio.contains("FrameParams::output_extent") && ratio.contains("[95, 108]") && ratio.contains("1 to 3"), "{ratio}");
    assert!(matches!(run(None, [97, 54]), Err(Error::FrameOutput { .. })));
}

/// Error of the first frame after a lamp switched, against that without history.
fn a_lamp_that_switches_causes_no_lag() {
    let output = [192, 108];
    let low = Config { output_extent: Some(output), ..Config::new(EXTENT) };
    let half = Config { light_extent: Some(EXTENT), ..Config::new(output) };
    let half = Config { output_extent: Some(output), ..half };
    let taa = Config { post_process: PostProcess::ToneMapTaa, ..Config::new(output) };
    let tuning = Tuning { tone_curve: ToneCurve::Reinhard, ..Tuning::default() };
    let lit = reference(output, 0.02, FRAMES);
    for (way, config, name) in
        [("low frames", low, "upscaled_radiance"), ("half the light", half, "upscaled_radiance"), ("taa", taa, "display")]
    {
        for (before, after) in [(0.3, 1.0), (1.0, 0.3)] {
            let right = lit.iter().map(|c| {
                let c = c.map(|c| c * after);
                if name == "display" {
                    c.map(|x| x / (1.0 + luminance([c[0], c[1], c[2]])))
                } else {
                    c
                }
            });
            let right: Vec<[f32; 4]> = right.collect();
            let error = |cut: bool| {
                let mut s = session(&config);
                for i in 0..=FRAMES {
                    let light = if i < FRAMES { before } else { after };
                    let scene = Scene { light, ..scene(config.allocated_extent, 0.02, jitter(i)) };
                    let reset = (cut && i == FRAMES).then_some(ResetReason::CameraCut);
                    upload_traced(&mut s, &scene.frame(i, i), [0; 2]);
                    s.run(&FrameParams { reset, ..scene.params(i) }, &tuning).expect("a frame");
                }
                rmse(&s.download(name).expect("an output"), &right)
            };
            let (with, without) = (error(false), error(true));
            println!("{way}, {before} to {after}: {with:.4}, without history {without:.4}");
            assert!(with < 1.05 * without, "{way}, {before} to {after}: {with} {without}");
        }
    }
    assert_valid();
}

fn a_cut_is_a_first_frame() {
    let config = Config { output_extent: Some([192, 108]), post_process: PostProcess::ToneMap, ..Config::new(EXTENT) };
    let run = |frames: u32| {
        let mut s = session(&config);
        for i in 0..frames {
            // What was before is a darker place.
            let scene = Scene { light: if i + 1 == frames { 1.0 } else { 0.3 }, ..scene(EXTENT, 0.0, jitter(7)) };
            let reset = (i + 1 == frames).then_some(ResetReason::CameraCut);
            frame(&mut s, &scene.frame(0, 5), &FrameParams { reset, ..scene.params(0) }, &Tuning::default());
        }
        s.download("display").expect("an output")
    };
    assert!(run(1) == run(4), "a cut shows something of the past");
    assert_valid();
}

fn a_ratio_out_of_range_is_refused() {
    let declare = |output| Config { output_extent: Some(output), ..Config::new(EXTENT) }.declare();
    for output in [EXTENT, [288, 162], [97, 161]] {
        declare(output).expect("a ratio from 1 to 3");
    }
    for output in [[95, 54], [96, 53], [289, 162], [96, 163]] {
        let error = declare(output).expect_err("out of range");
        let text = error.to_string();
        assert!(matches!(error, Error::OutputExtent { .. }) && text.contains(&format!("{output:?}")), "{text}");
        assert!(text.contains("[96, 54]") && text.contains("1 to 3"), "{text}");
    }
    for output in [[0, 54], [96, 20_000]] {
        assert!(matches!(declare(output).expect_err("no extent"), Error::Extent { what: "Config::output_extent", .. }));
    }
    // A frame that renders too little for its output.
    let mut s = session(&Config { output_extent: Some([192, 108]), ..Config::new(EXTENT) });
    upload(&mut s, &Scene::new(EXTENT).frame(0, 0));
    let error = s.run(&FrameParams::new([63, 54]), &Tuning::default()).expect_err("a ratio above 3");
    assert!(error.to_string().contains("[63, 54]"), "{error}");
    let set = |text: &str| Config::new(EXTENT).set("output_extent", text);
    assert_eq!((set("192x108"), set("none")), (Ok(()), Ok(())));
    assert!(set("192").expect_err("no extent").to_string().contains("640x360"));
}

fn images_of_the_output_have_its_extent() {
    let output = [192, 81];
    for preset in Preset::ALL {
        for post_process in [PostProcess::None, PostProcess::ToneMap, PostProcess::ToneMapTaa] {
            let config = Config { preset, post_process, output_extent: Some(output), ..Config::new(EXTENT) };
            let declaration = config.declare().expect("valid");
            let name = if post_process == PostProcess::None { "upscaled_radiance" } else { "display" };
            for name in [name, "upscale_history"] {
                let resource = declaration.resource(declaration.find(name).expect(name));
                assert_eq!(resource.extent(declaration.setup()), Some(output), "{preset}, {name}");
                assert_eq!(resource.bytes(declaration.setup()), 8 * 192 * 81, "{preset}, {name}");
            }
            let guide = declaration.resource(declaration.find("guide").expect("guide"));
            assert_eq!(guide.extent(declaration.setup()), Some(EXTENT));
            let larger = declaration.with_extent([100, 60]).expect("another extent");
            assert_eq!(larger.setup(), &Setup { allocated_extent: [100, 60], ..*declaration.setup() });
        }
    }
}
