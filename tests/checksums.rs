//! The bits of every output, held against a table: a change of structure must not change a picture.
//!
//! A table is of one version of llvmpipe, which gives the same bits for every number of threads; another driver, and another version of it,
//! rounds in its own way. Where no table is of the driver, the test says that it compares nothing. `ATROUS_UPDATE_CHECKSUMS=1` writes the
//! driver's table anew, for a commit that says why.

use super::support::{assert_valid, gpu, scene::Guides, scene::Scene, session, svgf, upload};
use ash::vk;
use atrous::config::{AdaptiveRule, EawWeights, GradientSource, PostProcess, Preset, Sampling, Signals};
use atrous::executor::Session;
use atrous::{Config, Counter, DebugView, FrameParams, Lifetime, ResetReason, Shape, Tuning, UseFrame};
use atrous_harness::DeviceTest;
use std::fmt::Write as _;

pub const TESTS: &[DeviceTest] = &[("every_preset", every_preset)];

/// The driver that a table is of, up to the number of its version, with the file and its text.
const TABLES: [(&str, &str, &str); 2] = [
    ("llvmpipe, Mesa 22.", "llvmpipe.txt", include_str!("checksums/llvmpipe.txt")),
    ("llvmpipe, Mesa 25.", "llvmpipe_25.txt", include_str!("checksums/llvmpipe_25.txt")),
];
const FRAMES: u32 = 6;
/// Bytes of the counters that the table began with.
const FIRST_COUNTERS: usize = 32;

fn configurations() -> Vec<(&'static str, Config)> {
    let base = Config { post_process: PostProcess::ToneMapTaa, ..svgf([61, 35]) };
    let apart = Config { signals: Signals::Apart, ..base };
    let asvgf = Config { preset: Preset::Asvgf, ..base };
    let percentile = Config { preset: Preset::Percentile, ..base };
    let best = Config { preset: Preset::Best, ..base };
    let fast = Config { preset: Preset::Fast, ..base };
    let eaw = Config { preset: Preset::Eaw, ..base };
    let stabilize = Config { preset: Preset::Stabilize, ..base };
    vec![
        ("svgf", base),
        ("svgf apart", apart),
        ("svgf object normals, no ids", Config { object_normal: true, surface_id: false, ..apart }),
        ("svgf fireflies", Config { firefly_filter: true, ..base }),
        ("svgf one level, tone map", Config { levels: Some(1), post_process: PostProcess::ToneMap, ..base }),
        ("svgf ten levels", Config { levels: Some(10), post_process: PostProcess::None, ..base }),
        ("svgf debug views", Config { debug_view: true, ..apart }),
        ("asvgf", Config { debug_view: true, ..asvgf }),
        ("asvgf apart", Config { signals: Signals::Apart, firefly_filter: true, ..asvgf }),
        (
            "asvgf 2x2, forward motion, object normals",
            Config { stratum_size: 2, forward_motion: true, object_normal: true, ..asvgf },
        ),
        ("asvgf 4x4, no ids", Config { stratum_size: 4, surface_id: false, ..asvgf }),
        ("asvgf reshaded", Config { gradient_source: GradientSource::Reshaded, signals: Signals::Apart, ..asvgf }),
        ("asvgf sparse", Config { gradient_source: GradientSource::Sparse, ..asvgf }),
        ("asvgf confidence", Config { gradient_source: GradientSource::Confidence, ..asvgf }),
        ("percentile", Config { debug_view: true, ..percentile }),
        ("percentile apart, object normals", Config { signals: Signals::Apart, object_normal: true, ..percentile }),
        ("percentile published", Config { adaptive_rule: AdaptiveRule::Percentiles, ..percentile }),
        ("percentile published apart", Config { adaptive_rule: AdaptiveRule::Percentiles, signals: Signals::Apart, ..percentile }),
        ("best", Config { debug_view: true, ..best }),
        ("svgf specular", Config { signals: Signals::Specular, ..base }),
        ("best specular", Config { signals: Signals::Specular, ..best }),
        ("best reshaded, apart", Config { gradient_source: GradientSource::Reshaded, signals: Signals::Apart, ..best }),
        ("best compared", Config { gradient_source: GradientSource::ChangeTest, ..best }),
        ("best compared, specular", Config { gradient_source: GradientSource::ChangeTest, signals: Signals::Specular, ..best }),
        ("fast", fast),
        ("fast apart, fireflies", Config { signals: Signals::Apart, firefly_filter: true, ..fast }),
        ("eaw", eaw),
        ("eaw apart, two weights", Config { signals: Signals::Apart, eaw_weights: EawWeights::first(2), ..eaw }),
        ("eaw 2x2", Config { sampling: Sampling::OneOf2x2, ..eaw }),
        ("eaw 4x4, fireflies", Config { sampling: Sampling::OneOf4x4, firefly_filter: true, ..eaw }),
        ("svgf 2x2, apart", Config { sampling: Sampling::OneOf2x2, ..apart }),
        ("best 4x4", Config { sampling: Sampling::OneOf4x4, ..best }),
        ("best 2x2, specular", Config { sampling: Sampling::OneOf2x2, signals: Signals::Specular, ..best }),
        ("stabilize", Config { debug_view: true, firefly_filter: true, ..stabilize }),
        ("stabilize reshaded", Config { gradient_source: GradientSource::Reshaded, ..stabilize }),
        ("volume", Config { preset: Preset::Volume, debug_view: true, ..base }),
        ("volume beside svgf", Config { volume: true, firefly_filter: true, ..base }),
        ("volume beside asvgf", Config { volume: true, ..asvgf }),
        ("visibility beside svgf", Config { visibility: 1, ..base }),
        ("visibility beside best", Config { visibility: 1, ..best }),
    ]
}

