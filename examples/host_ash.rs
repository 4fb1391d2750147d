//! An engine on plain `ash` that places its own barriers: Vulkan 1.1, no synchronization2, no executor.
//!
//! It allocates what the denoiser declares, walks the phases, and brackets its own lighting pass, here the upload of a synthetic noisy
//! frame. Prints a checksum of every denoised frame: `cargo run --no-default-features --features shaderc --example host_ash`.

use ash::vk;
use atrous::{Access, Binding, Config, Denoiser, Device, FrameContext, FrameParams, Phase, ResourceDecl, Shape, Tuning};
use atrous_synthetic as synthetic;

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// What was last done to a resource: that is all that a barrier needs to know.
type State = (vk::PipelineStageFlags, vk::AccessFlags, vk::ImageLayout);

const UNTOUCHED: State = (vk::PipelineStageFlags::TOP_OF_PIPE, vk::AccessFlags::empty(), vk::ImageLayout::UNDEFINED);
const COPIED_FROM: State =
    (vk::PipelineStageFlags::TRANSFER, vk::AccessFlags::TRANSFER_READ, vk::ImageLayout::TRANSFER_SRC_OPTIMAL);
const READ_BY_HOST: State = (vk::PipelineStageFlags::HOST, vk::AccessFlags::HOST_READ, vk::ImageLayout::UNDEFINED);

fn state(access: Access) -> State {
    let (stage, mask) = access.legacy_scope();
    (stage, mask, access.image().layout)
}

/// An image or a buffer of the engine.
#[derive(Default)]
struct Resource {
    image: vk::Image,
    view: vk::ImageView,
    buffer: vk::Buffer,
    memory: vk::DeviceMemory,
    state: State,
}

struct Engine {
    device: ash::Device,
    queue: vk::Queue,
    cmd: vk::CommandBuffer,
    staging: Resource,
    mapped: *mut u8,
    /// By `ResourceId`, then copy: two of a history, none of an input that the engine does not have.
    resources: Vec<Vec<Resource>>,
}

impl Engine {
    // README: begin
    /// One frame: the phases of the denoiser lie around the engine's own lighting pass.
    fn frame(&mut self, denoiser: &mut Denoiser, params: &FrameParams, input: &synthetic::Frame) -> Result<()> {
        let frame = denoiser.begin_frame(params, &Tuning::default())?;
        self.draw_guides(denoiser, input)?;
        self.denoise(denoiser, &frame, Phase::BeforeLighting)?;
        self.trace_paths(denoiser, input)?;
        self.denoise(denoiser, &frame, Phase::AfterLighting)
    }

    /// The passes of a phase, each behind the barriers that its declared uses ask for.
    fn denoise(&mut self, denoiser: &mut Denoiser, frame: &FrameContext, phase: Phase) -> Result<()> {
        for index in 0..denoiser.declaration().passes().len() {
            let declaration = denoiser.declaration();
            let pass = &declaration.passes()[index];
            if pass.phase != phase {
                continue;
            }
            let mut bindings = Vec::new();
            for u in &pass.uses {
                let copies = &mut self.resources[u.resource.0 as usize];
                bindings.push(match copies.get_mut(declaration.copy(u, frame)) {
                    Some(resource) => barrier(&self.device, self.cmd, resource, state(u.access), u.access.reads()),
                    None => Binding::Absent, // an optional input
                });
            }
            // SAFETY: every resource is in its declared layout now, and earlier writes are visible.
            unsafe { denoiser.record(self.cmd, frame, index, &bindings)? };
        }
        Ok(())
    }
    // README: end

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
        let id = denoiser.declaration().find(name).ok_or("no such resource")?.0 as usize;
        let (resource, layout) = (&mut self.resources[id][0], state(Access::Clear).2);
        barrier(&self.device, self.cmd, resource, state(Access::Clear), false);
        // SAFETY: this part of the staging buffer is this image's own, and the frame before is complete.
        unsafe {
            self.mapped.add(id * STAGING_EACH).copy_from_nonoverlapping(bytes.as_ptr(), bytes.len());
            let regions = [whole_image(id * STAGING_EACH)];
            self.device.cmd_copy_buffer_to_image(self.cmd, self.staging.buffer, resource.image, layout, &regions);
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
            let output = &mut self.resources[id.0 as usize][0];
            barrier(&self.device, self.cmd, output, COPIED_FROM, true);
            barrier(&self.device, self.cmd, &mut self.staging, state(Access::Clear), false);
            self.device.cmd_copy_image_to_buffer(self.cmd, output.image, COPIED_FROM.2, self.staging.buffer, &[whole_image(0)]);
            barrier(&self.device, self.cmd, &mut self.staging, READ_BY_HOST, true);
            self.device.end_command_buffer(self.cmd)?;
            self.device.queue_submit(self.queue, &[vk::SubmitInfo::default().command_buffers(&[self.cmd])], vk::Fence::null())?;
            self.device.queue_wait_idle(self.queue)?;
            Ok(std::slice::from_raw_parts(self.mapped, STAGING_EACH / 2).to_vec())
        }
    }
}

