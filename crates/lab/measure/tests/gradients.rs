//! A-SVGF in the engine: gradient samples that are shaded again, under validation.

use ash::vk::Extent2D;
use atrous::config::Preset;
use atrous::DebugView;
use atrous_engine::testing::{built_in, Validated};
use atrous_engine::{DenoiserOptions, FrameDenoiser, PathTracer, SampleEye, SceneOptions, TracerOptions};
use atrous_measure::measure::Frame;

const EXTENT: Extent2D = Extent2D { width: 160, height: 90 };

fn pair(gpu: &Validated, name: &str, scene: SceneOptions, preset: Preset) -> (PathTracer, FrameDenoiser) {
    pair_with(gpu, name, scene, DenoiserOptions::new(preset))
}

fn pair_with(gpu: &Validated, name: &str, scene: SceneOptions, options: DenoiserOptions) -> (PathTracer, FrameDenoiser) {
    let tracer = PathTracer::new(&gpu.0, &built_in(name, scene), EXTENT, TracerOptions::default()).expect("a path tracer");
    let options = options.with(|config| config.debug_view = true);
    let denoiser = FrameDenoiser::new(&gpu.0, &tracer, &options).expect("a denoiser");
    (tracer, denoiser)
}

/// Strata with a sample, of all.
fn samples(denoiser: &mut FrameDenoiser) -> (usize, usize) {
    let texels = denoiser.read("gradient_samples").expect("gradient_samples");
    (texels.iter().filter(|t| t[2] != 0.0).count(), texels.len())
}

/// Pixels with a gradient, frame by frame, in a scene of which the camera alone may move.
fn changes(gpu: &Validated, name: &str, static_camera: bool, options: DenoiserOptions) -> Vec<usize> {
    let still = SceneOptions { static_light: true, static_objects: true, static_camera };
    let (mut tracer, mut denoiser) = pair_with(gpu, name, still, options);
    let frame = |index| {
        tracer.begin_frame(index).expect("a frame");
        denoiser.render(&mut tracer).expect("a submit");
        let views = denoiser.executor().denoiser().declaration().debug_views();
        assert!(views.contains(&DebugView::Gradient) && views.contains(&DebugView::Lambda), "{views:?}");
        let gradient = denoiser.view(DebugView::Gradient).expect("gradient");
        let changed = gradient.iter().filter(|t| **t != [0.0; 4]).count();
        let lambda = denoiser.view(DebugView::Lambda).expect("lambda");
        assert!(changed > 0 || lambda.iter().all(|t| t[3] == 0.0), "{name}, frame {index}: history is dropped");
        let (valid, all) = samples(&mut denoiser);
        assert!(index == 0 || 2 * valid > all, "{name}, frame {index}: {valid} samples in {all} strata");
        changed
    };
    (0..6).map(frame).collect()
}

/// On diffuse surfaces from any eye; on others where the camera stands still, or where samples keep the eye that saw them, as they do
/// where reflections are followed by themselves.
#[test]
fn where_nothing_changes_the_gradient_is_exactly_zero() {
    let Some(gpu) = Validated::new() else { return };
    let current = DenoiserOptions::new(Preset::Asvgf);
    let kept = DenoiserOptions { sample_eye: Some(SampleEye::Kept), ..current };
    let best = DenoiserOptions::new(Preset::Best);
    let cases = [
        ("cornell", false, current),
        ("glossy", true, current),
        ("glossy", false, kept),
        ("hall", false, kept),
        ("glossy", false, best),
    ];
    for (name, static_camera, options) in cases {
        let seen = changes(&gpu, name, static_camera, options);
        assert_eq!(
            seen, [0; 6],
            "{name}, {:?}, {:?}: pixels with a gradient in each frame",
            options.config.preset, options.sample_eye
        );
    }
}

/// Samples are shaded for the eye of the frame: that the camera moves is a change on a fifth of the pixels.
fn assert_the_camera_is_seen(name: &str, preset: Preset) {
    let Some(gpu) = Validated::new() else { return };
    let seen = changes(&gpu, name, false, DenoiserOptions::new(preset));
    let pixels = (EXTENT.width * EXTENT.height) as usize;
    assert!(seen[0] == 0 && seen[1..].iter().all(|changed| 5 * changed > pixels), "{seen:?} of {pixels} pixels");
}

