//! The life of frames against a small model: one that was not recorded is no history, and nobody reads what was never written.

use super::graphs::dice::Dice;
use super::support::rig::Rig;
use super::support::{assert_finite, assert_valid, gpu, soak};
use ash::vk;
use atrous::config::{PostProcess, Preset};
use atrous::executor::{Executor, ExecutorOptions};
use atrous::{Config, Error, FrameContext, FrameParams, Phase, ResetReason, Tuning, UseFrame};
use atrous_harness::DeviceTest;

pub const TESTS: &[DeviceTest] = &[
    ("a_frame_that_was_not_recorded_is_no_history", a_frame_that_was_not_recorded_is_no_history),
    ("a_slot_beyond_the_last_is_refused", a_slot_beyond_the_last_is_refused),
    ("any_life_of_frames_follows_the_model", any_life_of_frames_follows_the_model),
];

const EXTENT: [u32; 2] = [17, 11];
const LARGER: [u32; 2] = [24, 18];

fn config(preset: Preset, extent: [u32; 2]) -> Config {
    Config { preset, post_process: PostProcess::ToneMapTaa, ..Config::new(extent) }
}

/// A host that gives the same light to every pixel, so that anything else in the picture comes from memory that was never written.
struct Host {
    rig: Rig,
    target: (vk::Buffer, *mut u8),
    extent: [u32; 2],
    frames: u32,
}

impl Host {
    fn new(preset: Preset) -> Self {
        let gpu = gpu();
        let options = ExecutorOptions {
            extra_image_usage: vk::ImageUsageFlags::TRANSFER_SRC,
            poison: true,
            timestamps: gpu.has_timestamps(),
            ..Default::default()
        };
        let mut rig = Rig::with_options(gpu, &config(preset, EXTENT), 1, options);
        rig.fill_inputs();
        let target = rig.staging((LARGER[0] * LARGER[1] * 16) as usize);
        Self { rig, target, extent: EXTENT, frames: 0 }
    }

    fn params(&mut self) -> FrameParams {
        self.frames += 1;
        FrameParams { frame_slot: self.frames % 2, reshaded: true, ..FrameParams::new(self.extent) }
    }

    fn begin(&mut self, params: &FrameParams) -> Result<FrameContext, Error> {
        self.rig.executor.begin_frame(params, &Tuning::default())
    }

    fn record(&mut self, frame: &FrameContext, phases: &[Phase]) {
        self.rig.submit(|rig, cmd| {
            for &phase in phases {
                // SAFETY: the command buffer is recording, and everything that was recorded before is complete.
                unsafe { rig.executor.record(cmd, frame, phase) }.expect("recorded");
            }
        });
    }

    fn output(&mut self, frame: &FrameContext, name: &str) -> Vec<[f32; 4]> {
        let copy = self.rig.executor.readback(name, frame, UseFrame::Current).expect(name);
        let target = self.target;
        self.rig.submit(|rig, cmd| {
            // SAFETY: the command buffer is recording; the buffer has room for the largest output.
            unsafe { rig.executor.record_copy(cmd, frame, name, UseFrame::Current, target.0) }.expect(name);
        });
        // SAFETY: the buffer is mapped and this large, and the copy into it is complete.
        copy.to_floats(unsafe { std::slice::from_raw_parts(target.1, copy.bytes as usize) })
    }

    /// Everything is recorded, and the picture is the light of the inputs.
    fn record_whole(&mut self, frame: &FrameContext, what: &str) {
        self.record(frame, &Phase::ALL);
        let name = ["denoised_radiance", "denoised_volume"]
            .into_iter()
            .find(|name| self.rig.executor.denoiser().declaration().find(name).is_some());
        for texel in self.output(frame, name.expect("an output")) {
            let is_light = |c: &f32| (c / Rig::LIGHT - 1.0).abs() < 4e-3;
            assert!(texel[..3].iter().all(is_light), "{what}, {frame:?}: {texel:?}");
        }
        let display = self.output(frame, "display");
        assert_finite(&display, self.extent, self.extent);
    }

    fn resize(&mut self, extent: [u32; 2]) {
        self.rig.resize(extent);
        self.extent = extent;
    }
}

