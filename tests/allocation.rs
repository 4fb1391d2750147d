//! What recording costs the CPU: time, and no heap allocation in the steady state.

use super::support::rig::Rig;
use ash::vk;
use atrous::config::{PostProcess, Preset, Signals};
use atrous::executor::{HeadlessDevice, HeadlessOptions};
use atrous::{Binding, Config, FrameParams, Phase, Tuning};
use atrous_harness::DeviceTest;
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::sync::Arc;
use std::time::Instant;

pub const TESTS: &[DeviceTest] = &[("recording_a_frame_allocates_nothing", recording_a_frame_allocates_nothing)];

/// The system's allocator, which counts what the calling thread asks of it.
pub struct Counting;

thread_local! {
    static COUNT: Cell<u64> = const { Cell::new(0) };
}

// SAFETY: everything is passed on to the system's allocator; the counter is not allocated, and is left alone while a thread ends.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let _ = COUNT.try_with(|count| count.set(count.get() + 1));
        // SAFETY: the layout has a size above 0, which is all that the system allocator asks for.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: the pointer came from `alloc` above, which is the system allocator's, with this layout.
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        let _ = COUNT.try_with(|count| count.set(count.get() + 1));
        // SAFETY: the pointer came from `alloc` above with this layout, and the new size is above 0.
        unsafe { System.realloc(pointer, layout, size) }
    }
}

/// Allocations of this thread during `body`.
fn allocations(body: impl FnOnce()) -> u64 {
    let before = COUNT.get();
    body();
    COUNT.get() - before
}

/// Records a frame of a rig without ever submitting it.
fn record(rig: &mut Rig, index: u32) {
    let setup = *rig.executor.denoiser().declaration().setup();
    let params = FrameParams { frame_slot: index % 2, reshaded: true, ..FrameParams::new(setup.allocated_extent) };
    let frame = rig.executor.begin_frame(&params, &Tuning::default()).expect("frame");
    let cmd = rig.commands[0];
    let device = rig.gpu.device().clone();
    // SAFETY: the command buffer is idle, since nothing is ever submitted.
    unsafe {
        device.begin_command_buffer(cmd, &vk::CommandBufferBeginInfo::default()).expect("begin");
        for phase in Phase::ALL {
            rig.executor.record(cmd, &frame, phase).expect("record");
        }
        device.end_command_buffer(cmd).expect("end");
    }
}

fn recording_a_frame_allocates_nothing() {
    assert!(allocations(|| drop(std::hint::black_box(Box::new(1)))) > 0, "the allocator does not count");
    // Without validation, whose layer takes most of the time.
    let gpu = Arc::new(HeadlessDevice::new(&HeadlessOptions::default()).expect("device"));
    for preset in [Preset::Svgf, Preset::Asvgf, Preset::Percentile, Preset::Best] {
        for signals in Signals::ALL {
            let config = Config { preset, signals, post_process: PostProcess::ToneMapTaa, ..Config::new([320, 180]) };
            let mut rig = Rig::new(gpu.clone(), &config, 1);
            (0..4).for_each(|index| record(&mut rig, index));
            let mut times: Vec<f64> = Vec::with_capacity(200);
            for index in 4..204 {
                let start = Instant::now();
                let count = allocations(|| record(&mut rig, index));
                times.push(start.elapsed().as_secs_f64() * 1e6);
                assert_eq!(count, 0, "{preset:?}, {signals:?}, frame {index}");
            }
            times.sort_by(f64::total_cmp);
            let passes = rig.executor.denoiser().declaration().passes().len();
            println!(
                "recording {preset:?}, {signals:?}: {passes} passes with barriers, {:.1} us a frame (least {:.1})",
                times[100], times[0]
            );
        }
    }
    refused_bindings_allocate_only_their_message();
}

/// The error path is the only one that may.
fn refused_bindings_allocate_only_their_message() {
    let gpu = super::support::gpu();
    // SAFETY: the handles are live and outlive the denoiser; nothing is recorded, since the bindings do not fit.
    unsafe {
        let mut denoiser = atrous::Denoiser::new(gpu.host(), Config::new([8, 8]).declare().expect("valid")).expect("denoiser");
        let frame = denoiser.begin_frame(&FrameParams::new([8, 8]), &Tuning::default()).expect("frame");
        let count = allocations(|| assert!(denoiser.record(vk::CommandBuffer::null(), &frame, 0, &[Binding::Absent; 2]).is_err()));
        assert!(count <= 2, "{count}");
    }
}
