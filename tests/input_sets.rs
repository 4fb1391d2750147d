//! Inputs in the formats of a declaration, and sets of them that stay on the device.

use super::support::{assert_valid, gpu, scene::Scene, session, session_with, upload};
use atrous::config::Signals;
use atrous::executor::{HeadlessDevice, HeadlessOptions, InputSet, Session, SessionOptions};
use atrous::{Config, Error, Lifetime, Shape, Tuning};
use atrous_harness::DeviceTest;
use atrous_synthetic::scene::Guides;
use half::f16;
use std::sync::Arc;

pub const TESTS: &[DeviceTest] = &[
    ("frames_of_sets_give_the_bits_of_uploads", frames_of_sets_give_the_bits_of_uploads),
    ("uploads_leave_a_set_alone", uploads_leave_a_set_alone),
    ("a_set_may_have_more_than_a_declaration_asks_for", a_set_may_have_more_than_a_declaration_asks_for),
    ("inputs_of_the_wrong_size_or_device_are_refused", inputs_of_the_wrong_size_or_device_are_refused),
];

const EXTENT: [u32; 2] = [37, 22];

fn scene() -> Scene {
    Scene { speed: 0.12, ..Scene::new(EXTENT) }
}

/// A frame whose values are halves, so that both ways of uploading keep them.
fn frame(index: u32) -> Guides {
    let mut guides = scene().frame(index, index);
    for image in [&mut guides.depth, &mut guides.normal, &mut guides.motion, &mut guides.albedo, &mut guides.noisy_radiance] {
        image.iter_mut().flatten().for_each(|v| *v = f16::from_f32(*v).to_f32());
    }
    guides
}

/// Uploads the frame in the formats that the declaration prefers, as far as the scene has inputs.
fn upload_preferred(session: &mut Session, guides: &Guides) {
    let declaration = session.executor().denoiser().declaration().clone();
    for (name, texels) in guides.declared(&declaration) {
        let id = declaration.find(name).expect(name);
        let Shape::Image { format, .. } = declaration.resource(id).shape else { panic!("{name} is an image") };
        let bytes: Vec<u8> = match format.preferred() {
            ash::vk::Format::R32_SFLOAT => texels.iter().flat_map(|t| t[0].to_ne_bytes()).collect(),
            _ => texels.iter().flatten().flat_map(|v| f16::from_f32(*v).to_bits().to_ne_bytes()).collect(),
        };
        session.upload_bytes(name, &bytes).expect(name);
    }
    let ids: Vec<u8> = guides.surface_id.iter().flat_map(|id| id.to_ne_bytes()).collect();
    session.upload_bytes("surface_id", &ids).expect("surface_id");
}

fn run(session: &mut Session, index: u32) -> Vec<[f32; 4]> {
    session.run(&scene().params(index), &Tuning::default()).expect("frame");
    session.download("denoised_radiance").expect("output")
}

fn frames_of_sets_give_the_bits_of_uploads() {
    let config = Config::new(EXTENT);
    let (mut uploaded, mut other, mut bound) = (session(&config), session(&config), session(&config));
    let sets = [0, 1].map(|index| {
        upload_preferred(&mut other, &frame(index));
        let mut set = InputSet::new(gpu());
        set.add(&other).expect("the same device");
        assert!(set.contains("depth") && !set.contains("roughness"));
        set
    });
    for index in 0..4 {
        upload(&mut uploaded, &frame(index % 2));
        bound.bind_inputs(&sets[index as usize % 2]).expect("inputs");
        assert_eq!(run(&mut uploaded, index), run(&mut bound, index), "frame {index}");
    }
    // Sets keep their images alive by themselves, and outlive sessions.
    drop((bound, other));
    let mut last = session(&config);
    last.bind_inputs(&sets[0]).expect("inputs");
    run(&mut last, 0);
    assert_valid();
}

fn uploads_leave_a_set_alone() {
    let config = Config::new(EXTENT);
    let mut one = session(&config);
    upload_preferred(&mut one, &frame(0));
    let mut set = InputSet::new(gpu());
    set.add(&one).expect("the same device");
    let expected = run(&mut one, 0);
    upload_preferred(&mut one, &frame(3));
    one.invalidate();
    assert_ne!(run(&mut one, 0), expected);
    one.bind_inputs(&set).expect("inputs");
    one.invalidate();
    assert_eq!(run(&mut one, 0), expected);
    // Floats in place of halves: another image.
    upload(&mut one, &frame(0));
    one.invalidate();
    assert_eq!(run(&mut one, 0), expected);
    assert_valid();
}

fn a_set_may_have_more_than_a_declaration_asks_for() {
    let config = Config::new(EXTENT);
    let (mut one, mut apart) = (session(&config), session(&Config { signals: Signals::Apart, ..config }));
    upload(&mut one, &frame(0));
    upload(&mut apart, &frame(0));
    let mut set = InputSet::new(gpu());
    set.add(&one).expect("the same device");
    set.add(&apart).expect("the same device");
    assert!(set.contains("noisy_radiance") && set.contains("noisy_direct"));
    let mut bound = session(&config);
    bound.bind_inputs(&set).expect("the inputs that it has");
    assert_eq!(run(&mut bound, 0), run(&mut one, 0));
    // What it does not have is not kept alive by it either.
    let mut taken = InputSet::new(gpu());
    taken.add(&bound).expect("the same device");
    assert!(taken.contains("noisy_radiance") && !taken.contains("noisy_direct"));
    assert_valid();
}

fn inputs_of_the_wrong_size_or_device_are_refused() {
    let mut one = session(&Config::new(EXTENT));
    let declaration = one.executor().denoiser().declaration();
    let inputs = declaration.resources().iter().filter(|r| matches!(r.lifetime, Lifetime::Input { .. }));
    for (name, is_image) in inputs.map(|r| (r.name.clone(), matches!(r.shape, Shape::Image { .. }))).collect::<Vec<_>>() {
        let error = one.upload_bytes(&name, &[0; 12]).expect_err(&name);
        assert!(if is_image { matches!(error, Error::Size { .. }) } else { matches!(error, Error::WrongKind { .. }) }, "{error}");
    }
    let error = one.upload_bytes("depht", &[0; 12]).expect_err("no such input");
    assert!(matches!(error, Error::UnknownResource { .. }), "{error}");
    let other = Arc::new(HeadlessDevice::new(&HeadlessOptions::default()).expect("device"));
    let set = InputSet::new(other.clone());
    let error = one.bind_inputs(&set).expect_err("another device");
    assert!(error.to_string().contains("open both with the same HeadlessDevice"), "{error}");
    // Images of another size are refused as those of a host are.
    let mut small = session_with(&Config::new([9, 7]), SessionOptions::default());
    small.upload_bytes("depth", &[0; 9 * 7 * 4]).expect("depth");
    let mut set = InputSet::new(gpu());
    set.add(&small).expect("the same device");
    let error = one.bind_inputs(&set).expect_err("too small");
    assert!(matches!(error, Error::Size { .. }), "{error}");
}