/// Bytes of the staging buffer for each resource: four floats a texel, which is what this engine's inputs have.
const STAGING_EACH: usize = (synthetic::EXTENT[0] * synthetic::EXTENT[1] * 16) as usize;

fn whole_image(offset: usize) -> vk::BufferImageCopy {
    let [width, height] = synthetic::EXTENT;
    let layers = vk::ImageSubresourceLayers::default().aspect_mask(vk::ImageAspectFlags::COLOR).layer_count(1);
    let copy = vk::BufferImageCopy::default().buffer_offset(offset as u64).image_subresource(layers);
    copy.image_extent(vk::Extent3D { width, height, depth: 1 })
}

fn whole() -> vk::ImageSubresourceRange {
    vk::ImageSubresourceRange::default().aspect_mask(vk::ImageAspectFlags::COLOR).level_count(1).layer_count(1)
}

/// Waits for what was last done to the resource, brings it to the next state, and says how to bind it.
fn barrier(device: &ash::Device, cmd: vk::CommandBuffer, resource: &mut Resource, next: State, keep: bool) -> Binding {
    let now = std::mem::replace(&mut resource.state, next);
    let (old_layout, none) = (if keep { now.2 } else { vk::ImageLayout::UNDEFINED }, vk::DependencyFlags::empty());
    if resource.image == vk::Image::null() {
        let barrier = vk::MemoryBarrier::default().src_access_mask(now.1).dst_access_mask(next.1);
        // SAFETY: the command buffer is recording.
        unsafe { device.cmd_pipeline_barrier(cmd, now.0, next.0, none, &[barrier], &[], &[]) };
        return Binding::Buffer { buffer: resource.buffer, offset: 0, range: vk::WHOLE_SIZE };
    }
    let barrier = vk::ImageMemoryBarrier::default().image(resource.image).subresource_range(whole());
    let barrier = barrier.src_access_mask(now.1).dst_access_mask(next.1).old_layout(old_layout).new_layout(next.2);
    // SAFETY: the command buffer is recording, the image is live.
    unsafe { device.cmd_pipeline_barrier(cmd, now.0, next.0, none, &[], &[], &[barrier]) };
    Binding::Image { view: resource.view, layout: next.2 }
}

