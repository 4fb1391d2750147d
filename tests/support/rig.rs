//! An executor on command buffers of the test's own, with images for the inputs of the synthetic sequence.

use ash::vk;
use atrous::executor::{Executor, ExecutorOptions, HeadlessDevice, HostImage};
use atrous::{Config, Device, FrameContext, FrameParams, Lifetime, Phase, ResourceId, Shape, Subresource, Tuning};
use std::collections::BTreeMap;
use std::sync::Arc;

/// State of an input whenever a phase is recorded: as an upload leaves it.
pub const UPLOADED: (vk::PipelineStageFlags2, vk::AccessFlags2, vk::ImageLayout) =
    (vk::PipelineStageFlags2::ALL_TRANSFER, vk::AccessFlags2::TRANSFER_WRITE, vk::ImageLayout::TRANSFER_DST_OPTIMAL);

pub struct Rig {
    // Declared first, so that it is dropped first.
    pub executor: Executor,
    pub commands: Vec<vk::CommandBuffer>,
    /// Inputs by name.
    pub images: BTreeMap<String, vk::Image>,
    owned: Vec<vk::Image>,
    pub gpu: Arc<HeadlessDevice>,
    pool: vk::CommandPool,
    views: Vec<vk::ImageView>,
    buffers: Vec<vk::Buffer>,
    image_memory: Vec<vk::DeviceMemory>,
    buffer_memory: Vec<vk::DeviceMemory>,
}

impl Rig {
    /// Binds every input but `instance_transforms`, optional ones as well.
    pub fn new(gpu: Arc<HeadlessDevice>, config: &Config, commands: u32) -> Self {
        let options = ExecutorOptions { extra_image_usage: vk::ImageUsageFlags::TRANSFER_SRC, ..Default::default() };
        Self::with_options(gpu, config, commands, options)
    }

    pub fn with_options(gpu: Arc<HeadlessDevice>, config: &Config, commands: u32, options: ExecutorOptions) -> Self {
        Self::on(gpu.clone().host(), gpu, config, commands, options)
    }

    /// Has the executor on other functions of the device.
    pub fn on(host: Device<'_>, gpu: Arc<HeadlessDevice>, config: &Config, commands: u32, options: ExecutorOptions) -> Self {
        let device = gpu.device();
        // SAFETY: the device is live, has synchronization2, and outlives the executor and the pool.
        let (executor, pool, commands) = unsafe {
            let info = vk::CommandPoolCreateInfo::default()
                .queue_family_index(gpu.queue_family())
                .flags(vk::CommandPoolCreateFlags::RESET_COMMAND_BUFFER);
            let pool = device.create_command_pool(&info, None).expect("pool");
            let info = vk::CommandBufferAllocateInfo::default().command_pool(pool).command_buffer_count(commands);
            let commands = device.allocate_command_buffers(&info).expect("command buffers");
            (Executor::new(host, config.declare().expect("valid"), options).expect("executor"), pool, commands)
        };
        let (views, buffers) = (Vec::new(), Vec::new());
        let mut rig = Self {
            executor,
            commands,
            images: BTreeMap::new(),
            owned: Vec::new(),
            gpu,
            pool,
            views,
            buffers,
            image_memory: Vec::new(),
            buffer_memory: Vec::new(),
        };
        rig.bind_inputs();
        rig
    }

    fn bind_inputs(&mut self) {
        let declaration = self.executor.denoiser().declaration().clone();
        for id in (0..declaration.resources().len() as u32).map(ResourceId) {
            let decl = declaration.resource(id);
            let (Shape::Image { format, .. }, Lifetime::Input { .. }) = (decl.shape, decl.lifetime) else { continue };
            let extent = decl.extent(declaration.setup()).expect("an image");
            let wide = vk::Format::R32G32B32A32_SFLOAT;
            let format = if format.accepts(wide) { wide } else { format.preferred() };
            let aspect = vk::ImageAspectFlags::COLOR;
            let usage = decl.image_usage | vk::ImageUsageFlags::TRANSFER_DST | vk::ImageUsageFlags::TRANSFER_SRC;
            let image = self.image(&decl.name, format, extent, aspect, usage);
            self.executor.bind_image(&decl.name, image).expect(&decl.name);
        }
    }

    /// Light of every pixel after [`Self::fill_inputs`].
    pub const LIGHT: f32 = 0.5;

