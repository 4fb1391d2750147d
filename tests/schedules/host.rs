//! A host that runs a plan: images of its own in `GENERAL`, memory as planned, one barrier of all memory between batches.

use super::memory::{region, Bare, Mapped, Memory, Stored};
use super::plan::{is_transient_image, Plan};
use crate::graphs::dice::Dice;
use crate::graphs::inputs::Inputs;
use crate::support::gpu;
use crate::support::rig::whole;
use ash::vk;
use atrous::executor::HeadlessDevice;
use atrous::{Binding, Declaration, Denoiser, FrameParams, Lifetime, ResourceId, Shape, Tuning, Use};
use std::sync::Arc;

const UNDEFINED: vk::ImageLayout = vk::ImageLayout::UNDEFINED;
const GENERAL: vk::ImageLayout = vk::ImageLayout::GENERAL;

pub struct Host {
    // Declared first, so that what the device still works with is waited for first.
    memory: Memory,
    denoiser: Denoiser,
    pub plan: Plan,
    gpu: Arc<HeadlessDevice>,
    stored: Vec<[Option<Stored>; 2]>,
    pool: vk::CommandPool,
    /// Command buffer and fence of each slot.
    slots: Vec<(vk::CommandBuffer, vk::Fence)>,
    /// Outputs of each frame by name, with their size.
    results: Vec<Vec<(String, Mapped, usize)>>,
}

impl Host {
    pub fn new(declaration: &Declaration, dice: &mut Dice) -> Self {
        let gpu = gpu();
        let device = gpu.device();
        // SAFETY: the device is live and outlives everything here, which is destroyed with the host.
        let (denoiser, pool, slots) = unsafe {
            let info = vk::CommandPoolCreateInfo::default()
                .queue_family_index(gpu.queue_family())
                .flags(vk::CommandPoolCreateFlags::RESET_COMMAND_BUFFER);
            let pool = device.create_command_pool(&info, None).expect("pool");
            let count = declaration.setup().frames_in_flight;
            let info = vk::CommandBufferAllocateInfo::default().command_pool(pool).command_buffer_count(count);
            let signalled = vk::FenceCreateInfo::default().flags(vk::FenceCreateFlags::SIGNALED);
            let slots = device.allocate_command_buffers(&info).expect("command buffers").into_iter();
            let slots = slots.map(|cmd| (cmd, device.create_fence(&signalled, None).expect("fence"))).collect();
            (Denoiser::new(gpu.host(), declaration.clone()).expect("denoiser"), pool, slots)
        };
        let plan = Plan { batches: Vec::new(), places: Vec::new() };
        let stored = vec![[None, None]; declaration.resources().len()];
        let (memory, results) = (Memory::new(), Vec::new());
        let mut host = Self { memory, denoiser, plan, gpu, stored, pool, slots, results };
        host.allocate(declaration, dice);
        host
    }

    fn allocate(&mut self, declaration: &Declaration, dice: &mut Dice) {
        let mut transients = Vec::new();
        for id in (0..declaration.resources().len() as u32).map(ResourceId) {
            let resource = declaration.resource(id);
            for copy in 0..resource.lifetime.copies().max(1) {
                let stored = match resource.shape {
                    Shape::Buffer { size } => Stored::Buffer { buffer: self.memory.mapped(size, resource.buffer_usage).buffer },
                    Shape::Image { format, .. } => {
                        let wide = vk::Format::R32G32B32A32_SFLOAT;
                        let format = if format.accepts(wide) { wide } else { format.preferred() };
                        let extent = resource.extent(declaration.setup()).expect("an image");
                        let bare = self.memory.image(format, extent, resource.image_usage);
                        if is_transient_image(declaration, id) {
                            transients.push((id, bare));
                            continue;
                        }
                        let memory = self.memory.allocate(bare.needs, vk::MemoryPropertyFlags::empty());
                        self.memory.bind(bare, memory, 0)
                    }
                };
                self.stored[id.0 as usize][copy] = Some(stored);
            }
        }
        self.share(declaration, dice, &transients);
    }

    /// One block for all transients, each where the plan has it.
    fn share(&mut self, declaration: &Declaration, dice: &mut Dice, transients: &[(ResourceId, Bare)]) {
        let needs = |id: ResourceId| transients.iter().find(|t| t.0 == id).expect("a transient").1.needs;
        self.plan = Plan::random(declaration, dice, |id| (needs(id).size, needs(id).alignment));
        let places: Vec<_> =
            transients.iter().filter_map(|(id, bare)| Some((*id, *bare, self.plan.places[id.0 as usize]?))).collect();
        let size = places.iter().map(|(.., (offset, size))| offset + size).max();
        let Some(size) = size else { return };
        let memory_type_bits = places.iter().fold(u32::MAX, |bits, place| bits & place.1.needs.memory_type_bits);
        let block = vk::MemoryRequirements { size, alignment: 1, memory_type_bits };
        let memory = self.memory.allocate(block, vk::MemoryPropertyFlags::empty());
        for (id, bare, (offset, _)) in places {
            self.stored[id.0 as usize][0] = Some(self.memory.bind(bare, memory, offset));
        }
    }

