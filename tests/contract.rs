//! What a host plans with: memory, boundaries, unknown names.

use super::graphs::random;
use super::support::svgf;
use atrous::config::{PostProcess, Preset, Signals};
use atrous::{Access, Config, Lifetime, Phase};
use atrous_harness::DeviceTest;

pub const TESTS: &[DeviceTest] = &[
    ("a_pixel_takes_no_more_bytes_than_promised", a_pixel_takes_no_more_bytes_than_promised),
    ("memory_is_the_sum_of_its_parts", memory_is_the_sum_of_its_parts),
    ("the_boundary_of_a_phase_names_first_and_last_access", the_boundary_of_a_phase_names_first_and_last_access),
    ("phases_come_in_order", phases_come_in_order),
    ("another_extent_gives_what_would_have_been_declared", another_extent_gives_what_would_have_been_declared),
];

fn a_pixel_takes_no_more_bytes_than_promised() {
    let together = svgf([1920, 1080]);
    let apart = Config { signals: Signals::Apart, ..together };
    let promised = [
        (together, 48.0),
        (Config { preset: Preset::Fast, ..together }, 48.0),
        (Config { preset: Preset::Percentile, ..together }, 48.5),
        (Config { preset: Preset::Asvgf, ..together }, 52.0),
        (Config { preset: Preset::Best, ..together }, 55.7),
        (Config { preset: Preset::Best, signals: Signals::Specular, ..together }, 90.8),
        (apart, 76.0),
    ];
    for (config, promised) in promised {
        let memory = config.declare().expect("valid").memory();
        let per_pixel = (memory.history + memory.transient) as f64 / (1920.0 * 1080.0);
        println!("{} {}: {per_pixel:.2} bytes a pixel", config.preset, config.signals);
        // The constants of the frame are no pixels.
        assert!(per_pixel <= promised + 0.01, "{config:?}: {per_pixel}");
    }
}

fn memory_is_the_sum_of_its_parts() {
    for signals in Signals::ALL {
        let config = Config { signals, post_process: PostProcess::ToneMapTaa, ..Config::new([320, 180]) };
        let memory = config.declare().expect("valid").memory();
        let sum =
            |want: fn(Lifetime) -> bool| -> u64 { memory.resources.iter().filter(|r| want(r.lifetime)).map(|r| r.bytes).sum() };
        assert_eq!(sum(Lifetime::is_history), memory.history);
        assert_eq!(sum(|l| l == Lifetime::Transient), memory.transient_unaliased);
        assert!(memory.transient < memory.transient_unaliased, "nothing is aliased");
    }
}

fn the_boundary_of_a_phase_names_first_and_last_access() {
    let declaration = Config::new([66, 36]).declare().expect("valid");
    let boundary = declaration.boundary(Phase::AfterLighting);
    let of = |name: &str| boundary.iter().find(|b| declaration.resource(b.resource).name == name).expect("touched");
    let output = of("denoised_radiance");
    assert_eq!((output.first, output.last, output.written), (Access::StorageWrite, Access::StorageWrite, true));
    assert_eq!(of("guide").first, Access::Sampled);
    assert!(!of("guide").written);
    assert!(!boundary.iter().any(|b| declaration.resource(b.resource).name == "depth"), "depth is read before lighting alone");
}

fn phases_come_in_order() {
    let config = Config { post_process: PostProcess::ToneMapTaa, ..Config::new([66, 36]) };
    let declaration = config.declare().expect("valid");
    let phases: Vec<_> = declaration.passes().iter().map(|p| p.phase).collect();
    assert!(phases.is_sorted());
    for phase in Phase::ALL {
        assert!(phases.contains(&phase), "{phase:?}");
    }
}

/// Compared as text, which has everything: shapes, lifetimes, usages, passes, shaders, constants, parameters.
fn another_extent_gives_what_would_have_been_declared() {
    let (from, to) = ([66, 36], [1920, 1081]);
    for preset in Preset::ALL {
        for signals in Signals::ALL {
            let all = |extent| Config {
                preset,
                signals,
                volume: true,
                visibility: 1,
                firefly_filter: true,
                object_normal: true,
                debug_view: true,
                forward_motion: true,
                stratum_size: 4,
                frames_in_flight: 3,
                post_process: PostProcess::ToneMapTaa,
                ..Config::new(extent)
            };
            let plain = Config { preset, signals, ..Config::new(from) };
            for config in [plain, all(from)].map(|config| Config { levels: Some(config.levels()), ..config }) {
                let declaration = config.declare().expect("valid");
                let there = Config { allocated_extent: to, ..config }.declare().expect("valid");
                let resized = declaration.with_extent(to).expect("valid");
                assert_eq!(resized.memory(), there.memory());
                assert!(format!("{resized:?}") == format!("{there:?}"), "{config:?}");
                for extent in [[0, 1], [1, 20_000]] {
                    let refused = Config { allocated_extent: extent, ..config }.declare();
                    assert_eq!(declaration.with_extent(extent).err(), Some(refused.expect_err("refused")));
                }
            }
        }
    }
    for seed in 0..6 {
        let resized = random::declare(seed, from).with_extent(to).expect("valid");
        assert!(format!("{resized:?}") == format!("{:?}", random::declare(seed, to)), "seed {seed}");
    }
}