    /// Fills every input with one value: a lit wall that does not move.
    pub fn fill_inputs(&mut self) {
        let images = self.images.clone();
        self.submit(|rig, cmd| {
            for (name, image) in images {
                let colour = match name.as_str() {
                    "surface_id" => vk::ClearColorValue { uint32: [1; 4] },
                    "depth" | "scattering_depth" => vk::ClearColorValue { float32: [5.0; 4] },
                    "normal" | "object_normal" => vk::ClearColorValue { float32: [0.0, 0.0, 1.0, 0.0] },
                    "motion" | "forward_motion" | "emission" | "sparse_gradient" => vk::ClearColorValue { float32: [0.0; 4] },
                    _ => vk::ClearColorValue { float32: [Self::LIGHT; 4] },
                };
                let (stage, access, layout) = UPLOADED;
                let barrier = vk::ImageMemoryBarrier2::default()
                    .image(image)
                    .subresource_range(whole())
                    .dst_stage_mask(stage)
                    .dst_access_mask(access)
                    .new_layout(layout);
                let device = rig.gpu.device();
                // SAFETY: the command buffer is recording; the image is live, and brought to the layout named.
                unsafe {
                    device.cmd_pipeline_barrier2(cmd, &vk::DependencyInfo::default().image_memory_barriers(&[barrier]));
                    device.cmd_clear_color_image(cmd, image, layout, &colour, &[whole()]);
                }
            }
        });
    }

    /// Records a whole frame; every submission before was waited for.
    pub fn record(&mut self, cmd: vk::CommandBuffer, frame: &FrameContext) {
        for phase in Phase::ALL {
            // SAFETY: the command buffer is recording, and everything that was recorded before is complete.
            unsafe { self.executor.record(cmd, frame, phase) }.expect("recorded");
        }
    }

    /// Runs a whole frame.
    pub fn frame(&mut self, params: &FrameParams) {
        let frame = self.executor.begin_frame(params, &Tuning::default()).expect("a frame");
        self.submit(|rig, cmd| rig.record(cmd, &frame));
    }

    /// Another extent, with new inputs.
    pub fn resize(&mut self, extent: [u32; 2]) {
        // SAFETY: every submission was waited for.
        unsafe {
            self.executor.resize(extent).expect("another extent");
            self.destroy_inputs();
        }
        self.bind_inputs();
        self.fill_inputs();
    }

    /// An image that lives as long as the rig, with a view of one aspect.
    pub fn image(
        &mut self,
        name: &str,
        format: vk::Format,
        extent: [u32; 2],
        aspect: vk::ImageAspectFlags,
        usage: vk::ImageUsageFlags,
    ) -> HostImage {
        self.image_at(name, format, extent, aspect, usage, Subresource::default())
    }

    /// The last layer and mip level of an image that has others as well, which stay undefined.
    pub fn image_at(
        &mut self,
        name: &str,
        format: vk::Format,
        extent: [u32; 2],
        aspect: vk::ImageAspectFlags,
        usage: vk::ImageUsageFlags,
        subresource: Subresource,
    ) -> HostImage {
        let gpu = self.gpu.clone();
        let Subresource { layer, level } = subresource;
        let info = plain_image(format, extent.map(|side| side << level), usage).array_layers(layer + 1).mip_levels(level + 1);
        // SAFETY: the device is live; what is made here is destroyed with the rig.
        let (image, view) = unsafe {
            let image = gpu.device().create_image(&info, None).expect("image");
            let memory = self.allocate(gpu.device().get_image_memory_requirements(image), vk::MemoryPropertyFlags::empty());
            self.image_memory.push(memory);
            gpu.device().bind_image_memory(image, memory, 0).expect("memory");
            let info = vk::ImageViewCreateInfo::default().image(image).view_type(vk::ImageViewType::TYPE_2D).format(format);
            let range =
                vk::ImageSubresourceRange { aspect_mask: aspect, base_array_layer: layer, base_mip_level: level, ..whole() };
            (image, gpu.device().create_image_view(&info.subresource_range(range), None).expect("view"))
        };
        self.images.insert(name.to_owned(), image);
        self.owned.push(image);
        self.views.push(view);
        let (stage, access, layout) = UPLOADED;
        HostImage { image, view, subresource, format, extent, layout, stage, access }
    }

    /// The layers of one image.
    pub fn layers(&mut self, format: vk::Format, extent: [u32; 2], usage: vk::ImageUsageFlags, count: u32) -> Vec<HostImage> {
        let last = Subresource { layer: count - 1, level: 0 };
        let image = self.image_at("layers", format, extent, vk::ImageAspectFlags::COLOR, usage, last);
        let mut layer = |layer: u32| {
            let info = vk::ImageViewCreateInfo::default().image(image.image).view_type(vk::ImageViewType::TYPE_2D).format(format);
            let info = info.subresource_range(vk::ImageSubresourceRange { base_array_layer: layer, ..whole() });
            // SAFETY: the device and the image are live; the view is destroyed with the rig.
            let view = unsafe { self.gpu.device().create_image_view(&info, None) }.expect("view");
            self.views.push(view);
            HostImage { view, subresource: Subresource { layer, level: 0 }, ..image }
        };
        (0..count).map(&mut layer).collect()
    }

