//! What the denoiser reaches on real path-traced input, inside the engine, under validation.

use ash::vk::Extent2D;
use atrous::config::{EawWeights, PostProcess, Preset, Signals};
use atrous::ToneCurve;
use atrous_engine::testing::{built_in, Validated, SMALL};
use atrous_engine::{DenoiserOptions, FrameDenoiser, PathTracer, SceneOptions, TracerOptions};
use atrous_measure::measure::{Frame, Scores};

const EXTENT: Extent2D = Extent2D { width: 256, height: 144 };

/// Where fewer pixels tell as much.
const SMALLER: Extent2D = Extent2D { width: 160, height: 90 };

/// Scores of the noisy picture of the last of `frames` frames, and of each denoised one, lights and nothing else held still. The noise of the
/// reference is left out.
fn last_frame(gpu: &Validated, name: &str, frames: u32, options: &[DenoiserOptions]) -> Vec<Scores> {
    let scene = built_in(name, SceneOptions { static_light: true, ..SceneOptions::default() });
    let tracer_options = TracerOptions {
        jitter: options.iter().any(|options| options.config.post_process == PostProcess::ToneMapTaa),
        ..TracerOptions::default()
    };
    let mut tracer = PathTracer::new(&gpu.0, &scene, EXTENT, tracer_options).expect("a path tracer");
    let mut denoisers: Vec<_> =
        options.iter().map(|options| FrameDenoiser::new(&gpu.0, &tracer, options).expect("a denoiser")).collect();
    for index in 0..frames {
        tracer.begin_frame(index).expect("a frame");
        denoisers.iter_mut().for_each(|denoiser| denoiser.render(&mut tracer).expect("a submit"));
    }
    let mut frame = Frame::read(&gpu.0, &tracer, &mut denoisers).expect("pictures");
    let moment = scene.moment(frame.index);
    frame.set_halves([frames, frames + 1].map(|seed| {
        tracer.begin_moment(seed, &moment, &moment).expect("a frame");
        tracer.render_reference(32, |_, _| {}).expect("a reference").radiance()
    }));
    let scores = frame.scores(None).expect("finite pictures").expect("a reference");
    println!("{name}, frame {}: noisy {:?}, denoised {:?}", frame.index, scores[0], &scores[1..]);
    scores
}

fn with(signals: Signals) -> DenoiserOptions {
    DenoiserOptions::new(Preset::Svgf).with(|config| config.signals = signals)
}

fn assert_cleaner(noisy: Scores, denoised: Scores) {
    assert!(denoised.rmse <= noisy.rmse / 3.0, "{} of {}", denoised.rmse, noisy.rmse);
}

#[test]
fn cornell_is_clean() {
    let Some(gpu) = Validated::new() else { return };
    let scores = last_frame(&gpu, "cornell", 8, &[with(Signals::Apart), with(Signals::Together)]);
    assert_cleaner(scores[0], scores[1]);
    assert_cleaner(scores[0], scores[2]);
    assert!(scores[1].ssim >= 0.93, "SSIM {}", scores[1].ssim);
}

#[test]
fn pillars_are_clean() {
    let Some(gpu) = Validated::new() else { return };
    let scores = last_frame(&gpu, "pillars", 12, &[with(Signals::Apart)]);
    assert_cleaner(scores[0], scores[1]);
    assert!(scores[1].ssim >= 0.93, "SSIM {}", scores[1].ssim);
}

/// [EAW] Figure 4: without weights it is a blur, and each weight that is added keeps more of what should not be blurred.
#[test]
fn each_weight_of_eaw_improves_a_single_frame() {
    let Some(gpu) = Validated::new() else { return };
    let mut tracer = PathTracer::new(&gpu.0, &built_in("cornell", SceneOptions::default()), SMALLER, TracerOptions::default())
        .expect("a path tracer");
    let reference = tracer.render_reference(64, |_, _| {}).expect("a reference").radiance();
    let errors = [0, 1, 2, 3].map(|count| {
        let options = DenoiserOptions::new(Preset::Eaw).with(|config| config.eaw_weights = EawWeights::first(count));
        let mut denoiser = FrameDenoiser::new(&gpu.0, &tracer, &options).expect("a denoiser");
        denoiser.render(&mut tracer).expect("a submit");
        let mut frame = Frame::read(&gpu.0, &tracer, [&mut denoiser]).expect("pictures");
        frame.reference = Some(reference.clone());
        let scores = frame.scores(None).expect("finite pictures").expect("a reference");
        [scores[0].rmse, scores[1].rmse]
    });
    println!("noisy, and with 0 to 3 weights: {errors:.4?}");
    assert!(errors.windows(2).all(|pair| pair[1][1] < pair[0][1]), "{errors:?}");
    let [noisy, filtered] = errors[3];
    assert!(filtered * filtered <= noisy * noisy / 10.0, "{errors:?}");
}

