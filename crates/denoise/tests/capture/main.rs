//! Frames are captured from a session on a Vulkan device, read back by the tool, and filtered again.

mod failures;
mod host_images;
mod replay;
mod support;

use atrous_harness::Group;

fn main() {
    atrous_harness::compile_shaders_quickly();
    let tests = |tests| Group { name: "", tests, needs_device: true };
    let groups = [tests(replay::TESTS), tests(host_images::TESTS), tests(failures::TESTS)];
    atrous_harness::run_apart(&[failures::TESTS[0].0], &groups, &support::try_gpu());
}
