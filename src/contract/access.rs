//! Accesses of a pass to a resource. All synchronisation parameters of Vulkan follow from them.

use crate::shaders::{BindingAccess, BindingKind};
use ash::vk;

/// The access of a pass to a resource.
///
/// Closed and small on purpose, so that you can map it onto your own vocabulary. Stage, access
/// mask, layout, usage flags and descriptor type follow from it, so a declaration cannot contradict
/// itself. You may match every one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(u32)]
pub enum Access {
    /// Image read by `texelFetch` from a sampled image (no sampler), in a compute shader.
    Sampled = 0,
    /// Storage image or buffer that is only read.
    StorageRead = 1,
    /// Storage image or buffer. **Every** texel of the render rect is written and none is read, so
    /// you may discard the old content.
    StorageWrite = 2,
    /// Storage image or buffer that is read and written, or written in part only.
    StorageReadWrite = 3,
    /// Uniform buffer.
    Uniform = 4,
    /// Filled or updated by a transfer command. You may discard the old content.
    Clear = 5,
}

impl Access {
    /// The access to the resource at a binding of a shader.
    pub(crate) const fn of(kind: BindingKind) -> Self {
        match kind {
            BindingKind::SampledImage(_) => Self::Sampled,
            BindingKind::UniformBuffer => Self::Uniform,
            BindingKind::StorageImage(_, access) | BindingKind::StorageBuffer(access) => match access {
                BindingAccess::ReadOnly => Self::StorageRead,
                BindingAccess::WriteOnly => Self::StorageWrite,
                BindingAccess::ReadWrite => Self::StorageReadWrite,
            },
        }
    }
}

/// The synchronization2 scope and the layout of an image access.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ImageAccess {
    /// Pipeline stage.
    pub stage: vk::PipelineStageFlags2,
    /// Access mask.
    pub access: vk::AccessFlags2,
    /// The declared layout. `GENERAL` is always legal instead.
    pub layout: vk::ImageLayout,
}

/// The synchronization2 scope of a buffer access.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BufferAccess {
    /// Pipeline stage.
    pub stage: vk::PipelineStageFlags2,
    /// Access mask.
    pub access: vk::AccessFlags2,
}

impl Access {
    /// Every access, in the order of its values.
    pub const ALL: [Self; 6] =
        [Self::Sampled, Self::StorageRead, Self::StorageWrite, Self::StorageReadWrite, Self::Uniform, Self::Clear];

    /// Stage and access mask. `Clear` derives `ALL_TRANSFER`, since validation layers disagree on `CLEAR` and `COPY` for fills and
    /// updates.
    pub const fn scope(self) -> BufferAccess {
        use vk::{AccessFlags2 as A, PipelineStageFlags2 as S};
        let (stage, access) = match self {
            Self::Sampled => (S::COMPUTE_SHADER, A::SHADER_SAMPLED_READ),
            Self::StorageRead => (S::COMPUTE_SHADER, A::SHADER_STORAGE_READ),
            Self::StorageWrite => (S::COMPUTE_SHADER, A::SHADER_STORAGE_WRITE),
            Self::StorageReadWrite => {
                (S::COMPUTE_SHADER, A::from_raw(A::SHADER_STORAGE_READ.as_raw() | A::SHADER_STORAGE_WRITE.as_raw()))
            }
            Self::Uniform => (S::COMPUTE_SHADER, A::UNIFORM_READ),
            Self::Clear => (S::ALL_TRANSFER, A::TRANSFER_WRITE),
        };
        BufferAccess { stage, access }
    }

    /// Stage, access mask and layout for an image.
    pub const fn image(self) -> ImageAccess {
        let layout = match self {
            Self::Sampled => vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL,
            Self::Clear => vk::ImageLayout::TRANSFER_DST_OPTIMAL,
            _ => vk::ImageLayout::GENERAL,
        };
        let BufferAccess { stage, access } = self.scope();
        ImageAccess { stage, access, layout }
    }

