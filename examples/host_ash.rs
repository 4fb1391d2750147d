//! An engine on plain `ash` that places its own barriers: Vulkan 1.1, no synchronization2, no executor.
//!
//! It allocates what the denoiser declares, walks the phases, and brackets its own lighting pass, here the upload of a synthetic noisy
//! frame. Prints a checksum of every denoised frame: `cargo run --no-default-features --features shaderc --example host_ash`.

use ash::vk;
use atrous::{
    Access, Binding, Config, Denoiser, Device, FrameContext, FrameParams, LegacyBarriers, Phase, PhysicalResource, ResourceDecl,
    ResourceId, ResourceState, Setup, Shape, Tracker, Tuning,
};
use atrous_synthetic as synthetic;

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// An image or a buffer of the engine.
struct Resource {
    physical: PhysicalResource,
    memory: vk::DeviceMemory,
}

struct Engine {
    device: ash::Device,
    queue: vk::Queue,
    cmd: vk::CommandBuffer,
    staging: vk::Buffer,
    mapped: *mut u8,
    /// By `ResourceId`, then copy: two of a history, none of an input that the engine does not have.
    resources: Vec<Vec<Resource>>,
    // glue: begin
    tracker: Tracker,
    /// Kept from pass to pass.
    barriers: LegacyBarriers,
    bindings: Vec<Binding>,
    // glue: end
}

impl Engine {
    /// One frame: the phases of the denoiser lie around the engine's own lighting pass.
    fn frame(&mut self, denoiser: &mut Denoiser, params: &FrameParams, input: &synthetic::Frame) -> Result<()> {
        let frame = denoiser.begin_frame(params, &Tuning::default())?;
        self.draw_guides(denoiser, input)?;
        self.denoise(denoiser, &frame, Phase::BeforeLighting)?;
        self.trace_paths(denoiser, input)?;
        self.denoise(denoiser, &frame, Phase::AfterLighting)
    }

    // glue: begin
    // README: begin
    /// The passes of a phase, each behind the barriers that its declared uses ask for.
    fn denoise(&mut self, denoiser: &Denoiser, frame: &FrameContext, phase: Phase) -> Result<()> {
        let physical = |id: ResourceId, copy: usize| Some(self.resources[id.0 as usize].get(copy)?.physical);
        for pass in denoiser.declaration().passes_of(phase) {
            self.barriers.set(self.tracker.barriers(pass, frame), physical);
            self.record_barriers();
            self.tracker.bindings(pass, frame, physical, &mut self.bindings);
            // SAFETY: the barriers bring every resource to its declared layout and make earlier writes visible.
            unsafe { denoiser.record(self.cmd, frame, pass, &self.bindings)? };
        }
        Ok(())
    }
    // README: end

    // docs: begin
    /// The image of an input or an output, behind the barrier before a use of the engine's own.
    fn access(&mut self, id: ResourceId, next: ResourceState, discard: bool) -> Result<vk::Image> {
        let resource = &self.resources[id.0 as usize][0];
        self.barriers.set(self.tracker.access(id, 0, next, discard), |_, _| Some(resource.physical));
        self.record_barriers();
        let PhysicalResource::Image { image, .. } = resource.physical else { return Err("not an image".into()) };
        Ok(image)
    }

    fn record_barriers(&self) {
        let (b, none) = (&self.barriers, vk::DependencyFlags::empty());
        if !b.is_empty() {
            // SAFETY: the command buffer is recording outside a render pass; everything is live, and as the tracker says.
            unsafe { self.device.cmd_pipeline_barrier(self.cmd, b.src_stage, b.dst_stage, none, &b.memory, &b.buffers, &b.images) };
        }
    }
    // docs: end
    // glue: end

    /// A G-buffer pass would stand here.
    fn draw_guides(&mut self, denoiser: &Denoiser, input: &synthetic::Frame) -> Result<()> {
        for (name, texels) in synthetic::NAMES.iter().zip(&input.images).take(4) {
            self.upload(denoiser, name, &synthetic::bytes(texels))?;
        }
        let ids: Vec<u8> = input.surface_id.iter().flat_map(|id| id.to_le_bytes()).collect();
        self.upload(denoiser, "surface_id", &ids)
    }

    /// Light transport would stand here.
    fn trace_paths(&mut self, denoiser: &Denoiser, input: &synthetic::Frame) -> Result<()> {
        self.upload(denoiser, "noisy_radiance", &synthetic::bytes(&input.images[4]))
    }

    fn upload(&mut self, denoiser: &Denoiser, name: &str, bytes: &[u8]) -> Result<()> {
        let id = denoiser.declaration().find(name).ok_or("no such resource")?;
        let (offset, target) = (id.0 as usize * STAGING_EACH, self.access(id, Access::Clear.into(), true)?);
        // SAFETY: this part of the staging buffer is this image's own, and the frame before is complete.
        unsafe {
            self.mapped.add(offset).copy_from_nonoverlapping(bytes.as_ptr(), bytes.len());
            let (regions, layout) = ([whole_image(offset)], vk::ImageLayout::TRANSFER_DST_OPTIMAL);
            self.device.cmd_copy_buffer_to_image(self.cmd, self.staging, target, layout, &regions);
        }
        Ok(())
    }

