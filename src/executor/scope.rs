//! The last access to an image or buffer, as one side of a barrier.

use crate::contract::Access;
use ash::vk;

/// The last access to an image or buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Scope {
    pub stage: vk::PipelineStageFlags2,
    pub access: vk::AccessFlags2,
    pub layout: vk::ImageLayout,
}

impl Scope {
    /// No access yet.
    pub const NONE: Self =
        Self { stage: vk::PipelineStageFlags2::NONE, access: vk::AccessFlags2::NONE, layout: vk::ImageLayout::UNDEFINED };

    pub fn of(access: Access) -> Self {
        let image = access.image();
        Self { stage: image.stage, access: image.access, layout: image.layout }
    }

    /// Copies out of it, for tools and tests.
    pub const COPY_SOURCE: Self = Self {
        stage: vk::PipelineStageFlags2::ALL_TRANSFER,
        access: vk::AccessFlags2::TRANSFER_READ,
        layout: vk::ImageLayout::TRANSFER_SRC_OPTIMAL,
    };

    pub fn writes(&self) -> bool {
        let writes = vk::AccessFlags2::SHADER_STORAGE_WRITE
            | vk::AccessFlags2::SHADER_WRITE
            | vk::AccessFlags2::TRANSFER_WRITE
            | vk::AccessFlags2::MEMORY_WRITE
            | vk::AccessFlags2::COLOR_ATTACHMENT_WRITE
            | vk::AccessFlags2::DEPTH_STENCIL_ATTACHMENT_WRITE;
        self.access.intersects(writes)
    }

    pub fn merge(&mut self, other: &Self) {
        self.stage |= other.stage;
        self.access |= other.access;
    }
}