    /// Records into the first command buffer, submits it, and waits.
    pub fn submit(&mut self, record: impl FnOnce(&mut Self, vk::CommandBuffer)) {
        let gpu = self.gpu.clone();
        let (device, cmd) = (gpu.device(), self.commands[0]);
        // SAFETY: the command buffer is idle, since each submission is waited for; everything it names lives as long as the rig.
        unsafe {
            device.begin_command_buffer(cmd, &vk::CommandBufferBeginInfo::default()).expect("begin");
            record(self, cmd);
            device.end_command_buffer(cmd).expect("end");
            let queue = gpu.queue();
            let commands = [cmd];
            device
                .queue_submit(*queue, &[vk::SubmitInfo::default().command_buffers(&commands)], vk::Fence::null())
                .expect("submit");
            device.queue_wait_idle(*queue).expect("wait");
        }
    }

    /// A mapped buffer that copies read and write.
    pub fn staging(&mut self, size: usize) -> (vk::Buffer, *mut u8) {
        self.buffer(size, vk::BufferUsageFlags::TRANSFER_SRC | vk::BufferUsageFlags::TRANSFER_DST)
    }

    /// A mapped buffer.
    pub fn buffer(&mut self, size: usize, usage: vk::BufferUsageFlags) -> (vk::Buffer, *mut u8) {
        let gpu = self.gpu.clone();
        // SAFETY: the device is live; the buffer and its memory are destroyed with the rig.
        unsafe {
            let info = vk::BufferCreateInfo::default().size(size as u64).usage(usage);
            let buffer = gpu.device().create_buffer(&info, None).expect("buffer");
            let visible = vk::MemoryPropertyFlags::HOST_VISIBLE | vk::MemoryPropertyFlags::HOST_COHERENT;
            let memory = self.allocate(gpu.device().get_buffer_memory_requirements(buffer), visible);
            self.buffer_memory.push(memory);
            gpu.device().bind_buffer_memory(buffer, memory, 0).expect("memory");
            self.buffers.push(buffer);
            let mapped = gpu.device().map_memory(memory, 0, vk::WHOLE_SIZE, vk::MemoryMapFlags::empty()).expect("mapped");
            (buffer, mapped.cast())
        }
    }

    fn allocate(&self, needs: vk::MemoryRequirements, flags: vk::MemoryPropertyFlags) -> vk::DeviceMemory {
        let host = self.gpu.host();
        // SAFETY: the handles are live and belong together.
        let types = unsafe { host.instance.get_physical_device_memory_properties(host.physical_device) };
        let fits = |i: &u32| needs.memory_type_bits >> i & 1 == 1 && types.memory_types[*i as usize].property_flags.contains(flags);
        let index = (0..types.memory_type_count).find(fits).expect("a type of memory");
        let info = vk::MemoryAllocateInfo::default().allocation_size(needs.size).memory_type_index(index);
        // SAFETY: the device is live; who asks for the memory notes it, and it is freed with the rig.
        unsafe { host.device.allocate_memory(&info, None) }.expect("memory")
    }

    /// Destroys the inputs.
    ///
    /// # Safety
    /// The device does not use them.
    unsafe fn destroy_inputs(&mut self) {
        let device = self.gpu.device();
        // SAFETY: ours, and not in use.
        unsafe {
            self.views.drain(..).for_each(|view| device.destroy_image_view(view, None));
            self.owned.drain(..).for_each(|image| device.destroy_image(image, None));
            self.image_memory.drain(..).for_each(|memory| device.free_memory(memory, None));
        }
    }
}

impl Drop for Rig {
    fn drop(&mut self) {
        let gpu = self.gpu.clone();
        let _queue = gpu.queue();
        let device = gpu.device();
        // SAFETY: ours; the device is idle.
        unsafe {
            let _ = device.device_wait_idle();
            self.destroy_inputs();
            self.buffers.iter().for_each(|&buffer| device.destroy_buffer(buffer, None));
            self.buffer_memory.iter().for_each(|&memory| device.free_memory(memory, None));
            device.destroy_command_pool(self.pool, None);
        }
    }
}

/// An image of one mip level and one layer.
pub fn plain_image(format: vk::Format, [width, height]: [u32; 2], usage: vk::ImageUsageFlags) -> vk::ImageCreateInfo<'static> {
    vk::ImageCreateInfo::default()
        .image_type(vk::ImageType::TYPE_2D)
        .format(format)
        .extent(vk::Extent3D { width, height, depth: 1 })
        .mip_levels(1)
        .array_layers(1)
        .samples(vk::SampleCountFlags::TYPE_1)
        .usage(usage)
}

/// Every image here has one mip level and one layer.
pub fn whole() -> vk::ImageSubresourceRange {
    vk::ImageSubresourceRange::default().aspect_mask(vk::ImageAspectFlags::COLOR).level_count(1).layer_count(1)
}