    /// Stage and access mask for `vkCmdPipelineBarrier`, on devices without synchronization2.
    pub const fn legacy_scope(self) -> (vk::PipelineStageFlags, vk::AccessFlags) {
        use vk::{AccessFlags as A, PipelineStageFlags as S};
        match self {
            Self::Sampled | Self::StorageRead => (S::COMPUTE_SHADER, A::SHADER_READ),
            Self::StorageWrite => (S::COMPUTE_SHADER, A::SHADER_WRITE),
            Self::StorageReadWrite => (S::COMPUTE_SHADER, A::from_raw(A::SHADER_READ.as_raw() | A::SHADER_WRITE.as_raw())),
            Self::Uniform => (S::COMPUTE_SHADER, A::UNIFORM_READ),
            Self::Clear => (S::TRANSFER, A::TRANSFER_WRITE),
        }
    }

    /// Whether the old content matters. `false`: you may transition from `UNDEFINED`.
    pub const fn reads(self) -> bool {
        !matches!(self, Self::StorageWrite | Self::Clear)
    }

    /// Whether the content changes.
    pub const fn writes(self) -> bool {
        matches!(self, Self::StorageWrite | Self::StorageReadWrite | Self::Clear)
    }

    /// The usage flag that an image needs for this access.
    pub const fn image_usage(self) -> vk::ImageUsageFlags {
        match self {
            Self::Sampled => vk::ImageUsageFlags::SAMPLED,
            Self::Clear => vk::ImageUsageFlags::TRANSFER_DST,
            _ => vk::ImageUsageFlags::STORAGE,
        }
    }

    /// The usage flag that a buffer needs for this access.
    pub const fn buffer_usage(self) -> vk::BufferUsageFlags {
        match self {
            Self::Uniform => vk::BufferUsageFlags::UNIFORM_BUFFER,
            Self::Clear => vk::BufferUsageFlags::TRANSFER_DST,
            _ => vk::BufferUsageFlags::STORAGE_BUFFER,
        }
    }

    /// The format feature that an image's format needs for this access.
    pub(crate) const fn format_feature(self) -> vk::FormatFeatureFlags {
        match self {
            Self::Sampled => vk::FormatFeatureFlags::SAMPLED_IMAGE,
            Self::Clear => vk::FormatFeatureFlags::TRANSFER_DST,
            _ => vk::FormatFeatureFlags::STORAGE_IMAGE,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_access_reads_or_writes() {
        for access in Access::ALL {
            assert!(access.reads() || access.writes(), "{access:?} does neither");
        }
    }

    #[test]
    fn only_whole_writes_may_discard() {
        let discarding: Vec<_> = Access::ALL.into_iter().filter(|a| !a.reads()).collect();
        assert_eq!(discarding, [Access::StorageWrite, Access::Clear]);
    }

    #[test]
    fn the_legacy_scope_says_the_same() {
        use vk::AccessFlags as A;
        for access in Access::ALL {
            let (stage, mask) = access.legacy_scope();
            assert_eq!(stage == vk::PipelineStageFlags::TRANSFER, access == Access::Clear, "{access:?}");
            assert_eq!(mask.intersects(A::SHADER_WRITE | A::TRANSFER_WRITE), access.writes(), "{access:?}");
            assert_eq!(mask.intersects(A::SHADER_READ | A::UNIFORM_READ), access.reads(), "{access:?}");
        }
    }

    #[test]
    fn the_mask_matches_the_direction() {
        use vk::AccessFlags2 as A;
        for access in Access::ALL {
            let mask = access.scope().access;
            assert_eq!(mask.intersects(A::SHADER_STORAGE_WRITE | A::TRANSFER_WRITE), access.writes(), "{access:?}");
            assert_eq!(
                mask.intersects(A::SHADER_STORAGE_READ | A::SHADER_SAMPLED_READ | A::UNIFORM_READ),
                access.reads(),
                "{access:?}"
            );
        }
    }
}