fn a_frame_that_was_not_recorded_is_no_history() {
    for preset in [Preset::Svgf, Preset::Asvgf, Preset::Percentile, Preset::Volume, Preset::Best] {
        for recorded in [&[][..], &[Phase::BeforeLighting]] {
            let what = format!("{preset:?}, {recorded:?} recorded");
            let mut host = Host::new(preset);
            for index in 0..4 {
                let params = host.params();
                let frame = host.begin(&params).expect("a frame");
                let expected = [Some(ResetReason::Created), None, Some(ResetReason::Created), None];
                assert_eq!((frame.index, frame.reset), (index, expected[index as usize]), "{what}");
                match index {
                    1 => host.record(&frame, recorded),
                    _ => host.record_whole(&frame, &what),
                }
            }
        }
    }
    assert_valid();
}

fn a_slot_beyond_the_last_is_refused() {
    let mut host = Host::new(Preset::Svgf);
    let params = host.params();
    let frame = host.begin(&params).expect("a frame");
    let error = Error::FrameSlot { given: 2, frames_in_flight: 2 };
    let beyond = FrameContext { slot: 2, ..frame };
    let refused = |executor: &mut Executor, phase: Phase| {
        // SAFETY: nothing is recorded, so that the null command buffer is never used.
        unsafe { executor.record(vk::CommandBuffer::null(), &beyond, phase) }
    };
    for phase in Phase::ALL {
        assert_eq!(refused(&mut host.rig.executor, phase), Err(error.clone()), "{phase:?}");
    }
    assert_eq!(host.begin(&FrameParams { frame_slot: 2, ..params }), Err(error));
    host.record_whole(&frame, "what was refused changed nothing");
    assert_eq!(host.begin(&params).expect("a frame").reset, None);
    assert_valid();
}

/// What the next frame has to be.
#[derive(Debug)]
struct Model {
    index: u64,
    reset: Option<ResetReason>,
    /// Whether the frame that was begun last was recorded.
    is_whole: bool,
}

impl Model {
    fn begin(&mut self, given: Option<ResetReason>) -> (u64, Option<ResetReason>) {
        let forced = if self.is_whole { self.reset } else { Some(ResetReason::Created) };
        let next = (self.index, given.or(forced));
        *self = Self { index: self.index + 1, reset: None, is_whole: false };
        next
    }
}

/// One step of a life; gives what it was, for messages.
fn step(host: &mut Host, model: &mut Model, dice: &mut Dice) -> String {
    let choice = dice.below(14);
    match choice {
        10 => {
            let extent = dice.one_of(&[EXTENT, LARGER]);
            host.resize(extent);
            *model = Model { index: 0, reset: Some(ResetReason::Resize), is_whole: true };
            return format!("resize to {extent:?}");
        }
        11 => {
            host.rig.executor.invalidate();
            model.reset = Some(ResetReason::Created);
            return "invalidate".to_owned();
        }
        12 => {
            let params = FrameParams { frame_slot: 2, ..host.params() };
            host.begin(&params).expect_err("a slot beyond the last");
            return "a wrong slot".to_owned();
        }
        _ => {}
    }
    let given = (choice == 9).then_some(ResetReason::CameraCut);
    let slot = dice.below(2);
    let params = FrameParams { reset: given, frame_slot: slot, ..host.params() };
    let mut frame = host.begin(&params).expect("a frame");
    assert_eq!((frame.index, frame.reset), model.begin(given), "{choice}");
    // Behind the wrap of the 32 bits that shaders see of the index.
    if dice.coin() {
        frame.constants.frame_index = frame.constants.frame_index.wrapping_sub(2);
    }
    match choice {
        7 => {}
        8 => host.record(&frame, &[Phase::BeforeLighting]),
        _ => {
            host.record_whole(&frame, &format!("step {choice}"));
            if choice == 6 {
                host.record_whole(&frame, "recorded twice");
            }
            model.is_whole = true;
        }
    }
    format!("{choice} in slot {slot}")
}

fn any_life_of_frames_follows_the_model() {
    for (seed, preset) in (0..).zip(Preset::ALL) {
        let (mut host, mut dice) = (Host::new(preset), Dice::new(seed));
        let mut model = Model { index: 0, reset: Some(ResetReason::Created), is_whole: true };
        let steps = soak::times(16);
        let mut last = Vec::new();
        for _ in 0..steps {
            last.push(step(&mut host, &mut model, &mut dice));
        }
        assert!(last.len() as u32 == steps && model.index <= u64::from(steps), "{preset:?}: {last:?}");
    }
    assert_valid();
}
