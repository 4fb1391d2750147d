//! Tests of the example `denoise`: its modules are compiled into this program, which needs no Vulkan device.

#[path = "../../examples/denoise/backend.rs"]
mod backend;
#[path = "../../examples/denoise/backend_reference.rs"]
mod backend_reference;
#[path = "../../examples/denoise/camera.rs"]
mod camera;
#[path = "../../examples/denoise/captured_config.rs"]
mod captured_config;
#[path = "../../examples/denoise/check.rs"]
mod check;
#[path = "../../examples/denoise/cli.rs"]
mod cli;
#[path = "../../examples/denoise/conventions.rs"]
mod conventions;
#[path = "../../examples/denoise/error.rs"]
mod error;
#[path = "../../examples/denoise/exr_header.rs"]
mod exr_header;
#[path = "../../examples/denoise/exr_read.rs"]
mod exr_read;
#[path = "../../examples/denoise/exr_write.rs"]
mod exr_write;
#[path = "../../examples/denoise/frame.rs"]
mod frame;
#[path = "../../examples/denoise/frame_files.rs"]
mod frame_files;
#[path = "../../examples/denoise/frame_images.rs"]
mod frame_images;
#[path = "../../examples/denoise/frame_source.rs"]
mod frame_source;
#[path = "../../examples/denoise/layouts.rs"]
mod layouts;
#[path = "../../examples/denoise/mapping.rs"]
mod mapping;
#[path = "../../examples/denoise/motion.rs"]
mod motion;
#[path = "../../examples/denoise/panics.rs"]
mod panics;
#[path = "../../examples/denoise/pictures.rs"]
mod pictures;
#[path = "../../examples/denoise/pipeline.rs"]
mod pipeline;
#[path = "../../examples/denoise/plan.rs"]
mod plan;
#[path = "../../examples/denoise/roles.rs"]
mod roles;
#[path = "../../examples/denoise/saver.rs"]
mod saver;
#[path = "../../examples/denoise/score.rs"]
mod score;
#[path = "../../examples/denoise/setup.rs"]
mod setup;
#[path = "../../examples/denoise/tool.rs"]
mod tool;

mod bad_files;
#[cfg(feature = "capture")]
mod capture_tests;
mod check_tests;
mod fuzz;
mod layout_tests;
mod memory;
mod name_tests;
mod reading;
mod runs;
mod samples;
mod sequence_tests;
