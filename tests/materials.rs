//! Classes of materials, each filtered by numbers of its own.

use super::support::scene::{pixels, rmse, Guides, Scene};
use super::support::{assert_valid, frame, session, svgf, svgf_tuning};
use atrous::config::{Preset, Signals};
use atrous::executor::Session;
use atrous::{Config, Counter, FrameParams, Material, Tuning};
use atrous_harness::DeviceTest;

pub const TESTS: &[DeviceTest] = &[
    ("a_screen_stays_sharp_by_its_class", a_screen_stays_sharp_by_its_class),
    ("hair_needs_no_normals_by_its_class", hair_needs_no_normals_by_its_class),
    ("a_class_has_a_longest_history_of_its_own", a_class_has_a_longest_history_of_its_own),
    ("usual_numbers_change_no_bit", usual_numbers_change_no_bit),
    ("classes_beyond_the_table_are_counted", classes_beyond_the_table_are_counted),
    ("numbers_out_of_range_are_refused", numbers_out_of_range_are_refused),
];

const EXTENT: [u32; 2] = [66, 40];
/// Of a sequence.
const FRAMES: u32 = 6;
type Picture = Vec<[f32; 4]>;

/// Frames with one class where `is_of_class`, and class 0 elsewhere: the last of what came out.
fn denoised(
    config: &Config,
    tuning: &Tuning,
    material: Option<Material>,
    is_of_class: impl Fn(u32, u32) -> bool,
    guides: impl Fn(u32) -> Guides,
) -> (Session, Picture) {
    let scene = Scene::new(EXTENT);
    let mut s = session(&Config { material_class: material.is_some(), ..*config });
    let classes: Vec<u32> = pixels(EXTENT).map(|(x, y)| 5 * u32::from(is_of_class(x, y))).collect();
    let mut last = Vec::new();
    for i in 0..FRAMES {
        let mut params = scene.params(i);
        params.materials[5] = material.unwrap_or_default();
        let guides = guides(i);
        super::support::upload(&mut s, &guides);
        if material.is_some() {
            s.upload_ids("material_class", &classes).expect("material_class");
        }
        s.run(&params, tuning).expect("a frame");
        last = s.download("denoised_radiance").expect("an output");
    }
    assert_valid();
    (s, last)
}

/// Text on a screen before a noisy wall: one surface, whose light alone differs.
fn a_screen_stays_sharp_by_its_class() {
    let is_screen = |x: u32, y: u32| (32..44).contains(&x) && (6..18).contains(&y);
    let text = |x: u32, y: u32, i: u32| if (x / 2 + y / 3 + i).is_multiple_of(2) { 0.9 } else { 0.5 };
    let scene = Scene { noise: 0.6, ..Scene::new(EXTENT) };
    let guides = |i: u32| {
        let mut guides = scene.frame(0, i);
        for (k, (x, y)) in pixels(EXTENT).enumerate().filter(|(_, (x, y))| is_screen(*x, *y)) {
            guides.albedo[k] = [1.0; 4];
            guides.noisy_radiance[k] = [text(x, y, i); 4];
            guides.clean[k] = guides.noisy_radiance[k];
        }
        guides
    };
    let config = Config { preset: Preset::Fast, levels: Some(2), ..Config::new(EXTENT) };
    let tuning = Tuning::for_preset(config.preset);
    let sharp = Material { light: 0.01, longest_history: 1.0, ..Material::default() };
    let [usual, by_class] = [Material::default(), sharp].map(|m| denoised(&config, &tuning, Some(m), is_screen, guides).1);
    let truth = guides(FRAMES - 1).clean;
    let of_screen = |image: &[[f32; 4]]| -> Picture {
        pixels(EXTENT).zip(image).filter(|((x, y), _)| is_screen(*x, *y)).map(|(_, texel)| *texel).collect()
    };
    let [usual_error, error] = [&usual, &by_class].map(|image| rmse(&of_screen(image), &of_screen(&truth)));
    assert!(error < 0.1 * usual_error, "error of the screen {error}, without a class {usual_error}");
    // Two levels reach three pixels.
    for (((x, y), a), b) in pixels(EXTENT).zip(&usual).zip(&by_class).filter(|(((x, _), _), _)| *x < 8) {
        assert_eq!(a, b, "{x}, {y} lies far from the screen");
    }
}

