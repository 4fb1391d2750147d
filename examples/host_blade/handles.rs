
// Added for atrous, at the end of src/vulkan/mod.rs: blade-graphics 0.9 keeps its Vulkan handles to itself.
impl Context {
    /// Instance, physical device and device.
    pub fn vulkan_device(&self) -> (&ash::Instance, vk::PhysicalDevice, &ash::Device) {
        (&self.inner.instance.core, self.physical_device, &self.device.core)
    }
}

impl Texture {
    /// The image.
    pub fn vulkan_image(&self) -> vk::Image {
        self.raw
    }
}

impl TextureView {
    /// The view.
    pub fn vulkan_view(&self) -> vk::ImageView {
        self.raw
    }
}

impl CommandEncoder {
    /// The command buffer that is recorded now.
    pub fn vulkan_command_buffer(&self) -> vk::CommandBuffer {
        self.buffers[0].raw
    }
}
