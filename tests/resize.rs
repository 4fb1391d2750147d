//! Another allocated extent: the bits of a new denoiser, with the pipelines of the old one; nothing changes where it is refused.

use super::graphs::{inputs::Inputs, random};
use super::support::rig::UPLOADED;
use super::support::spy::{Spy, REFUSED};
use super::support::{self, assert_valid, gpu, scene::Scene, session};
use ash::vk;
use atrous::config::{PostProcess, Preset};
use atrous::executor::{Executor, ExecutorOptions, HostImage, Session, SessionOptions};
use atrous::{
    Config, Declaration, Denoiser, Device, Error, FrameContext, FrameParams, Lifetime, ResetReason, Shape, Subresource, Tuning,
    UseFrame,
};
use atrous_harness::DeviceTest;
use std::ffi::c_void;

pub const TESTS: &[DeviceTest] = &[
    ("a_resized_session_gives_the_bits_of_a_new_one", a_resized_session_gives_the_bits_of_a_new_one),
    ("so_does_any_graph", so_does_any_graph),
    ("pipelines_are_kept", pipelines_are_kept),
    ("an_extent_that_is_refused_changes_nothing", an_extent_that_is_refused_changes_nothing),
    ("an_extent_beyond_the_device_changes_nothing", an_extent_beyond_the_device_changes_nothing),
    ("memory_that_runs_out_changes_nothing", memory_that_runs_out_changes_nothing),
    ("images_have_to_be_given_again_and_buffers_stay", images_have_to_be_given_again_and_buffers_stay),
    ("images_of_a_host_have_to_be_bound_again", images_of_a_host_have_to_be_bound_again),
];

const EXTENT: [u32; 2] = [33, 21];
const LARGER: [u32; 2] = [48, 40];
const SMALLER: [u32; 2] = [17, 9];

/// Everything that outlives a frame, of both copies.
fn content(s: &mut Session) -> Vec<(String, Vec<u8>)> {
    let resources = s.executor().denoiser().declaration().resources().to_vec();
    let kept = resources.iter().filter(|r| r.lifetime == Lifetime::Output || r.lifetime.is_history());
    let both = [UseFrame::Current, UseFrame::Previous];
    let copies = kept.flat_map(|r| both.into_iter().take(r.lifetime.copies()).map(|frame| (r.name.clone(), frame)));
    copies.map(|(name, frame)| (format!("{name}, {frame:?}"), s.download_bytes(&name, frame).expect(&name))).collect()
}

/// Runs the frames of both, the first of which resets by `reason`.
fn assert_same(resized: &mut Session, new: &mut Session, what: &str, mut frame: impl FnMut(&mut Session, u32) -> FrameContext) {
    for index in 0..3 {
        let contexts = [&mut *resized, &mut *new].map(|s| frame(s, index));
        assert_eq!(contexts.map(|c| c.index), [u64::from(index); 2], "{what}");
        let expected = [ResetReason::Resize, ResetReason::Created].map(|reason| (index == 0).then_some(reason));
        assert_eq!(contexts.map(|c| c.reset), expected, "{what}");
        for ((name, a), (_, b)) in content(resized).into_iter().zip(content(new)) {
            assert!(a == b, "{what}, frame {index}: {name} is not that of a new session");
        }
    }
}

fn run(s: &mut Session, extent: [u32; 2], index: u32) -> FrameContext {
    let scene = Scene { speed: 0.1, ..Scene::new(extent) };
    support::upload(s, &scene.frame(index, index));
    let params = FrameParams { reshaded: true, frame_slot: index % 2, ..scene.params(index) };
    s.run(&params, &Tuning::default()).expect("a frame")
}