/// Hair: normals of any direction, other ones in every frame.
fn hair_needs_no_normals_by_its_class() {
    let scene = Scene::new(EXTENT);
    let guides = |i: u32| {
        let mut guides = scene.frame(0, i);
        for (k, normal) in guides.normal.iter_mut().enumerate() {
            let angle = (k as f32 * 2.4 + i as f32 * 1.7) % 6.3;
            *normal = [angle.sin(), 0.3, angle.cos(), 0.0];
        }
        guides
    };
    let hair = Material { normal: 100.0, ..Material::default() };
    let [usual, by_class] = [Material::default(), hair]
        .map(|material| denoised(&svgf(EXTENT), &svgf_tuning(), Some(material), |_, _| true, guides))
        .map(|(mut s, image)| (rmse(&image, &guides(FRAMES - 1).clean), lost_by_normal(&mut s)));
    assert!(by_class.0 < 0.6 * usual.0, "error by class {}, without {}", by_class.0, usual.0);
    assert!(by_class.1 == 0 && usual.1 > 100, "surfaces without history: by class {}, without {}", by_class.1, usual.1);
}

fn lost_by_normal(s: &mut Session) -> u32 {
    s.download("statistics").expect("counters")[Counter::LostNormal as usize][0] as u32
}

/// Light that was doubled in the last frame shows at once where the history is short.
fn a_class_has_a_longest_history_of_its_own() {
    let scene = Scene { noise: 0.0, ..Scene::new(EXTENT) };
    let guides = |i: u32| Scene { light: if i + 1 < FRAMES { 1.0 } else { 2.0 }, ..scene }.frame(0, 0);
    let short = Material { longest_history: 1.0, ..Material::default() };
    let truth = guides(FRAMES - 1).clean;
    for signals in [Signals::Together, Signals::Mixed] {
        let config = Config { signals, ..svgf(EXTENT) };
        let (_, image) = denoised(&config, &svgf_tuning(), Some(short), |x, _| x >= 24, guides);
        let light = |image: &[[f32; 4]], is_right: bool| -> f32 {
            let far = |x: u32| if is_right { x >= 36 } else { x < 12 };
            pixels(EXTENT).zip(image).filter(|((x, _), _)| far(*x)).map(|(_, texel)| texel[1]).sum()
        };
        let [left, right] = [false, true].map(|side| light(&image, side) / light(&truth, side));
        assert!(
            (right - 1.0).abs() < 0.03 && left < 0.9,
            "{signals:?}: light with a history of one frame {right}, with the usual one {left}"
        );
    }
}

fn usual_numbers_change_no_bit() {
    let guides = |i: u32| Scene { speed: 0.05, ..Scene::new(EXTENT) }.frame(i, i);
    let with = |material| {
        denoised(
            &Config { preset: Preset::Fast, ..Config::new(EXTENT) },
            &Tuning::default(),
            material,
            |x, y| (x + y) % 3 == 0,
            guides,
        )
        .1
    };
    assert!(with(None) == with(Some(Material::default())), "classes with the usual numbers changed the picture");
}

fn classes_beyond_the_table_are_counted() {
    for signals in [Signals::Together, Signals::Specular, Signals::Mixed] {
        classes_of(Config { signals, ..svgf(EXTENT) });
    }
}

fn classes_of(config: Config) {
    let scene = Scene::new(EXTENT);
    let mut s = session(&Config { material_class: true, ..config });
    let mut plain = session(&config);
    let guides = scene.frame(0, 0);
    let surfaces = guides.surface_id.iter().filter(|id| **id != 0).count();
    let expected = frame(&mut plain, &guides, &scene.params(0), &svgf_tuning()).1;
    super::support::upload(&mut s, &guides);
    let all: Vec<u32> = pixels(EXTENT).map(|(x, _)| if x % 2 == 0 { 16 } else { u32::MAX }).collect();
    s.upload_ids("material_class", &all).expect("material_class");
    let mut params = scene.params(0);
    params.materials[15] = [0.01, 0.01, 0.01, 1.0].into();
    s.run(&params, &svgf_tuning()).expect("a frame");
    let bad = s.statistics().expect("counters")[Counter::MaterialClass];
    assert_eq!(bad as usize, surfaces, "each surface is counted once");
    assert!(s.download("denoised_radiance").expect("an output") == expected, "they do not count as class 0");
    assert_valid();
}

fn numbers_out_of_range_are_refused() {
    let scene = Scene::new(EXTENT);
    let mut s = session(&Config { material_class: true, ..svgf(EXTENT) });
    super::support::upload(&mut s, &scene.frame(0, 0));
    for (place, name, range) in
        [(0, "depth", "0.01 to 100"), (1, "normal", "0.01"), (2, "light", "0.01"), (3, "longest_history", "1 to 1024")]
    {
        for bad in [f32::NAN, -1.0, 0.0, f32::INFINITY, 2000.0] {
            let mut numbers: [f32; 4] = Material::default().into();
            numbers[place] = bad;
            let mut materials = [Material::default(); Material::CLASSES];
            materials[7] = numbers.into();
            let error = s.run(&FrameParams { materials, ..scene.params(0) }, &svgf_tuning()).expect_err(name).to_string();
            let wanted = [format!("materials[7].{name} is {bad}"), range.to_owned(), "Material::default()".to_owned()];
            assert!(wanted.iter().all(|part| error.contains(part)), "{error}");
        }
    }
}