    /// Records and submits a frame without waiting for it, and has its outputs copied.
    pub fn frame(&mut self, index: u32, params: &FrameParams, inputs: &Inputs) {
        let declaration = self.denoiser.declaration().clone();
        let gpu = self.gpu.clone();
        let device = gpu.device();
        let slot = index % declaration.setup().frames_in_flight;
        let (cmd, fence) = self.slots[slot as usize];
        let frame = self.denoiser.begin_frame(&FrameParams { frame_slot: slot, ..*params }, &Tuning::default()).expect("a frame");
        // SAFETY: the slot's earlier work is complete; every layout is reached, and the plan orders what conflicts.
        unsafe {
            device.wait_for_fences(&[fence], true, u64::MAX).expect("wait");
            device.reset_fences(&[fence]).expect("reset");
            device.begin_command_buffer(cmd, &vk::CommandBufferBeginInfo::default()).expect("begin");
            barrier(device, cmd);
            if index == 0 {
                let kept = |image: &&vk::Image| !self.starts(&declaration, None).contains(image);
                let images: Vec<_> = self.memory.images.iter().filter(kept).copied().collect();
                transition(device, cmd, &images, UNDEFINED, GENERAL);
            }
            let absent = self.upload(cmd, &declaration, inputs);
            for (number, batch) in self.plan.batches.clone().iter().enumerate() {
                barrier(device, cmd);
                transition(device, cmd, &self.starts(&declaration, Some(number)), UNDEFINED, GENERAL);
                for &pass in batch {
                    let uses = &declaration.passes()[pass].uses;
                    let binding = |u: &Use| match absent.contains(&u.resource) {
                        true => Binding::Absent,
                        false => self.binding(u, declaration.copy(u, &frame)),
                    };
                    let bindings: Vec<_> = uses.iter().map(binding).collect();
                    self.denoiser.record(cmd, &frame, pass, &bindings).expect("recorded");
                }
            }
            barrier(device, cmd);
            self.copy_outputs(cmd, &declaration);
            barrier(device, cmd);
            device.end_command_buffer(cmd).expect("end");
            let commands = [cmd];
            let submit = [vk::SubmitInfo::default().command_buffers(&commands)];
            device.queue_submit(*gpu.queue(), &submit, fence).expect("submit");
        }
    }

    /// Images of the transients that start in a batch, or in any.
    fn starts(&self, declaration: &Declaration, batch: Option<usize>) -> Vec<vk::Image> {
        let ids = (0..self.stored.len() as u32).map(ResourceId).filter(|&id| is_transient_image(declaration, id));
        let here = |id: &ResourceId| batch.is_none_or(|b| self.plan.life(declaration, *id).is_some_and(|life| life.0 == b));
        let image = |id: ResourceId| match self.stored[id.0 as usize][0] {
            Some(Stored::Image { image, .. }) => Some(image),
            _ => None,
        };
        ids.filter(here).filter_map(image).collect()
    }

    fn binding(&self, u: &Use, copy: usize) -> Binding {
        let layout = GENERAL;
        match self.stored[u.resource.0 as usize][copy].expect("a use of what was allocated") {
            Stored::Image { view, .. } => Binding::Image { view, layout },
            Stored::Buffer { buffer } => Binding::Buffer { buffer, offset: 0, range: vk::WHOLE_SIZE },
        }
    }

    /// Copies the inputs of a frame into their images, and gives those that are left out.
    ///
    /// # Safety
    /// The command buffer is recording, behind a barrier of everything.
    unsafe fn upload(&mut self, cmd: vk::CommandBuffer, declaration: &Declaration, inputs: &Inputs) -> Vec<ResourceId> {
        let mut absent = Vec::new();
        let buffers = declaration.find("instance_transforms").map(|_| ("instance_transforms", inputs.transforms()));
        for (name, bytes) in inputs.images().chain(buffers) {
            let id = declaration.find(name).expect(name);
            let Some(bytes) = bytes else {
                absent.push(id);
                continue;
            };
            let staging = self.memory.mapped(bytes.len() as u64, vk::BufferUsageFlags::STORAGE_BUFFER);
            let stored = self.stored[id.0 as usize][0];
            // SAFETY: the staging buffer is new and large enough; the target is live, and in GENERAL where it is an image.
            unsafe {
                staging.pointer.copy_from_nonoverlapping(bytes.as_ptr(), bytes.len());
                match stored {
                    Some(Stored::Image { image, extent, .. }) => {
                        let (device, layout) = (self.gpu.device(), vk::ImageLayout::TRANSFER_DST_OPTIMAL);
                        transition(device, cmd, &[image], UNDEFINED, layout);
                        device.cmd_copy_buffer_to_image(cmd, staging.buffer, image, layout, &[region(extent)]);
                        transition(device, cmd, &[image], layout, GENERAL);
                    }
                    Some(Stored::Buffer { .. }) | None => {
                        self.stored[id.0 as usize][0] = Some(Stored::Buffer { buffer: staging.buffer });
                    }
                }
            }
        }
        absent
    }