/// Root mean square errors of a jittered display, linear and clipped at 1, against means over the pixel: without and with anti-aliasing.
fn display_errors(gpu: &Validated, motion: SceneOptions) -> [f64; 2] {
    const JITTERS: u32 = 8;
    let scene = built_in("pillars", SceneOptions { static_light: true, ..motion });
    let mut tracer = PathTracer::new(&gpu.0, &scene, SMALLER, TracerOptions { jitter: true, ..TracerOptions::default() })
        .expect("a path tracer");
    let mut denoisers = [PostProcess::ToneMap, PostProcess::ToneMapTaa].map(|post_process| {
        let mut options = DenoiserOptions::new(Preset::Best).with(|config| config.post_process = post_process);
        options.tuning.tone_curve = ToneCurve::Linear;
        FrameDenoiser::new(&gpu.0, &tracer, &options).expect("a denoiser")
    });
    let last = 15;
    for index in 0..=last {
        tracer.begin_frame(index).expect("a frame");
        denoisers.iter_mut().for_each(|denoiser| denoiser.render(&mut tracer).expect("a submit"));
    }
    let displays = denoisers.each_mut().map(|denoiser| denoiser.read("display").expect("a display"));
    let moment = scene.moment(last);
    let mut reference = vec![[0.0; 3]; displays[0].len()];
    for jitter in 0..JITTERS {
        tracer.begin_moment(jitter, &moment, &moment).expect("a frame");
        let radiance = tracer.render_reference(8, |_, _| {}).expect("a reference").radiance();
        for (sum, texel) in reference.iter_mut().zip(radiance) {
            (0..3).for_each(|c| sum[c] += texel[c].min(1.0) / JITTERS as f32);
        }
    }
    displays.map(|display| {
        let squares = display.iter().zip(&reference).flat_map(|(a, b)| (0..3).map(move |c| f64::from(a[c] - b[c]).powi(2)));
        (squares.sum::<f64>() / (3 * reference.len()) as f64).sqrt()
    })
}

#[test]
fn anti_aliasing_is_nearer_to_the_mean_over_the_pixel_still_and_moving() {
    let Some(gpu) = Validated::new() else { return };
    let still = SceneOptions { static_camera: true, static_objects: true, ..SceneOptions::default() };
    for (name, motion) in [("still", still), ("moving", SceneOptions::default())] {
        let [without, with] = display_errors(&gpu, motion);
        println!("pillars, {name}: {without:.4} without anti-aliasing, {with:.4} with, {:.2} of it", with / without);
        assert!(with < 0.8 * without, "{name}: {with} of {without}");
    }
}

#[test]
fn two_runs_are_bit_identical() {
    let Some(gpu) = Validated::new() else { return };
    let run = || {
        let scene = built_in("pillars", SceneOptions::default());
        let tracer_options = TracerOptions { jitter: true, ..TracerOptions::default() };
        let mut tracer = PathTracer::new(&gpu.0, &scene, SMALL, tracer_options).expect("a path tracer");
        let options = DenoiserOptions::new(Preset::Svgf).with(|config| config.post_process = PostProcess::ToneMapTaa);
        let mut denoiser = FrameDenoiser::new(&gpu.0, &tracer, &options).expect("a denoiser");
        for index in 0..5 {
            tracer.begin_frame(index).expect("a frame");
            denoiser.render(&mut tracer).expect("a submit");
        }
        denoiser.read("display").expect("display")
    };
    let first = run();
    assert!(first.iter().flatten().all(|v| v.is_finite()));
    assert_eq!(first, run());
}
