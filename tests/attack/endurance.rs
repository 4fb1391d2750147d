//! Threads, calls that fail, and long runs.

use crate::support::rig::Rig;
use crate::support::spy::{Spy, REFUSED};
use crate::support::{assert_valid, gpu, scene::Scene, session, soak, upload};
use ash::vk;
use atrous::config::{PostProcess, Preset};
use atrous::executor::{Executor, ExecutorOptions};
use atrous::{Config, Error, FrameParams, Phase, Tuning};

const EXTENT: [u32; 2] = [33, 21];

/// A sequence of one preset, as hashable bits.
fn sequence(preset: Preset) -> Vec<Vec<[u32; 4]>> {
    let scene = Scene { speed: 0.1, ..Scene::new(EXTENT) };
    let mut s = session(&Config { preset, ..Config::new(EXTENT) });
    let frame = |index: u32| {
        upload(&mut s, &scene.frame(index, index));
        s.run(&FrameParams { reshaded: true, ..scene.params(index) }, &Tuning::default()).expect("a frame");
        let texels = s.download("denoised_radiance").expect("an output");
        texels.into_iter().map(|texel| texel.map(f32::to_bits)).collect()
    };
    (0..soak::times(6)).map(frame).collect()
}

pub fn four_threads_on_one_device_give_the_same_bits() {
    let presets = [Preset::Svgf, Preset::Asvgf, Preset::Percentile, Preset::Fast];
    let alone = presets.map(sequence);
    let together = std::thread::scope(|scope| {
        let threads = presets.map(|preset| scope.spawn(move || sequence(preset)));
        threads.map(|thread| thread.join().expect("a thread"))
    });
    for ((preset, alone), together) in presets.into_iter().zip(alone).zip(together) {
        assert!(alone == together, "{preset} has other bits beside three other threads");
    }
    assert_valid();
}

/// Every call that creates something, refused one after the other.
pub fn a_refused_call_leaves_nothing_behind() {
    let spy = Spy::new();
    let declaration = Config { post_process: PostProcess::ToneMapTaa, ..Config::new(EXTENT) }.declare().expect("valid");
    let options = ExecutorOptions { timestamps: gpu().has_timestamps(), ..Default::default() };
    // SAFETY: the handles are live, the device has synchronization2, and nothing is recorded.
    let open = || unsafe { Executor::new(spy.host(vk::PipelineCache::null()), declaration.clone(), options) };
    drop(open().expect("an executor"));
    let created = spy.created();
    for kind in ["image", "view", "buffer", "memory", "query pool", "descriptor pool"] {
        let count = created.get(kind).copied().unwrap_or_default();
        let is_optional = kind == "query pool" && !options.timestamps;
        assert!(count > 0 || is_optional, "{kind}");
        let each = if soak::is_on() { 1 } else { 6 };
        for after in (0..count).step_by(each) {
            spy.refuse(kind, after);
            let error = open().err().unwrap_or_else(|| panic!("{kind} {after}: nothing failed"));
            let is_named = matches!(error, Error::Vulkan { result: REFUSED, .. } | Error::OutOfMemory { .. });
            assert!(is_named && spy.has_refused(), "{kind} {after}: {error}");
            assert!(spy.live().is_empty(), "{kind} {after}: {:?} are left", spy.live());
        }
    }
    drop(open().expect("an executor, after all that"));
    assert_valid();
}

/// Pages of this process that are in memory, in KiB; 0 where the system does not say.
fn resident() -> u64 {
    let text = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = text.lines().find_map(|line| line.strip_prefix("VmRSS:"));
    line.and_then(|line| line.split_whitespace().next()?.parse().ok()).unwrap_or_default()
}

/// Open files of this process; 0 where the system does not say.
fn open_files() -> usize {
    std::fs::read_dir("/proc/self/fd").map_or(0, Iterator::count)
}

pub fn a_thousand_frames_take_no_more_than_a_few() {
    let spy = Spy::new();
    let extents = [[16, 9], [24, 16], [5, 3]];
    let config = Config { preset: Preset::Fast, ..Config::new(extents[0]) };
    let options = ExecutorOptions { timestamps: gpu().has_timestamps(), ..Default::default() };
    let mut rig = Rig::on(spy.host(vk::PipelineCache::null()), gpu(), &config, 1, options);
    let (frames, each) = (soak::times(1000), 50);
    let mut flat = None;
    for index in 0..frames {
        if index % each == 0 {
            rig.resize(extents[(index / each) as usize % extents.len()]);
        }
        let extent = rig.executor.denoiser().declaration().allocated_extent();
        let params = FrameParams { frame_slot: index % 2, reshaded: true, ..FrameParams::new(extent) };
        let frame = rig.executor.begin_frame(&params, &Tuning::default()).expect("a frame");
        rig.submit(|rig, cmd| {
            for phase in Phase::ALL {
                // SAFETY: the command buffer is recording, and everything that was recorded before is complete.
                unsafe { rig.executor.record(cmd, &frame, phase) }.expect("recorded");
            }
        });
        if index % (each * extents.len() as u32) == each - 1 {
            let now = (spy.live(), rig.executor.allocated());
            println!("frame {index}: {} KiB resident, {} open files, {now:?}", resident(), open_files());
            assert_eq!(*flat.get_or_insert(now.clone()), now, "frame {index}");
        }
    }
    drop(rig);
    assert!(spy.live().is_empty(), "{:?} are left", spy.live());
    assert_valid();
}