fn a_resized_session_gives_the_bits_of_a_new_one() {
    for preset in [Preset::Svgf, Preset::Asvgf, Preset::Percentile, Preset::Eaw, Preset::Best] {
        let config = |extent| Config { preset, volume: true, post_process: PostProcess::ToneMapTaa, ..Config::new(extent) };
        let mut resized = session(&config(EXTENT));
        // An odd number, so that the copies of a history are exchanged.
        for index in 0..3 {
            run(&mut resized, EXTENT, index);
        }
        for extent in [LARGER, SMALLER, SMALLER] {
            resized.resize(extent).expect("another extent");
            assert_eq!(resized.executor().denoiser().declaration().allocated_extent(), extent);
            let mut new = session(&config(extent));
            assert_eq!(resized.executor().allocated(), new.executor().allocated());
            let what = format!("{preset:?}, {extent:?}");
            assert_same(&mut resized, &mut new, &what, |s, index| run(s, extent, index));
        }
    }
    assert_valid();
}

fn so_does_any_graph() {
    let options = SessionOptions { poison: true, ..Default::default() };
    let open = |declaration: &Declaration| Session::new(gpu(), declaration.clone(), options).expect("a session");
    for seed in [1, 6] {
        let mut resized = open(&random::declare(seed, EXTENT));
        let frame = |s: &mut Session, extent: [u32; 2], index: u32| {
            let scene = Scene { speed: 0.12, ..Scene::new(extent) };
            let declaration = s.executor().denoiser().declaration().clone();
            Inputs::new(&declaration, seed, &scene, index).give_session(s).expect("inputs");
            s.run(&scene.params(index), &Tuning::default()).expect("a frame")
        };
        for index in 0..3 {
            frame(&mut resized, EXTENT, index);
        }
        for extent in [LARGER, SMALLER] {
            resized.resize(extent).expect("another extent");
            let mut new = open(&random::declare(seed, extent));
            assert_same(&mut resized, &mut new, &format!("seed {seed}, {extent:?}"), |s, index| frame(s, extent, index));
        }
    }
    assert_valid();
}

fn executor(spy: &Spy) -> Executor {
    // SAFETY: the handles are live, the device has synchronization2, and no work is ever submitted.
    unsafe { Executor::new(spy.host(vk::PipelineCache::null()), Config::new(EXTENT).declare().expect("valid"), Default::default()) }
        .expect("an executor")
}

fn pipelines_are_kept() {
    let spy = Spy::new();
    let mut executor = executor(&spy);
    let (before, live) = (spy.created(), spy.live());
    for extent in [LARGER, SMALLER, EXTENT] {
        // SAFETY: no GPU work was recorded.
        unsafe { executor.resize(extent) }.expect("another extent");
        let after = spy.created();
        assert!(after["image"] > before["image"], "images are allocated anew");
        for kind in ["pipeline", "shader module", "set layout", "pipeline layout", "descriptor pool"] {
            assert_eq!(after[kind], before[kind], "{kind}");
        }
        assert_eq!(spy.live(), live, "the old ones are destroyed");
    }
    drop(executor);
    assert!(spy.live().is_empty(), "{:?}", spy.live());
    assert_valid();
}

fn an_extent_that_is_refused_changes_nothing() {
    let mut s = session(&Config::new(EXTENT));
    run(&mut s, EXTENT, 0);
    for extent in [[0, 8], [8, 0], [100_000, 8]] {
        let error = s.resize(extent).expect_err("refused");
        assert_eq!(Err(error), Config::new(extent).declare().map(drop));
    }
    let frame = run(&mut s, EXTENT, 1);
    assert_eq!((frame.index, frame.reset), (1, None), "the history goes on");
    assert_eq!(s.executor().denoiser().declaration().allocated_extent(), EXTENT);
}

/// Largest side of an image that [`small_properties`] admits to.
const SMALL: u32 = 40;

unsafe extern "system" fn small_properties(device: vk::PhysicalDevice, properties: *mut vk::PhysicalDeviceProperties) {
    // SAFETY: the device is one of the instance, and there is room for its properties.
    unsafe {
        *properties = gpu().host().instance.get_physical_device_properties(device);
        (*properties).limits.max_image_dimension2_d = SMALL;
    }
}

