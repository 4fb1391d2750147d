//! What a host binds to an executor: refused by name where it does not fit, and then nothing changes.

use super::support::{gpu, rig::UPLOADED};
use ash::vk;
use atrous::config::Preset;
use atrous::executor::{Executor, ExecutorOptions, HostImage};
use atrous::{Config, Declaration, Error, FrameParams, Lifetime, ResourceDecl, Shape, Subresource, Tuning};
use atrous_harness::DeviceTest;

pub const TESTS: &[DeviceTest] = &[
    ("an_image_is_bound_to_images_of_the_host_alone", an_image_is_bound_to_images_of_the_host_alone),
    ("a_buffer_is_bound_to_buffers_of_the_host_alone", a_buffer_is_bound_to_buffers_of_the_host_alone),
];

const EXTENT: [u32; 2] = [19, 17];

fn executor() -> Executor {
    let config = Config { preset: Preset::Asvgf, ..Config::new(EXTENT) };
    // SAFETY: the device is live, has synchronization2 and outlives the executor; nothing is ever submitted.
    unsafe { Executor::new(gpu().host(), config.declare().expect("valid"), ExecutorOptions::default()) }.expect("an executor")
}

/// Never used: nothing is recorded.
fn image(format: vk::Format, extent: [u32; 2]) -> HostImage {
    let (stage, access, layout) = UPLOADED;
    let subresource = Subresource::default();
    HostImage { image: vk::Image::null(), view: vk::ImageView::null(), subresource, format, extent, layout, stage, access }
}

fn bind_buffer(executor: &mut Executor, name: &str, size: u64) -> Result<(), Error> {
    let (stage, access, _) = UPLOADED;
    executor.bind_buffer(name, vk::Buffer::null(), size, stage, access)
}

/// The name of a resource, which there has to be.
fn named(declaration: &Declaration, is: impl Fn(&&ResourceDecl) -> bool) -> String {
    declaration.resources().iter().find(is).expect("such a resource").name.clone()
}

fn is_image(resource: &ResourceDecl) -> bool {
    matches!(resource.shape, Shape::Image { .. })
}

fn is_of_host(resource: &ResourceDecl) -> bool {
    matches!(resource.lifetime, Lifetime::Input { .. } | Lifetime::Output)
}

fn an_image_is_bound_to_images_of_the_host_alone() {
    let mut executor = executor();
    let declaration = executor.denoiser().declaration().clone();
    let buffer = named(&declaration, |r| !is_image(r) && is_of_host(r));
    let own = named(&declaration, |r| is_image(r) && !is_of_host(r));
    for name in [&buffer, &own] {
        let bound = executor.bind_image(name, image(vk::Format::R16G16B16A16_SFLOAT, EXTENT));
        assert!(matches!(bound, Err(Error::WrongKind { resource, .. }) if resource == *name));
    }
    let error = executor.bind_image("dept", image(vk::Format::R32_SFLOAT, EXTENT)).expect_err("unknown").to_string();
    assert!(error.contains("dept") && error.contains("noisy_radiance"), "{error}");
    let error = executor.bind_image("depth", image(vk::Format::R32_UINT, EXTENT)).expect_err("a format").to_string();
    assert!(error.contains("depth") && error.contains("R32_UINT"), "{error}");
    for extent in [[18, 17], [19, 16]] {
        let error = executor.bind_image("depth", image(vk::Format::R32_SFLOAT, extent)).expect_err("a size").to_string();
        assert!(error.contains(&format!("{}x{} pixels", extent[0], extent[1])) && error.contains("19x17 pixels"), "{error}");
    }
    let begun = executor.begin_frame(&FrameParams::new(EXTENT), &Tuning::default());
    assert_eq!(begun.expect_err("nothing was bound"), Error::NotBound("depth".into()));
    executor.bind_image("depth", image(vk::Format::R32_SFLOAT, [20, 17])).expect("a larger one fits");
}

fn a_buffer_is_bound_to_buffers_of_the_host_alone() {
    let mut executor = executor();
    let declaration = executor.denoiser().declaration().clone();
    let own = named(&declaration, |r| !is_image(r) && !is_of_host(r));
    for name in ["depth", &own] {
        let bound = bind_buffer(&mut executor, name, 1 << 20);
        assert!(matches!(bound, Err(Error::WrongKind { resource, .. }) if resource == name));
    }
    let theirs = declaration.resources().iter().find(|r| !is_image(r) && is_of_host(r)).expect("a buffer");
    let Shape::Buffer { size } = theirs.shape else { panic!("{} is a buffer", theirs.name) };
    let error = bind_buffer(&mut executor, &theirs.name, size - 1).expect_err("too small").to_string();
    assert!(error.contains(&theirs.name) && error.contains(&format!("at least {size} bytes")), "{error}");
    bind_buffer(&mut executor, &theirs.name, size).expect("it fits");
}
