//! The counters that an executor reads by itself: those of frames that ran, and of no other buffer than its own.

use super::support::rig::Rig;
use super::support::{assert_valid, gpu, scene::Scene, session, upload};
use ash::vk;
use atrous::executor::Session;
use atrous::{Config, Counter, FrameParams, Statistics, Tuning};
use atrous_harness::DeviceTest;

pub const TESTS: &[DeviceTest] = &[
    ("after_a_resize_only_frames_that_ran_are_counted", after_a_resize_only_frames_that_ran_are_counted),
    ("a_buffer_of_the_host_is_left_to_it", a_buffer_of_the_host_is_left_to_it),
];

const EXTENT: [u32; 2] = [24, 14];

/// Runs a frame with so many radiances that are not finite, and gives how many the executor read of.
fn counted(s: &mut Session, extent: [u32; 2], frame: u32, bad: usize) -> Option<u32> {
    let scene = Scene::new(extent);
    let mut guides = scene.frame(frame, frame);
    guides.noisy_radiance[..bad].fill([f32::NAN; 4]);
    upload(s, &guides);
    let params = FrameParams { frame_slot: frame % 2, ..scene.params(frame) };
    s.run(&params, &Tuning::default()).expect("a frame");
    s.executor().statistics().map(|statistics| statistics[Counter::Radiance])
}

/// A slot brings the counters of the frame before the one that it was used for last.
fn after_a_resize_only_frames_that_ran_are_counted() {
    let mut s = session(&Config::new(EXTENT));
    let before: Vec<_> = (0..5).map(|frame| counted(&mut s, EXTENT, frame, 10 + frame as usize)).collect();
    assert_eq!(before, [None, None, None, Some(10), Some(11)]);
    let extent = [31, 9];
    s.resize(extent).expect("another extent");
    let after: Vec<_> = (5..10).map(|frame| counted(&mut s, extent, frame, 10 + frame as usize)).collect();
    // The last frame before it is lost with its buffer; the first one behind it finds nothing to read.
    assert_eq!(after, [12, 13, 13, 15, 16].map(Some));
    assert_valid();
}

fn a_buffer_of_the_host_is_left_to_it() {
    let mut rig = Rig::new(gpu(), &Config::new(EXTENT), 1);
    rig.fill_inputs();
    let size = size_of::<Statistics>();
    let usage = vk::BufferUsageFlags::STORAGE_BUFFER | vk::BufferUsageFlags::TRANSFER_DST;
    let (buffer, mapped) = rig.buffer(size, usage);
    let (stage, access) = (vk::PipelineStageFlags2::ALL_TRANSFER, vk::AccessFlags2::TRANSFER_WRITE);
    rig.executor.bind_buffer("statistics", buffer, size as u64, stage, access).expect("an output");
    (0..5).for_each(|frame| run(&mut rig, frame));
    assert_eq!(rig.executor.statistics(), None, "they went elsewhere");
    // SAFETY: mapped, so large, and every submission was waited for.
    let bytes = unsafe { std::slice::from_raw_parts(mapped, size) };
    let kept = Statistics::from_bytes(bytes).expect("counters")[Counter::HistoryKept];
    assert_eq!(kept, EXTENT[0] * EXTENT[1]);
    // In its own buffer the executor finds nothing, until it has written there.
    rig.executor.unbind("statistics").expect("an output");
    for frame in 5..12 {
        run(&mut rig, frame);
        let kept = rig.executor.statistics().map(|statistics| statistics[Counter::HistoryKept]);
        let expected = (frame >= 8).then_some(EXTENT[0] * EXTENT[1]);
        assert_eq!(kept, expected, "frame {frame}");
    }
    assert_valid();
}

fn run(rig: &mut Rig, frame: u32) {
    let params = FrameParams { frame_slot: frame % 2, ..FrameParams::new(EXTENT) };
    rig.frame(&params);
}
