//! Reflections: no older than the picture around them, and as good as the light that is not mirrored.

use ash::vk::Extent2D;
use atrous::config::{Preset, Signals};
use atrous_engine::testing::{built_in, Validated};
use atrous_engine::{DenoiserOptions, FrameDenoiser, Gpu, PathTracer, SceneOptions, TracerOptions};
use atrous_lab::scores::{rmse, Rgb};
use atrous_measure::measure::Frame;

const EXTENT: Extent2D = Extent2D { width: 160, height: 90 };
const PATHS: u32 = 64;

type Picture = Vec<[f32; 3]>;

fn options(signals: Signals) -> DenoiserOptions {
    DenoiserOptions::new(Preset::Best).with(|config| config.signals = signals)
}

/// The denoised pictures of the last of `frames` frames, and the references of the last few, the newest first.
fn run(gpu: &Gpu, scene: &str, frames: u32, references: u32, options: &[DenoiserOptions]) -> (Vec<Picture>, Vec<Picture>) {
    let scene = built_in(scene, SceneOptions { static_light: true, ..SceneOptions::default() });
    let mut tracer = PathTracer::new(gpu, &scene, EXTENT, TracerOptions::default()).expect("a path tracer");
    let mut denoisers: Vec<_> = options.iter().map(|o| FrameDenoiser::new(gpu, &tracer, o).expect("a denoiser")).collect();
    let mut truths = Vec::new();
    for index in 0..frames {
        tracer.begin_frame(index).expect("a frame");
        denoisers.iter_mut().for_each(|denoiser| denoiser.render(&mut tracer).expect("a submit"));
        if index + references >= frames {
            truths.insert(0, tracer.render_reference(PATHS, |_, _| {}).expect("a reference").radiance());
        }
    }
    let frame = Frame::read(gpu, &tracer, &mut denoisers).expect("pictures");
    let pictures = frame.pictures().skip(1).map(<[_]>::to_vec).collect();
    (pictures, truths)
}

/// Pixels of a rectangle, as shares of the picture.
fn cut(picture: &Picture, [left, top, right, bottom]: [f32; 4]) -> Picture {
    let column = |share: f32| (share * EXTENT.width as f32) as usize;
    let row = |share: f32| (share * EXTENT.height as f32) as usize;
    let pixels = (row(top)..row(bottom)).flat_map(|y| (column(left)..column(right)).map(move |x| (x, y)));
    pixels.map(|(x, y)| picture[y * EXTENT.width as usize + x]).collect()
}

fn correlation(a: &Picture, b: &Picture) -> f64 {
    let values = |picture: &Picture| picture.iter().flatten().map(|x| f64::from(*x)).collect::<Vec<_>>();
    let centred = |v: Vec<f64>| {
        let mean = v.iter().sum::<f64>() / v.len() as f64;
        v.into_iter().map(|x| x - mean).collect::<Vec<_>>()
    };
    let (a, b) = (centred(values(a)), centred(values(b)));
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    product(&a, &b) / (product(&a, &a) * product(&b, &b)).sqrt()
}

fn error(a: &Picture, b: &Picture) -> f64 {
    let image = |picture| Rgb::new(a.len() as u32, 1, picture).expect("as many pixels");
    rmse(image(a), image(b)).expect("finite pictures")
}

/// Frames by which a picture is behind its references, by the best correlation.
fn lag(picture: &Picture, truths: &[Picture], rectangle: [f32; 4]) -> usize {
    let of = cut(picture, rectangle);
    let found: Vec<f64> = truths.iter().map(|truth| correlation(&of, &cut(truth, rectangle))).collect();
    println!("correlation with the references of this frame, the one before, ...: {found:.4?}");
    (0..found.len()).max_by(|a, b| found[*a].total_cmp(&found[*b])).expect("references")
}

/// The panel on the left is polished, and a ball moves in it.
#[test]
fn what_moves_in_a_still_mirror_is_not_behind() {
    let Some(gpu) = Validated::new() else { return };
    let (pictures, truths) = run(&gpu, "mirror", 20, 3, &[options(Signals::Specular)]);
    assert!(lag(&pictures[0], &truths, [0.2, 0.1, 0.5, 0.55]) <= 1);
}

/// Rough mirrors that reflect balls while the camera goes round them. On the balls themselves what is seen moves by less than a tenth of a
/// pixel a frame, too little to tell frames apart.
#[test]
fn reflections_follow_a_moving_camera_and_have_less_error_apart() {
    let Some(gpu) = Validated::new() else { return };
    let (pictures, truths) = run(&gpu, "glossy", 16, 3, &[options(Signals::Together), options(Signals::Specular)]);
    for panel in [[0.25, 0.1, 0.45, 0.35], [0.47, 0.1, 0.6, 0.35]] {
        assert!(lag(&pictures[1], &truths, panel) <= 1);
    }
    let metals = [0.2, 0.1, 0.75, 0.8];
    let truth = cut(&truths[0], metals);
    let [together, apart] = [0, 1].map(|i| error(&cut(&pictures[i], metals), &truth));
    println!("RMSE together {together:.4}, apart {apart:.4}");
    assert!(apart < 0.85 * together, "{apart} of {together}");
}