    unsafe fn copy_outputs(&mut self, cmd: vk::CommandBuffer, declaration: &Declaration) {
        let mut results = Vec::new();
        for (resource, [stored, _]) in declaration.resources().iter().zip(self.stored.clone()) {
            let is_output = resource.lifetime == Lifetime::Output && !resource.name.starts_with("debug_view");
            let Some(Stored::Image { image, extent, .. }) = stored.filter(|_| is_output) else { continue };
            let size = resource.bytes(declaration.setup());
            let target = self.memory.mapped(size, vk::BufferUsageFlags::TRANSFER_DST);
            let (device, layout) = (self.gpu.device(), vk::ImageLayout::TRANSFER_SRC_OPTIMAL);
            // SAFETY: the command buffer is recording behind a barrier of everything; the buffer has room for the image.
            unsafe {
                transition(device, cmd, &[image], GENERAL, layout);
                device.cmd_copy_image_to_buffer(cmd, image, layout, target.buffer, &[region(extent)]);
                transition(device, cmd, &[image], layout, GENERAL);
            }
            results.push((resource.name.clone(), target, size as usize));
        }
        self.results.push(results);
    }

    /// Outputs of every frame by name.
    pub fn outputs(&self) -> Vec<Vec<(String, Vec<u8>)>> {
        let fences: Vec<_> = self.slots.iter().map(|slot| slot.1).collect();
        // SAFETY: the fences are live, and each was submitted or made signalled.
        unsafe { self.gpu.device().wait_for_fences(&fences, true, u64::MAX) }.expect("wait");
        // SAFETY: the buffer is mapped and this large, and the copy into it is complete.
        let bytes = |mapped: &Mapped, size: usize| unsafe { std::slice::from_raw_parts(mapped.pointer, size).to_vec() };
        let frame = |of: &Vec<(String, Mapped, usize)>| of.iter().map(|(name, m, size)| (name.clone(), bytes(m, *size))).collect();
        self.results.iter().map(frame).collect()
    }
}

const EVERYTHING: (vk::PipelineStageFlags2, vk::AccessFlags2) = (
    vk::PipelineStageFlags2::ALL_COMMANDS,
    vk::AccessFlags2::from_raw(vk::AccessFlags2::MEMORY_READ.as_raw() | vk::AccessFlags2::MEMORY_WRITE.as_raw()),
);

/// # Safety
/// The command buffer is recording.
unsafe fn barrier(device: &ash::Device, cmd: vk::CommandBuffer) {
    let (stage, access) = EVERYTHING;
    let barrier = vk::MemoryBarrier2::default()
        .src_stage_mask(stage)
        .src_access_mask(access)
        .dst_stage_mask(stage | vk::PipelineStageFlags2::HOST)
        .dst_access_mask(access | vk::AccessFlags2::HOST_READ);
    // SAFETY: the command buffer is recording outside a render pass, on a device with synchronization2.
    unsafe { device.cmd_pipeline_barrier2(cmd, &vk::DependencyInfo::default().memory_barriers(&[barrier])) };
}

/// Brings images from one layout to another.
///
/// # Safety
/// The command buffer is recording, behind a barrier of everything; the images are live.
unsafe fn transition(
    device: &ash::Device,
    cmd: vk::CommandBuffer,
    images: &[vk::Image],
    from: vk::ImageLayout,
    to: vk::ImageLayout,
) {
    let (stage, access) = EVERYTHING;
    let barrier = |&image: &vk::Image| {
        vk::ImageMemoryBarrier2::default()
            .image(image)
            .subresource_range(whole())
            .src_stage_mask(stage)
            .src_access_mask(access)
            .dst_stage_mask(stage)
            .dst_access_mask(access)
            .old_layout(from)
            .new_layout(to)
    };
    let barriers: Vec<_> = images.iter().map(barrier).collect();
    // SAFETY: the command buffer is recording outside a render pass, and the images are live.
    unsafe { device.cmd_pipeline_barrier2(cmd, &vk::DependencyInfo::default().image_memory_barriers(&barriers)) };
}

impl Drop for Host {
    fn drop(&mut self) {
        let _queue = self.gpu.queue();
        let device = self.gpu.device();
        // SAFETY: ours; the device is idle.
        unsafe {
            let _ = device.device_wait_idle();
            self.slots.iter().for_each(|slot| device.destroy_fence(slot.1, None));
            device.destroy_command_pool(self.pool, None);
        }
    }
}
