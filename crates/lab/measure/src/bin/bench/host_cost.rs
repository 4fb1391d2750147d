//! What a graph costs the CPU of a host: opening it, and recording a frame.

use super::clock::EmptySubmission;
use super::content::Content;
use super::report::HostCost;
use super::runner::Frames;
use ash::vk;
use atrous::executor::{Executor, ExecutorOptions, HeadlessDevice};
use atrous::{Declaration, Denoiser, Device, FrameParams, Phase, Tuning};
use cpu_time::{ProcessTime, ThreadTime};
use std::error::Error;
use std::time::Instant;

const BATCHES: usize = 9;
const FRAMES_IN_BATCH: u32 = 40;

/// Creates all pipelines of a declaration, with the caches of the driver as they are.
pub fn start_up(gpu: &HeadlessDevice, declaration: &Declaration) -> Result<HostCost, atrous::Error> {
    let (wall, cpu) = (Instant::now(), ProcessTime::now());
    // SAFETY: the handles are live, belong together and outlive the denoiser.
    let denoiser = unsafe { Denoiser::new(Device { pipelines: None, ..gpu.host() }, declaration.clone())? };
    let cost = HostCost {
        start_up_ms: wall.elapsed().as_secs_f64() * 1e3,
        start_up_cpu_ms: cpu.elapsed().as_secs_f64() * 1e3,
        recording_us: f64::NAN,
    };
    drop(denoiser);
    Ok(cost)
}

/// Microseconds of CPU time to record a frame with all barriers; it is never submitted. The least of a few batches, since other
/// work on the machine only ever adds.
pub fn recording(
    gpu: &HeadlessDevice,
    declaration: &Declaration,
    content: Content,
    frames: &Frames,
    buffer: &mut EmptySubmission,
) -> Result<f64, Box<dyn Error>> {
    let cmd = buffer.command_buffer();
    let setup = *declaration.setup();
    // SAFETY: the device is live, has synchronization2 and outlives the executor; nothing of it is ever submitted.
    let mut executor = unsafe { Executor::new(gpu.host(), declaration.clone(), ExecutorOptions::default())? };
    frames[0].bind(&mut executor)?;
    let mut least = f64::INFINITY;
    for batch in 0..BATCHES as u32 {
        let start = ThreadTime::now();
        for index in 0..FRAMES_IN_BATCH {
            let frame_slot = (batch * FRAMES_IN_BATCH + index) % setup.frames_in_flight;
            let params = FrameParams { frame_slot, reshaded: true, ..content.params(setup.allocated_extent, 0) };
            let frame = executor.begin_frame(&params, &Tuning::default())?;
            // SAFETY: the command buffer is idle, since it is not submitted while `buffer` is borrowed; what is bound is live.
            unsafe {
                gpu.device().begin_command_buffer(cmd, &vk::CommandBufferBeginInfo::default())?;
                for phase in Phase::ALL {
                    executor.record(cmd, &frame, phase)?;
                }
                gpu.device().end_command_buffer(cmd)?;
            }
        }
        least = least.min(start.elapsed().as_secs_f64() * 1e6 / f64::from(FRAMES_IN_BATCH));
    }
    Ok(least)
}
