//! Threads, calls that fail, and long runs.

use crate::support::rig::Rig;
use crate::support::spy::{Spy, REFUSED};
use crate::support::{assert_valid, gpu, scene::Scene, session, share_gpu, soak, upload};
use ash::vk;
use atrous::config::{PostProcess, Preset};
use atrous::executor::{Executor, ExecutorOptions, Session};
use atrous::{Config, Error, FrameParams, Tuning};

const EXTENT: [u32; 2] = [33, 21];

/// A session of one preset, and the bits of its pictures frame by frame.
struct Sequence {
    session: Session,
    scene: Scene,
    index: u32,
}

impl Sequence {
    fn new(preset: Preset) -> Self {
        let session = session(&Config { preset, ..Config::new(EXTENT) });
        Self { session, scene: Scene { speed: 0.1, ..Scene::new(EXTENT) }, index: 0 }
    }

    fn frame(&mut self) -> Vec<[u32; 4]> {
        upload(&mut self.session, &self.scene.frame(self.index, self.index));
        let params = FrameParams { reshaded: true, ..self.scene.params(self.index) };
        self.session.run(&params, &Tuning::default()).expect("a frame");
        self.index += 1;
        let texels = self.session.download("denoised_radiance").expect("an output");
        texels.into_iter().map(|texel| texel.map(f32::to_bits)).collect()
    }

    fn frames(&mut self, count: u32) -> Vec<Vec<[u32; 4]>> {
        (0..count).map(|_| self.frame()).collect()
    }
}

fn sequence(preset: Preset) -> Vec<Vec<[u32; 4]>> {
    Sequence::new(preset).frames(soak::times(6))
}

pub fn four_threads_on_one_device_give_the_same_bits() {
    let presets = [Preset::Svgf, Preset::Asvgf, Preset::Percentile, Preset::Fast];
    let alone = presets.map(sequence);
    let device = gpu();
    let together = std::thread::scope(|scope| {
        let threads = presets.map(|preset| {
            let device = device.clone();
            scope.spawn(move || {
                share_gpu(device);
                sequence(preset)
            })
        });
        threads.map(|thread| thread.join().expect("a thread"))
    });
    for ((preset, alone), together) in presets.into_iter().zip(alone).zip(together) {
        assert!(alone == together, "{preset} has other bits beside three other threads");
    }
    assert_valid();
}

/// Presets of light on surfaces. Two that may have the same bits where there are no outliers, such as `Percentile` and `Fast`, do not
/// follow each other.
const EXCHANGED: [Preset; 6] = [Preset::Svgf, Preset::Asvgf, Preset::Percentile, Preset::Best, Preset::Fast, Preset::Eaw];

/// One preset in the place of another on the same device, again and again, while a third goes on.
pub fn presets_exchanged_at_run_time_give_their_own_bits() {
    let mut alone = Sequence::new(Preset::Best).frames(2 * EXCHANGED.len() as u32).into_iter();
    let mut goes_on = Sequence::new(Preset::Best);
    let mut first = Vec::new();
    for round in 0..2 {
        for (i, preset) in EXCHANGED.into_iter().enumerate() {
            let bits = Sequence::new(preset).frames(2);
            assert!(Some(goes_on.frame()) == alone.next(), "best has other bits beside {preset}, round {round}");
            match first.get(i) {
                Some(first) => assert!(*first == bits, "{preset} has other bits when it comes back"),
                None => first.push(bits),
            }
        }
    }
    assert!(first.windows(2).all(|pair| pair[0] != pair[1]), "two presets have the same bits");
    assert_valid();
}

pub fn presets_exchanged_at_run_time_leave_nothing_behind() {
    let spy = Spy::new();
    for preset in EXCHANGED {
        let config = Config { preset, ..Config::new(EXTENT) };
        let mut rig = Rig::on(spy.host(vk::PipelineCache::null()), gpu(), &config, 1, ExecutorOptions::default());
        rig.fill_inputs();
        for index in 0..3 {
            let params = FrameParams { frame_slot: index % 2, reshaded: true, ..FrameParams::new(EXTENT) };
            rig.frame(&params);
        }
        assert!(!spy.live().is_empty(), "{preset} made nothing");
        drop(rig);
        assert!(spy.live().is_empty(), "{preset}: {:?} are left", spy.live());
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
            // Whose memory runs out is told how much was asked for, and what to make smaller.
            let tells = |part: &str| error.to_string().contains(part);
            let is_told = match &error {
                Error::OutOfMemory { bytes, .. } => *bytes > 0 && [&bytes.to_string(), "in all", "extent"].map(tells) == [true; 3],
                _ => kind != "memory",
            };
            assert!(is_told, "{kind} {after}: {error}");
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
    let extents = [[19, 17], [24, 18], [5, 3]];
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
        rig.frame(&params);
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
