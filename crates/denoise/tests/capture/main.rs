//! Frames are captured from a session on a Vulkan device, read back by the tool, and filtered again.

mod failures;
mod host_images;
mod replay;
mod support;

use atrous_harness::Group;

fn main() {
    let tests = |tests| Group { name: "", tests, needs_device: true };
    atrous_harness::run(&[tests(replay::TESTS), tests(host_images::TESTS), tests(failures::TESTS)], &support::try_gpu());
}