fn an_extent_beyond_the_device_changes_nothing() {
    let gpu = gpu();
    let host = gpu.host();
    // SAFETY: the functions are those of the instance, but for one, which has its signature; the handles outlive the denoiser.
    let mut denoiser = unsafe {
        let entry = ash::Entry::load().expect("a loader");
        let load = |name: &std::ffi::CStr| match name.to_bytes() {
            b"vkGetPhysicalDeviceProperties" => small_properties as *const c_void,
            _ => std::mem::transmute::<vk::PFN_vkVoidFunction, *const c_void>(
                entry.get_instance_proc_addr(host.instance.handle(), name.as_ptr()),
            ),
        };
        let instance = ash::Instance::load_with(load, host.instance.handle());
        Denoiser::new(Device { instance: &instance, ..host }, Config::new(EXTENT).declare().expect("valid")).expect("a denoiser")
    };
    let begin = |denoiser: &mut Denoiser| denoiser.begin_frame(&FrameParams::new(SMALLER), &Tuning::default()).expect("frame");
    assert_eq!(begin(&mut denoiser).reset, Some(ResetReason::Created));
    let Error::Unsupported { missing } = denoiser.resize([SMALL + 1, 8]).expect_err("refused") else { panic!("another error") };
    assert_eq!(missing, [format!("maxImageDimension2D of {} (it has {SMALL})", SMALL + 1)]);
    // Nothing was recorded, so that there is no history to keep: a reset for the resize would say so.
    assert_eq!((begin(&mut denoiser).reset, denoiser.declaration().allocated_extent()), (Some(ResetReason::Created), EXTENT));
    denoiser.resize([SMALL, 8]).expect("large enough");
    assert_eq!(denoiser.declaration().allocated_extent(), [SMALL, 8]);
}

fn memory_that_runs_out_changes_nothing() {
    let spy = Spy::new();
    let mut executor = executor(&spy);
    let (live, images) = (spy.live(), spy.created()["image"]);
    let allocated = executor.allocated();
    for after in [0, images / 2, images - 1] {
        spy.refuse("image", after);
        // SAFETY: no GPU work was recorded.
        let error = unsafe { executor.resize(LARGER) }.expect_err("refused");
        assert_eq!(error, Error::Vulkan { call: "vkCreateImage", result: REFUSED });
        assert!(spy.has_refused());
        assert_eq!((spy.live(), executor.allocated()), (live.clone(), allocated));
        assert_eq!(executor.denoiser().declaration().allocated_extent(), EXTENT);
    }
    // SAFETY: no GPU work was recorded.
    unsafe { executor.resize(LARGER) }.expect("another extent");
    assert_ne!(executor.allocated(), allocated);
    assert_valid();
}