fn every_preset() {
    let driver = driver();
    let mut table = format!("{driver}\n");
    for (name, config) in configurations() {
        writeln!(table, "{:016x} {name}", checksum(&config)).expect("a string takes everything");
    }
    assert_valid();
    let Some((_, file, expected)) = TABLES.iter().find(|(of, ..)| driver.starts_with(of)) else {
        return println!("no checksums are of {driver}: nothing was compared");
    };
    let path = format!("{}/tests/checksums/{file}", env!("CARGO_MANIFEST_DIR"));
    if std::env::var_os("ATROUS_UPDATE_CHECKSUMS").is_some() {
        std::fs::write(&path, &table).expect(&path);
    } else if !expected.starts_with(&table[..=driver.len()]) {
        println!("{file} is of {}, and this is {driver}: nothing was compared", expected.lines().next().unwrap_or_default());
    } else {
        assert_eq!(table, *expected, "checksums of every output, as they are and as {path} has them");
    }
}

/// Name and version of the driver, and of the compiler in it.
fn driver() -> String {
    let gpu = gpu();
    let host = gpu.host();
    let mut driver = vk::PhysicalDeviceDriverProperties::default();
    let mut properties = vk::PhysicalDeviceProperties2::default().push_next(&mut driver);
    // SAFETY: instance and physical device are live; the tests run on Vulkan 1.3, which has both structs.
    unsafe { host.instance.get_physical_device_properties2(host.physical_device, &mut properties) };
    let text = |name: Result<&std::ffi::CStr, _>| name.map_or_else(|_| String::new(), |name| name.to_string_lossy().into_owned());
    format!("{}, {}", text(driver.driver_name_as_c_str()), text(driver.driver_info_as_c_str()))
}