    /// Records a frame, runs it, and returns the denoised texels.
    fn run(&mut self, denoiser: &mut Denoiser, index: u32) -> Result<Vec<u8>> {
        let (view_from_world, clip_from_view) = (synthetic::view_from_world(index), synthetic::clip_from_view());
        let params = FrameParams { frame_slot: index % 2, view_from_world, clip_from_view, ..FrameParams::new(synthetic::EXTENT) };
        // SAFETY: everything is ours and live, and the GPU is idle before and after.
        unsafe {
            self.device.begin_command_buffer(self.cmd, &vk::CommandBufferBeginInfo::default())?;
            self.frame(denoiser, &params, &synthetic::Frame::new(index))?;
            let id = denoiser.declaration().find("denoised_radiance").ok_or("no output")?;
            let (output, layout) = (self.access(id, ResourceState::COPY_SOURCE, false)?, ResourceState::COPY_SOURCE.layout);
            let offset = self.resources.len() * STAGING_EACH;
            self.device.cmd_copy_image_to_buffer(self.cmd, output, layout, self.staging, &[whole_image(offset)]);
            let copied = vk::MemoryBarrier::default().src_access_mask(vk::AccessFlags::TRANSFER_WRITE);
            let read = [copied.dst_access_mask(vk::AccessFlags::HOST_READ)];
            let (stages, none) = ([vk::PipelineStageFlags::TRANSFER, vk::PipelineStageFlags::HOST], vk::DependencyFlags::empty());
            self.device.cmd_pipeline_barrier(self.cmd, stages[0], stages[1], none, &read, &[], &[]);
            self.device.end_command_buffer(self.cmd)?;
            self.device.queue_submit(self.queue, &[vk::SubmitInfo::default().command_buffers(&[self.cmd])], vk::Fence::null())?;
            self.device.queue_wait_idle(self.queue)?;
            Ok(std::slice::from_raw_parts(self.mapped.add(offset), STAGING_EACH / 2).to_vec())
        }
    }
}

/// Bytes of the staging buffer for each resource, and for the result: four floats a texel, which is what this engine's inputs have.
const STAGING_EACH: usize = (synthetic::EXTENT[0] * synthetic::EXTENT[1] * 16) as usize;

fn whole_image(offset: usize) -> vk::BufferImageCopy {
    let [width, height] = synthetic::EXTENT;
    let layers = vk::ImageSubresourceLayers::default().aspect_mask(vk::ImageAspectFlags::COLOR).layer_count(1);
    let copy = vk::BufferImageCopy::default().buffer_offset(offset as u64).image_subresource(layers);
    copy.image_extent(vk::Extent3D { width, height, depth: 1 })
}

/// One copy of a resource, with memory of its own. (An engine with a frame graph lets transients share.)
///
/// # Safety
/// The device is live.
unsafe fn create(host: Device<'_>, decl: &ResourceDecl, flags: vk::MemoryPropertyFlags) -> Result<Resource> {
    let device = host.device;
    // SAFETY: the device is live; every object is created on it, and bound to memory of its own requirements.
    unsafe {
        let types = host.instance.get_physical_device_memory_properties(host.physical_device);
        let allocate = |needs: vk::MemoryRequirements| -> Result<_> {
            let fits =
                |i: &u32| needs.memory_type_bits >> i & 1 == 1 && types.memory_types[*i as usize].property_flags.contains(flags);
            let index = (0..types.memory_type_count).find(fits).ok_or("no memory of this type")?;
            let info = vk::MemoryAllocateInfo::default().allocation_size(needs.size).memory_type_index(index);
            Ok(device.allocate_memory(&info, None)?)
        };
        match decl.shape {
            Shape::Buffer { size } => {
                let info = vk::BufferCreateInfo::default().size(size).usage(decl.buffer_usage);
                let buffer = device.create_buffer(&info, None)?;
                let memory = allocate(device.get_buffer_memory_requirements(buffer))?;
                device.bind_buffer_memory(buffer, memory, 0)?;
                Ok(Resource { physical: PhysicalResource::buffer(buffer), memory })
            }
            Shape::Image { format, .. } => {
                let [width, height] = decl.extent(&Setup::new(synthetic::EXTENT)).unwrap_or(synthetic::EXTENT);
                let is_float_input = synthetic::NAMES.contains(&decl.name.as_str());
                let format = if is_float_input { vk::Format::R32G32B32A32_SFLOAT } else { format.preferred() };
                let usage = decl.image_usage | vk::ImageUsageFlags::TRANSFER_DST | vk::ImageUsageFlags::TRANSFER_SRC;
                let info = vk::ImageCreateInfo::default().image_type(vk::ImageType::TYPE_2D).format(format).usage(usage);
                let info = info.extent(vk::Extent3D { width, height, depth: 1 }).mip_levels(1).array_layers(1);
                let image = device.create_image(&info.samples(vk::SampleCountFlags::TYPE_1), None)?;
                let memory = allocate(device.get_image_memory_requirements(image))?;
                device.bind_image_memory(image, memory, 0)?;
                let info = vk::ImageViewCreateInfo::default().image(image).view_type(vk::ImageViewType::TYPE_2D);
                let range = vk::ImageSubresourceRange::default().aspect_mask(vk::ImageAspectFlags::COLOR);
                let info = info.format(format).subresource_range(range.level_count(1).layer_count(1));
                Ok(Resource { physical: PhysicalResource::color(image, device.create_image_view(&info, None)?), memory })
            }
        }
    }
}