fn images_have_to_be_given_again_and_buffers_stay() {
    // The ball moves to the side: without the transforms its history is lost.
    let moved = [[1.0f32, 0.0, 0.0, 0.4], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
    let transforms = [moved; 3];
    let config = Config::new(EXTENT);
    let frames = |s: &mut Session| {
        (0..3).for_each(|index| {
            support::upload(s, &Scene::new(LARGER).frame(0, index));
            s.unbind("motion").expect("motion");
            s.run(&Scene::new(LARGER).params(0), &Tuning::default()).expect("a frame");
        });
        content(s)
    };
    let mut s = session(&config);
    s.upload_buffer("instance_transforms", bytemuck::cast_slice(&transforms)).expect("transforms");
    run(&mut s, EXTENT, 0);
    s.resize(LARGER).expect("another extent");
    let error = s.download("denoised_radiance").expect_err("no frame yet");
    assert_eq!(error, Error::NoFrame("denoised_radiance".into()));
    let error = s.upload("depth", &[[1.0; 4]; 33 * 21]).expect_err("the old extent").to_string();
    assert!(error.contains("1920 texels (48x40)"), "{error}");
    let missing = |s: &mut Session| s.run(&FrameParams::new(LARGER), &Tuning::default()).expect_err("not given");
    assert_eq!(missing(&mut s), Error::NotBound("depth".into()));
    support::upload(&mut s, &Scene::new(LARGER).frame(0, 0));
    s.run(&FrameParams::new(LARGER), &Tuning::default()).expect("everything was given again");
    s.resize(LARGER).expect("the same extent");
    // An optional one is missed as well, until the host says that it has none.
    for name in ["depth", "normal", "motion", "noisy_radiance"] {
        s.upload(name, &vec![[1.0; 4]; 48 * 40]).expect(name);
    }
    s.upload_ids("surface_id", &vec![1; 48 * 40]).expect("surface_id");
    assert_eq!(missing(&mut s), Error::NotBound("albedo".into()));
    s.unbind("albedo").expect("albedo");
    s.run(&FrameParams::new(LARGER), &Tuning::default()).expect("albedo is left out");
    s.resize(LARGER).expect("the same extent");
    let kept = frames(&mut s);
    let mut new = session(&Config::new(LARGER));
    assert!(kept != frames(&mut new), "the transforms make a difference");
    let mut new = session(&Config::new(LARGER));
    new.upload_buffer("instance_transforms", bytemuck::cast_slice(&transforms)).expect("transforms");
    assert!(kept == frames(&mut new), "the transforms stay");
    assert_valid();
}

fn images_of_a_host_have_to_be_bound_again() {
    let gpu = gpu();
    let config = Config::new(EXTENT);
    // SAFETY: the device is live, has synchronization2 and outlives the executor; nothing is ever submitted.
    let mut executor =
        unsafe { Executor::new(gpu.host(), config.declare().expect("valid"), ExecutorOptions::default()) }.expect("one");
    let (stage, access, layout) = UPLOADED;
    // Never used: nothing is recorded.
    let (image, view) = (vk::Image::null(), vk::ImageView::null());
    let bind_one = |executor: &mut Executor, name: &str, extent: [u32; 2]| {
        let declaration = executor.denoiser().declaration();
        let shape = declaration.resource(declaration.find(name).expect(name)).shape;
        let Shape::Image { format, .. } = shape else { panic!("{name} is an image") };
        executor.bind_image(
            name,
            HostImage {
                image,
                view,
                subresource: Subresource::default(),
                format: format.preferred(),
                extent,
                layout,
                stage,
                access,
            },
        )
    };
    let bind_inputs = |executor: &mut Executor, extent: [u32; 2]| {
        ["depth", "normal", "surface_id", "noisy_radiance"].iter().try_for_each(|name| bind_one(executor, name, extent))
    };
    let bind = |executor: &mut Executor, extent: [u32; 2]| {
        bind_inputs(executor, extent).and_then(|()| bind_one(executor, "denoised_radiance", extent))
    };
    let begin = |executor: &mut Executor| executor.begin_frame(&FrameParams::new(SMALLER), &Tuning::default());
    bind(&mut executor, EXTENT).expect("bound");
    assert_eq!(begin(&mut executor).expect("a frame").reset, Some(ResetReason::Created));
    // SAFETY: no GPU work was recorded.
    unsafe { executor.resize(LARGER) }.expect("another extent");
    assert_eq!(begin(&mut executor).expect_err("nothing is bound"), Error::NotBound("depth".into()));
    let error = bind(&mut executor, EXTENT).expect_err("the old images are too small").to_string();
    assert!(error.contains("33x21 pixels") && error.contains("48x40 pixels"), "{error}");
    bind(&mut executor, LARGER).expect("bound");
    assert_eq!(begin(&mut executor).expect("a frame").reset, Some(ResetReason::Resize));
    // SAFETY: no GPU work was recorded.
    unsafe { executor.resize(SMALLER) }.expect("another extent");
    bind(&mut executor, LARGER).expect("larger ones may be bound again");
    assert_eq!(begin(&mut executor).expect("a frame").reset, Some(ResetReason::Resize));
    // SAFETY: no GPU work was recorded.
    unsafe { executor.resize(EXTENT) }.expect("another extent");
    bind(&mut executor, LARGER).expect("bound");
    // SAFETY: no GPU work was recorded.
    unsafe { executor.resize(EXTENT) }.expect("the same extent");
    // Twice in a row, the output is still missed, and not written where the host does not look.
    // SAFETY: no GPU work was recorded.
    unsafe { executor.resize(EXTENT) }.expect("the same extent");
    bind_inputs(&mut executor, EXTENT).expect("bound");
    assert_eq!(begin(&mut executor).expect_err("the output"), Error::NotBound("denoised_radiance".into()));
    executor.unbind("denoised_radiance").expect("an output of the executor's own");
    begin(&mut executor).expect("a frame");
}