/// Of every output of every frame, in the order of their names.
fn checksum(config: &Config) -> u64 {
    let scene = Scene { speed: 0.12, ..Scene::new(config.allocated_extent) };
    let mut s = session(config);
    let declaration = s.executor().denoiser().declaration().clone();
    let mut outputs: Vec<_> =
        declaration.resources().iter().filter(|r| r.lifetime == Lifetime::Output).map(|r| r.name.to_string()).collect();
    outputs.sort();
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    let mut before: Option<Guides> = None;
    for i in 0..FRAMES {
        let light = if i >= 4 { 0.3 } else { 1.0 };
        let mut guides = Scene { light, ..scene }.frame(i, i);
        add_outliers(&mut guides);
        upload(&mut s, &guides);
        upload_extras(&mut s, &guides, before.as_ref());
        let reset = (i == 3).then_some(ResetReason::CameraCut);
        let params = FrameParams {
            jitter: [0.3 - 0.1 * i as f32, 0.05 * i as f32],
            exposure_ratio: if i == 2 { 1.5 } else { 1.0 },
            reset,
            reshaded: true,
            debug_view: config.debug_view.then(|| DebugView::ALL[i as usize * 2]),
            ..scene.params(i)
        };
        s.run(&params, &Tuning::for_preset(config.preset)).expect("frame");
        for name in &outputs {
            let mut bytes = s.download_bytes(name, UseFrame::Current).expect(name);
            if name == "statistics" {
                // What tells of surfaces without history changes no picture, nor does a counter that came later and has nothing to count.
                bytes.truncate(4 * Counter::HistoryKept as usize);
                while bytes.len() > FIRST_COUNTERS && bytes.ends_with(&[0; 4]) {
                    bytes.truncate(bytes.len() - 4);
                }
            }
            hash = bytes.iter().fold(hash, |h, byte| (h ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3));
        }
        before = Some(guides);
    }
    hash
}

/// Fireflies, and a few values that are not finite.
fn add_outliers(guides: &mut Guides) {
    for images in [&mut guides.noisy_radiance, &mut guides.noisy_direct, &mut guides.noisy_indirect, &mut guides.noisy_volume] {
        images.iter_mut().step_by(97).for_each(|t| *t = t.map(|c| 40.0 * c));
        images.iter_mut().skip(11).step_by(501).for_each(|t| t[0] = f32::NAN);
    }
}

/// Inputs that the scene does not have, made of those that it has.
fn upload_extras(s: &mut Session, guides: &Guides, before: Option<&Guides>) {
    let declaration = s.executor().denoiser().declaration().clone();
    let earlier = before.unwrap_or(guides);
    let pixels = guides.depth.len();
    let reshaded: Vec<_> = earlier.noisy_radiance.iter().map(|t| t.map(|c| 0.8 * c)).collect();
    // An object that turned under some of the pixels: its history is refused there.
    let turned = |i: usize| {
        if (i / 8 + guides.noisy_radiance[0][1].to_bits() as usize).is_multiple_of(5) {
            [1.0, 0.0, 0.0, 0.0]
        } else {
            [0.0, 0.0, 1.0, 0.0]
        }
    };
    let made: [(&str, Vec<[f32; 4]>); 7] = [
        ("object_normal", (0..pixels).map(turned).collect()),
        ("emission", vec![[0.25, 0.5, 0.125, 0.0]; pixels]),
        ("other_denoised_radiance", guides.noisy_radiance.clone()),
        ("reshaded_radiance", reshaded),
        ("confidence", (0..pixels).map(|i| [(i % 7) as f32 / 6.0; 4]).collect()),
        ("forward_motion", vec![[0.01, 0.0, 0.0, 0.0]; pixels]),
        ("roughness", vec![[0.5; 4]; pixels]),
    ];
    for (name, texels) in made {
        if declaration.find(name).is_some() {
            s.upload(name, &texels).expect(name);
        }
    }
    if let Some(id) = declaration.find("sparse_gradient") {
        let Shape::Image { .. } = declaration.resource(id).shape else { panic!("an image") };
        let [w, h] = declaration.resource(id).extent(declaration.setup()).expect("an image");
        let texels: Vec<_> = (0..w * h).map(|i| [0.1 * (i % 5) as f32, 0.5, 0.0, 0.0]).collect();
        s.upload("sparse_gradient", &texels).expect("sparse_gradient");
    }
}
