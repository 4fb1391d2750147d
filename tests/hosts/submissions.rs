//! The phases in command buffers and submissions of their own, ordered by a timeline semaphore and by nothing else on the host.

use super::{of_executor, params};
use crate::support::rig::{whole, Rig, UPLOADED};
use crate::support::{assert_valid, gpu};
use ash::vk;
use atrous::{Access, Config, FrameContext, Phase, Tuning, UseFrame};
use atrous_synthetic as synthetic;

const IMAGE: usize = (synthetic::EXTENT[0] * synthetic::EXTENT[1] * 16) as usize;
const INPUTS: [&str; 6] = ["depth", "normal", "motion", "albedo", "surface_id", "noisy_radiance"];

/// Four submissions a frame: guides and `BeforeLighting`, lighting, `AfterLighting`, the copy of the result.
const SUBMISSIONS: u64 = 4;

struct Queue {
    rig: Rig,
    semaphore: vk::Semaphore,
    submitted: u64,
    staging: (vk::Buffer, *mut u8),
    /// One per frame.
    results: Vec<(vk::Buffer, *mut u8)>,
}

pub fn phases_in_submissions_of_their_own_give_the_same_bits() {
    let gpu = gpu();
    if !gpu.has_timeline_semaphores() {
        println!("no timeline semaphores here: nothing to prove");
        return;
    }
    let config = Config::new(synthetic::EXTENT);
    let mut rig = Rig::new(gpu.clone(), &config, synthetic::FRAMES * SUBMISSIONS as u32);
    // The rig binds optional inputs that the other hosts do not have.
    for name in ["roughness", "emission"] {
        rig.executor.unbind(name).expect(name);
    }
    let staging = rig.staging(IMAGE * INPUTS.len() * synthetic::FRAMES as usize);
    let results: Vec<_> = (0..synthetic::FRAMES).map(|_| rig.staging(IMAGE / 2)).collect();
    let mut kind = vk::SemaphoreTypeCreateInfo::default().semaphore_type(vk::SemaphoreType::TIMELINE);
    // SAFETY: the device is live and has timeline semaphores.
    let semaphore = unsafe { gpu.device().create_semaphore(&vk::SemaphoreCreateInfo::default().push_next(&mut kind), None) }
        .expect("semaphore");
    let mut queue = Queue { rig, semaphore, submitted: 0, staging, results: results.clone() };
    (0..synthetic::FRAMES).for_each(|index| queue.frame(index));
    queue.wait_for(queue.submitted);
    // SAFETY: the buffers are mapped and large enough, and the copies into them are complete.
    let bytes = results.iter().map(|result| unsafe { std::slice::from_raw_parts(result.1, IMAGE / 2) });
    let lines: Vec<String> = (0..).zip(bytes).map(|(index, bytes)| synthetic::report(index, bytes)).collect();
    drop(queue);
    // SAFETY: the device is idle, since the rig waited for it.
    unsafe { gpu.device().destroy_semaphore(semaphore, None) };
    assert_eq!(lines, of_executor());
    assert_valid();
}

impl Queue {
    fn frame(&mut self, index: u32) {
        let input = synthetic::Frame::new(index);
        // As many frames in flight as slots: the frame before the last must be complete.
        self.wait_for((u64::from(index) * SUBMISSIONS).saturating_sub(SUBMISSIONS));
        let frame = self.rig.executor.begin_frame(&params(index), &Tuning::default()).expect("frame");
        self.submit(|queue, cmd| {
            for (i, texels) in input.images.iter().take(4).enumerate() {
                queue.upload(cmd, index, i, &synthetic::bytes(texels));
            }
            let ids: Vec<u8> = input.surface_id.iter().flat_map(|id| id.to_le_bytes()).collect();
            queue.upload(cmd, index, 4, &ids);
            queue.phase(cmd, &frame, Phase::BeforeLighting);
        });
        self.submit(|queue, cmd| queue.upload(cmd, index, 5, &synthetic::bytes(&input.images[4])));
        self.submit(|queue, cmd| queue.phase(cmd, &frame, Phase::AfterLighting));
        self.submit(|queue, cmd| {
            let buffer = queue.results[index as usize].0;
            // SAFETY: the command buffer is recording, and the buffer is large enough.
            unsafe { queue.rig.executor.record_copy(cmd, &frame, "denoised_radiance", UseFrame::Current, buffer) }.expect("copy");
        });
    }

