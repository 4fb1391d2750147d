//! Frames of an executor that were recorded and never ran: their submission failed, or their command buffer was thrown away.

use crate::support::rig::Rig;
use crate::support::{assert_valid, gpu};
use ash::vk;
use atrous::config::Preset;
use atrous::{Config, FrameContext, FrameParams, Phase, ResetReason, Tuning, UseFrame};

const EXTENT: [u32; 2] = [19, 17];

fn begin(rig: &mut Rig) -> FrameContext {
    rig.executor.begin_frame(&FrameParams { reshaded: true, ..FrameParams::new(EXTENT) }, &Tuning::default()).expect("a frame")
}

/// Records a frame into a command buffer that is never submitted.
fn record_in_vain(rig: &mut Rig) {
    let frame = begin(rig);
    let (gpu, cmd) = (rig.gpu.clone(), rig.commands[0]);
    // SAFETY: the command buffer is idle, since each submission is waited for; what is bound lives as long as the rig.
    unsafe {
        gpu.device().begin_command_buffer(cmd, &vk::CommandBufferBeginInfo::default()).expect("begin");
        for phase in Phase::ALL {
            rig.executor.record(cmd, &frame, phase).expect("recorded");
        }
        gpu.device().end_command_buffer(cmd).expect("end");
        gpu.device().reset_command_buffer(cmd, vk::CommandBufferResetFlags::empty()).expect("reset");
    }
}

/// Runs a frame. Its output, and why it dropped history.
fn run(rig: &mut Rig) -> (Vec<u8>, Option<ResetReason>) {
    let frame = begin(rig);
    let size = rig.executor.readback("denoised_radiance", &frame, UseFrame::Current).expect("an output").bytes as usize;
    let (buffer, mapped) = rig.staging(size);
    rig.submit(|rig, cmd| {
        rig.record(cmd, &frame);
        // SAFETY: the command buffer is recording, and the buffer has room for the output.
        unsafe { rig.executor.record_copy(cmd, &frame, "denoised_radiance", UseFrame::Current, buffer) }.expect("copied");
    });
    // SAFETY: the buffer is mapped for so many bytes, and the copy was waited for.
    (unsafe { std::slice::from_raw_parts(mapped, size) }.to_vec(), frame.reset)
}

pub fn what_was_recorded_and_never_ran_is_forgotten() {
    for preset in [Preset::Svgf, Preset::Asvgf, Preset::Best] {
        let mut rig = Rig::new(gpu(), &Config { preset, ..Config::new(EXTENT) }, 1);
        rig.fill_inputs();
        let (expected, _) = run(&mut rig);
        for before in [0, 1, 2] {
            for _ in 0..before {
                run(&mut rig);
            }
            record_in_vain(&mut rig);
            rig.executor.forget_recorded();
            let (bytes, reset) = run(&mut rig);
            assert!(reset.is_some(), "{preset}, behind {before} frames: history is dropped");
            assert!(bytes == expected, "{preset}, behind {before} frames: not the bits of a first frame");
        }
        // One that never ran before the first.
        let mut rig = Rig::new(gpu(), &Config { preset, ..Config::new(EXTENT) }, 1);
        rig.fill_inputs();
        record_in_vain(&mut rig);
        rig.executor.forget_recorded();
        assert!(run(&mut rig).0 == expected, "{preset}: not the bits of a first frame");
    }
    assert_valid();
}

/// The copy of the counters that was recorded with a frame holds nothing where that frame never ran.
pub fn counters_that_never_ran_are_not_read() {
    let mut rig = Rig::new(gpu(), &Config::new(EXTENT), 1);
    rig.fill_inputs();
    run(&mut rig);
    record_in_vain(&mut rig);
    rig.executor.forget_recorded();
    run(&mut rig);
    assert_eq!(rig.executor.statistics(), None, "no copy of the counters ran");
    run(&mut rig);
    run(&mut rig);
    assert!(rig.executor.statistics().is_some());
    assert_valid();
}

#[cfg(feature = "capture")]
pub fn a_captured_frame_that_never_ran_is_not_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut rig = Rig::new(gpu(), &Config::new(EXTENT), 1);
    rig.fill_inputs();
    rig.executor.capture(folder.path().join("a"), 2).expect("a capture");
    record_in_vain(&mut rig);
    rig.executor.forget_recorded();
    run(&mut rig);
    // SAFETY: every submission was waited for.
    let error = unsafe { rig.executor.finish_capture() }.expect_err("a frame is lacking").to_string();
    assert!(error.contains("frame 0 was recorded and never ran"), "{error}");
    rig.executor.capture(folder.path().join("b"), 1).expect("another capture");
    run(&mut rig);
    // SAFETY: every submission was waited for.
    assert_eq!(unsafe { rig.executor.finish_capture() }, Ok(1));
    assert_valid();
}
