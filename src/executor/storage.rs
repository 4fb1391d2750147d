//! One physical image or buffer, and what was last done to it.

use super::barriers::Scope;
use super::HostImage;
use crate::contract::{component_of, Component};
use ash::vk;

/// One physical image or buffer with what was last done to it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Storage {
    pub image: vk::Image,
    pub view: vk::ImageView,
    pub buffer: vk::Buffer,
    pub size: u64,
    pub format: vk::Format,
    pub extent: [u32; 2],
    pub is_uint: bool,
    pub scope: Scope,
    /// State that a host's image or buffer is brought back to; `None` for our own.
    pub home: Option<Scope>,
    /// Whether a barrier changed its state since it was handed back.
    pub touched: bool,
}

impl Storage {
    pub const EMPTY: Self = Self {
        image: vk::Image::null(),
        view: vk::ImageView::null(),
        buffer: vk::Buffer::null(),
        size: 0,
        format: vk::Format::UNDEFINED,
        extent: [0; 2],
        is_uint: false,
        scope: Scope::NONE,
        home: None,
        touched: false,
    };

    pub fn of_host_image(host: &HostImage) -> Self {
        let home = Scope { stage: host.stage, access: host.access, layout: host.layout };
        let &HostImage { image, view, format, extent, .. } = host;
        let is_uint = component_of(format) == Some(Component::Uint);
        Self { image, view, format, extent, is_uint, scope: home, home: Some(home), ..Self::EMPTY }
    }

    /// Barriers name every aspect of a depth image.
    pub fn aspect(&self) -> vk::ImageAspectFlags {
        match self.format {
            vk::Format::D16_UNORM | vk::Format::D32_SFLOAT | vk::Format::X8_D24_UNORM_PACK32 => vk::ImageAspectFlags::DEPTH,
            vk::Format::D24_UNORM_S8_UINT | vk::Format::D32_SFLOAT_S8_UINT => {
                vk::ImageAspectFlags::DEPTH | vk::ImageAspectFlags::STENCIL
            }
            _ => vk::ImageAspectFlags::COLOR,
        }
    }

    pub fn of_host_buffer(buffer: vk::Buffer, size: u64, home: Scope) -> Self {
        Self { buffer, size, scope: home, home: Some(home), ..Self::EMPTY }
    }
}
