//! Everything that runs the passes on a Vulkan device, under the validation layer with synchronisation validation.
//!
//! One program, with the harness of `crates/harness`: a machine without a device counts these tests as ignored, and says so.

mod allocation;
mod antialiasing;
mod attack;
mod bad_input;
mod binding;
#[cfg(feature = "capture")]
mod capture;
mod checksums;
mod contract;
mod counters;
mod debug_views;
mod declarations;
mod defaults;
mod detail;
mod documents;
mod eaw;
mod faults;
mod firefly;
mod frame_life;
mod gradients;
mod graphs;
mod hazards;
mod history_loss;
mod host_header;
mod hosts;
#[cfg(feature = "hot-reload")]
mod hot_reload;
mod input_sets;
mod light;
mod links;
mod materials;
mod mirror;
mod one_call;
mod packages;
mod parity;
mod pattern;
mod percentile;
mod pipelines;
mod problems;
mod properties;
mod readback;
mod repeated_noise;
mod resize;
mod sampling;
mod schedules;
mod sequences;
mod specular;
mod stereo;
mod support;
mod surfaces;
mod sync_validation;
mod upscaling;
mod viewport;
mod visibility;
mod volume;

use atrous_harness::Group;

#[global_allocator]
static ALLOCATOR: allocation::Counting = allocation::Counting;

fn main() {
    atrous_harness::compile_shaders_quickly();
    if let Some(code) = hosts::run_as_host() {
        std::process::exit(code);
    }
    let groups = [
        Group { name: "allocation", tests: allocation::TESTS, needs_device: true },
        Group { name: "antialiasing", tests: antialiasing::TESTS, needs_device: true },
        Group { name: "attack", tests: attack::TESTS, needs_device: true },
        Group { name: "binding", tests: binding::TESTS, needs_device: true },
        Group { name: "contract", tests: contract::TESTS, needs_device: false },
        Group { name: "declarations", tests: declarations::TESTS, needs_device: false },
        Group { name: "defaults", tests: defaults::TESTS, needs_device: true },
        Group { name: "detail", tests: detail::TESTS, needs_device: true },
        Group { name: "documents", tests: documents::TESTS, needs_device: false },
        Group { name: "hazards", tests: hazards::TESTS, needs_device: true },
        Group { name: "host_header", tests: host_header::TESTS, needs_device: false },
        Group { name: "hosts", tests: hosts::TESTS, needs_device: true },
        #[cfg(feature = "hot-reload")]
        Group { name: "hot_reload", tests: hot_reload::TESTS, needs_device: true },
        Group { name: "bad_input", tests: bad_input::TESTS, needs_device: true },
        #[cfg(feature = "capture")]
        Group { name: "capture", tests: capture::TESTS, needs_device: true },
        Group { name: "checksums", tests: checksums::TESTS, needs_device: true },
        Group { name: "counters", tests: counters::TESTS, needs_device: true },
        Group { name: "debug_views", tests: debug_views::TESTS, needs_device: true },
        Group { name: "eaw", tests: eaw::TESTS, needs_device: true },
        Group { name: "faults", tests: faults::TESTS, needs_device: true },
        Group { name: "firefly", tests: firefly::TESTS, needs_device: true },
        Group { name: "input_sets", tests: input_sets::TESTS, needs_device: true },
        Group { name: "frame_life", tests: frame_life::TESTS, needs_device: true },
        Group { name: "history_loss", tests: history_loss::TESTS, needs_device: true },
        Group { name: "properties", tests: properties::TESTS, needs_device: true },
        Group { name: "gradients", tests: gradients::TESTS, needs_device: true },
        Group { name: "graphs", tests: graphs::TESTS, needs_device: true },
        Group { name: "light", tests: light::TESTS, needs_device: true },
        Group { name: "links", tests: links::TESTS, needs_device: false },
        Group { name: "materials", tests: materials::TESTS, needs_device: true },
        Group { name: "mirror", tests: mirror::TESTS, needs_device: true },
        Group { name: "one_call", tests: one_call::TESTS, needs_device: true },
        Group { name: "packages", tests: packages::TESTS, needs_device: false },
        Group { name: "parity", tests: parity::TESTS, needs_device: true },
        Group { name: "pattern", tests: pattern::TESTS, needs_device: true },
        Group { name: "percentile", tests: percentile::TESTS, needs_device: true },
        Group { name: "pipelines", tests: pipelines::TESTS, needs_device: true },
        Group { name: "problems", tests: problems::TESTS, needs_device: false },
        Group { name: "readback", tests: readback::TESTS, needs_device: true },
        Group { name: "repeated_noise", tests: repeated_noise::TESTS, needs_device: true },
        Group { name: "resize", tests: resize::TESTS, needs_device: true },
        Group { name: "sampling", tests: sampling::TESTS, needs_device: true },
        Group { name: "schedules", tests: schedules::TESTS, needs_device: true },
        Group { name: "sequences", tests: sequences::TESTS, needs_device: true },
        Group { name: "sync_validation", tests: sync_validation::TESTS, needs_device: true },
        Group { name: "stereo", tests: stereo::TESTS, needs_device: true },
        Group { name: "surfaces", tests: surfaces::TESTS, needs_device: true },
        Group { name: "specular", tests: specular::TESTS, needs_device: true },
        Group { name: "upscaling", tests: upscaling::TESTS, needs_device: true },
        Group { name: "viewport", tests: viewport::TESTS, needs_device: true },
        Group { name: "visibility", tests: visibility::TESTS, needs_device: true },
        Group { name: "volume", tests: volume::TESTS, needs_device: true },
    ];
    let open_devices = ["faults", "hosts::a_session_runs_on_each_version_of_vulkan", "sync_validation"];
    atrous_harness::run_apart(&open_devices, &groups, &support::open_devices(atrous_harness::threads()));
}