/// Runs the sequence and prints a checksum of every frame.
fn main() -> Result<()> {
    // SAFETY: every pointer lives until its call returns; handles are live, and what is destroyed is idle.
    unsafe {
        let entry = ash::Entry::load()?;
        let application = vk::ApplicationInfo::default().api_version(vk::API_VERSION_1_1);
        let instance = &entry.create_instance(&vk::InstanceCreateInfo::default().application_info(&application), None)?;
        let physical_device = instance.enumerate_physical_devices()?.first().copied().ok_or("no Vulkan device")?;
        let families = instance.get_physical_device_queue_family_properties(physical_device);
        let family = families.iter().position(|f| f.queue_flags.contains(vk::QueueFlags::COMPUTE)).ok_or("no queue")? as u32;
        let queues = [vk::DeviceQueueCreateInfo::default().queue_family_index(family).queue_priorities(&[1.0])];
        let device =
            &instance.create_device(physical_device, &vk::DeviceCreateInfo::default().queue_create_infos(&queues), None)?;
        let host = Device { instance, physical_device, device, pipeline_cache: vk::PipelineCache::null(), pipelines: None };
        let info = vk::CommandPoolCreateInfo::default().queue_family_index(family);
        let pool = device.create_command_pool(&info.flags(vk::CommandPoolCreateFlags::RESET_COMMAND_BUFFER), None)?;
        let info = vk::CommandBufferAllocateInfo::default().command_pool(pool).command_buffer_count(1);
        let (queue, cmd) = (device.get_device_queue(family, 0), device.allocate_command_buffers(&info)?[0]);
        let mut denoiser = Denoiser::new(host, Config::new(synthetic::EXTENT).declare()?)?;
        // glue: begin
        let mut resources = Vec::new();
        for decl in denoiser.declaration().resources() {
            let is_input = decl.name == "surface_id" || synthetic::NAMES.contains(&decl.name.as_str());
            let copies = 0..if is_input { 1 } else { decl.lifetime.copies() };
            let copies: Result<_> = copies.map(|_| create(host, decl, vk::MemoryPropertyFlags::DEVICE_LOCAL)).collect();
            resources.push(copies?);
        }
        // glue: end
        let staged = ResourceDecl {
            shape: Shape::Buffer { size: ((resources.len() + 1) * STAGING_EACH) as u64 },
            buffer_usage: vk::BufferUsageFlags::TRANSFER_SRC | vk::BufferUsageFlags::TRANSFER_DST,
            ..denoiser.declaration().resources()[0].clone()
        };
        let staged = create(host, &staged, vk::MemoryPropertyFlags::HOST_VISIBLE | vk::MemoryPropertyFlags::HOST_COHERENT)?;
        let PhysicalResource::Buffer { buffer: staging, .. } = staged.physical else { return Err("no buffer".into()) };
        let mapped = device.map_memory(staged.memory, 0, vk::WHOLE_SIZE, vk::MemoryMapFlags::empty())?.cast();
        // glue: begin
        let (tracker, barriers, bindings) = (Tracker::new(denoiser.declaration()), LegacyBarriers::default(), Vec::new());
        // glue: end
        let mut engine = Engine { device: device.clone(), queue, cmd, staging, mapped, resources, tracker, barriers, bindings };
        for index in 0..synthetic::FRAMES {
            println!("{}", synthetic::report(index, &engine.run(&mut denoiser, index)?));
        }
        drop(denoiser);
        for resource in engine.resources.iter().flatten().chain([&staged]) {
            match resource.physical {
                PhysicalResource::Image { image, view, .. } => {
                    device.destroy_image_view(view, None);
                    device.destroy_image(image, None);
                }
                PhysicalResource::Buffer { buffer, .. } => device.destroy_buffer(buffer, None),
            }
            device.free_memory(resource.memory, None);
        }
        device.destroy_command_pool(pool, None);
        device.destroy_device(None);
        instance.destroy_instance(None);
    }
    Ok(())
}