/// \[ASVGF, Figure 1\]
#[test]
fn a_highlight_that_moves_with_the_camera_is_seen() {
    assert_the_camera_is_seen("glossy", Preset::Asvgf);
}

/// By all filters: there the light of diffuse surfaces depends on the eye, too.
#[test]
fn fog_before_a_surface_is_seen_to_change_with_the_camera() {
    assert_the_camera_is_seen("fog", Preset::Best);
}

#[test]
fn flickering_light_leaves_half_of_the_error_of_svgf() {
    let Some(gpu) = Validated::new() else { return };
    let scene = SceneOptions::default();
    let (mut tracer, mut asvgf) = pair(&gpu, "cornell", scene, Preset::Asvgf);
    let mut svgf = FrameDenoiser::new(&gpu.0, &tracer, &DenoiserOptions::new(Preset::Svgf)).expect("a denoiser");
    // The light goes out with frame 8 and comes on with frame 16.
    let (mut sums, mut after_switches) = ([0.0; 2], 0);
    for index in 0..18 {
        tracer.begin_frame(index).expect("a frame");
        gpu.0
            .submit(|cmd| {
                tracer.record_gbuffer(cmd);
                asvgf.record(cmd, &mut tracer)?;
                svgf.record(cmd, &mut tracer)
            })
            .expect("a submit");
        if ![5, 8, 9, 12, 16, 17].contains(&index) {
            continue;
        }
        let mut frame = Frame::read(&gpu.0, &tracer, [&mut svgf, &mut asvgf]).expect("pictures");
        frame.set_reference(tracer.render_reference(64, |_, _| {}).expect("a reference"));
        let scores = frame.scores(None).expect("finite pictures").expect("a reference");
        println!("frame {index}: noisy {:.4}, SVGF {:.4}, A-SVGF {:.4}", scores[0].rmse, scores[1].rmse, scores[2].rmse);
        sums[0] += scores[1].rmse;
        sums[1] += scores[2].rmse;
        if [8, 9, 16, 17].contains(&index) {
            assert!(scores[2].rmse <= 0.45 * scores[1].rmse, "frame {index}");
            after_switches += 1;
        }
        if [8, 16].contains(&index) {
            assert_the_change_is_seen(&mut asvgf, if index == 8 { -1.0 } else { 1.0 });
        }
    }
    assert_eq!(after_switches, 4);
    assert!(sums[1] <= 0.55 * sums[0], "A-SVGF {} against SVGF {}", sums[1], sums[0]);
}

/// `direction`: 1 where light came on, −1 where it went out.
fn assert_the_change_is_seen(denoiser: &mut FrameDenoiser, direction: f32) {
    let gradient = denoiser.view(DebugView::Gradient).expect("gradient");
    let (red, blue) = gradient.iter().fold((0.0, 0.0), |sum, t| (sum.0 + t[0], sum.1 + t[2]));
    assert!((red - blue) * direction > 0.5 * gradient.len() as f32, "red {red}, blue {blue}");
    let lambda = denoiser.view(DebugView::Lambda).expect("lambda");
    let mean = lambda.iter().map(|t| t[3]).sum::<f32>() / lambda.len() as f32;
    assert!(mean > 0.5, "mean lambda {mean}");
}

/// A reference is rendered between two frames, and other denoisers share the tracer: neither may disturb the samples that are kept.
#[test]
fn samples_are_those_of_the_denoiser_alone() {
    let still = SceneOptions { static_light: true, static_objects: true, static_camera: false };
    let Some(gpu) = Validated::new() else { return };
    let run = |disturbed: bool| {
        let (mut tracer, mut asvgf) = pair(&gpu, "glossy", still, Preset::Asvgf);
        let mut eaw = FrameDenoiser::new(&gpu.0, &tracer, &DenoiserOptions::new(Preset::Eaw)).expect("a denoiser");
        for index in 0..4 {
            tracer.begin_frame(index).expect("a frame");
            asvgf.render(&mut tracer).expect("a submit");
            if disturbed {
                eaw.render(&mut tracer).expect("a submit");
                tracer.render_reference(1, |_, _| {}).expect("a reference");
            }
        }
        asvgf.read("denoised_radiance").expect("denoised_radiance")
    };
    assert!(run(false) == run(true));
}