    fn phase(&mut self, cmd: vk::CommandBuffer, frame: &FrameContext, phase: Phase) {
        // SAFETY: the command buffer is recording; the submission before is waited for by the semaphore.
        unsafe { self.rig.executor.record(cmd, frame, phase) }.expect("phase");
    }

    fn upload(&mut self, cmd: vk::CommandBuffer, index: u32, input: usize, bytes: &[u8]) {
        let offset = (index as usize * INPUTS.len() + input) * IMAGE;
        let image = self.rig.images[INPUTS[input]];
        let (stage, access, layout) = UPLOADED;
        let device = self.rig.gpu.device();
        let barrier = vk::ImageMemoryBarrier2::default()
            .image(image)
            .subresource_range(whole())
            .src_stage_mask(stage)
            .src_access_mask(access)
            .dst_stage_mask(stage)
            .dst_access_mask(access)
            .new_layout(layout);
        let layers = vk::ImageSubresourceLayers::default().aspect_mask(vk::ImageAspectFlags::COLOR).layer_count(1);
        let [width, height] = synthetic::EXTENT;
        let region = vk::BufferImageCopy::default()
            .buffer_offset(offset as u64)
            .image_subresource(layers)
            .image_extent(vk::Extent3D { width, height, depth: 1 });
        // SAFETY: this part of the staging buffer belongs to this input of this frame; the rest is live.
        unsafe {
            self.staging.1.add(offset).copy_from_nonoverlapping(bytes.as_ptr(), bytes.len());
            device.cmd_pipeline_barrier2(cmd, &vk::DependencyInfo::default().image_memory_barriers(&[barrier]));
            device.cmd_copy_buffer_to_image(cmd, self.staging.0, image, layout, &[region]);
        }
    }

    /// A command buffer of its own, which waits for the submission before and signals the next value.
    fn submit(&mut self, record: impl FnOnce(&mut Self, vk::CommandBuffer)) {
        let gpu = self.rig.gpu.clone();
        let cmd = self.rig.commands[self.submitted as usize];
        let stages = vk::PipelineStageFlags2::ALL_COMMANDS;
        let point = |value| [vk::SemaphoreSubmitInfo::default().semaphore(self.semaphore).value(value).stage_mask(stages)];
        let (wait, signal) = (point(self.submitted), point(self.submitted + 1));
        // SAFETY: the command buffer is used once; everything it names is live until the rig waited for the device.
        unsafe {
            gpu.device().begin_command_buffer(cmd, &vk::CommandBufferBeginInfo::default()).expect("begin");
            record(self, cmd);
            gpu.device().end_command_buffer(cmd).expect("end");
            let commands = [vk::CommandBufferSubmitInfo::default().command_buffer(cmd)];
            let info = vk::SubmitInfo2::default()
                .command_buffer_infos(&commands)
                .wait_semaphore_infos(&wait)
                .signal_semaphore_infos(&signal);
            gpu.device().queue_submit2(*gpu.queue(), &[info], vk::Fence::null()).expect("submit");
        }
        self.submitted += 1;
    }

    fn wait_for(&self, value: u64) {
        let (semaphores, values) = ([self.semaphore], [value]);
        let info = vk::SemaphoreWaitInfo::default().semaphores(&semaphores).values(&values);
        // SAFETY: the semaphore is live, and the value was submitted.
        unsafe { self.rig.gpu.device().wait_semaphores(&info, u64::MAX) }.expect("wait");
    }
}

/// `boundary` says what a host with two queues hands over: what one phase writes and a later one touches.
pub fn the_boundary_names_what_crosses_between_phases() {
    for config in super::configurations() {
        let declaration = config.declare().expect("valid");
        let [before, after, _] = Phase::ALL.map(|phase| declaration.boundary(phase));
        let crossing: Vec<&str> = before
            .iter()
            .filter(|b| b.written && after.iter().any(|a| a.resource == b.resource && a.frame == b.frame))
            .map(|b| declaration.resource(b.resource).name.as_str())
            .collect();
        for name in ["frame_constants", "guide", "surface_motion"] {
            assert!(crossing.contains(&name), "{:?}: {name} is not in {crossing:?}", config.preset);
        }
        for a in &after {
            let uses = declaration.passes().iter().filter(|p| p.phase == Phase::AfterLighting).flat_map(|p| &p.uses);
            let of: Vec<Access> = uses.filter(|u| u.resource == a.resource && u.frame == a.frame).map(|u| u.access).collect();
            assert_eq!((of.first(), of.last()), (Some(&a.first), Some(&a.last)));
            assert_eq!(of.iter().any(|access| access.writes()), a.written);
        }
    }
}