/// One copy of a resource, with memory of its own. (An engine with a frame graph lets transients share.)
///
/// # Safety
/// The device is live.
unsafe fn create(host: Device<'_>, decl: &ResourceDecl, flags: vk::MemoryPropertyFlags) -> Result<Resource> {
    let (device, mut resource) = (host.device, Resource { state: UNTOUCHED, ..Resource::default() });
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
                resource.buffer = device.create_buffer(&info, None)?;
                resource.memory = allocate(device.get_buffer_memory_requirements(resource.buffer))?;
                device.bind_buffer_memory(resource.buffer, resource.memory, 0)?;
            }
            Shape::Image { format, .. } => {
                let [width, height] = decl.extent(synthetic::EXTENT).unwrap_or(synthetic::EXTENT);
                let is_float_input = synthetic::NAMES.contains(&decl.name.as_str());
                let format = if is_float_input { vk::Format::R32G32B32A32_SFLOAT } else { format.preferred() };
                let usage = decl.image_usage | vk::ImageUsageFlags::TRANSFER_DST | vk::ImageUsageFlags::TRANSFER_SRC;
                let info = vk::ImageCreateInfo::default().image_type(vk::ImageType::TYPE_2D).format(format).usage(usage);
                let info = info.extent(vk::Extent3D { width, height, depth: 1 }).mip_levels(1).array_layers(1);
                resource.image = device.create_image(&info.samples(vk::SampleCountFlags::TYPE_1), None)?;
                resource.memory = allocate(device.get_image_memory_requirements(resource.image))?;
                device.bind_image_memory(resource.image, resource.memory, 0)?;
                let info = vk::ImageViewCreateInfo::default().image(resource.image).view_type(vk::ImageViewType::TYPE_2D);
                resource.view = device.create_image_view(&info.format(format).subresource_range(whole()), None)?;
            }
        }
    }
    Ok(resource)
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
        let host = Device { instance, physical_device, device, pipeline_cache: vk::PipelineCache::null() };
        let info = vk::CommandPoolCreateInfo::default().queue_family_index(family);
        let pool = device.create_command_pool(&info.flags(vk::CommandPoolCreateFlags::RESET_COMMAND_BUFFER), None)?;
        let info = vk::CommandBufferAllocateInfo::default().command_pool(pool).command_buffer_count(1);
        let (queue, cmd) = (device.get_device_queue(family, 0), device.allocate_command_buffers(&info)?[0]);
        let mut denoiser = Denoiser::new(host, Config::new(synthetic::EXTENT).declare()?)?;
        let mut resources = Vec::new();
        for decl in denoiser.declaration().resources() {
            let is_input = decl.name == "surface_id" || synthetic::NAMES.contains(&decl.name.as_str());
            let copies = 0..if is_input { 1 } else { decl.lifetime.copies() };
            let copies: Result<_> = copies.map(|_| create(host, decl, vk::MemoryPropertyFlags::DEVICE_LOCAL)).collect();
            resources.push(copies?);
        }
        let staging = ResourceDecl {
            shape: Shape::Buffer { size: (resources.len() * STAGING_EACH) as u64 },
            buffer_usage: vk::BufferUsageFlags::TRANSFER_SRC | vk::BufferUsageFlags::TRANSFER_DST,
            ..denoiser.declaration().resources()[0].clone()
        };
        let staging = create(host, &staging, vk::MemoryPropertyFlags::HOST_VISIBLE | vk::MemoryPropertyFlags::HOST_COHERENT)?;
        let mapped = device.map_memory(staging.memory, 0, vk::WHOLE_SIZE, vk::MemoryMapFlags::empty())?.cast();
        let mut engine = Engine { device: device.clone(), queue, cmd, staging, mapped, resources };
        for index in 0..synthetic::FRAMES {
            println!("{}", synthetic::report(index, &engine.run(&mut denoiser, index)?));
        }
        drop(denoiser);
        for resource in engine.resources.iter().flatten().chain([&engine.staging]) {
            device.destroy_image_view(resource.view, None);
            device.destroy_image(resource.image, None);
            device.destroy_buffer(resource.buffer, None);
            device.free_memory(resource.memory, None);
        }
        device.destroy_command_pool(pool, None);
        device.destroy_device(None);
        instance.destroy_instance(None);
    }
    Ok(())
}
