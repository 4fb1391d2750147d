//! States of images and buffers: the last use of one, or its next.

use crate::contract::Access;
use ash::vk;

/// The state of an image or buffer: the last access to it, its layout and its owner. One side of a barrier.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ResourceState {
    /// Pipeline stages.
    pub stage: vk::PipelineStageFlags2,
    /// Accesses of those stages.
    pub access: vk::AccessFlags2,
    /// Layout of an image; `UNDEFINED` for a buffer, and for content that no one needs.
    pub layout: vk::ImageLayout,
    /// Queue family that owns it. `QUEUE_FAMILY_IGNORED` if ownership never changes: one family, or
    /// concurrent sharing.
    pub queue_family: u32,
}

impl ResourceState {
    /// The state of an unused resource: no access, undefined content.
    pub const UNDEFINED: Self = Self::new(vk::PipelineStageFlags2::NONE, vk::AccessFlags2::NONE, vk::ImageLayout::UNDEFINED);

    /// The state after an unknown use: the content is lost, and every access is waited for.
    pub const UNKNOWN: Self =
        Self::new(vk::PipelineStageFlags2::ALL_COMMANDS, vk::AccessFlags2::MEMORY_WRITE, vk::ImageLayout::UNDEFINED);

    /// The state of the source of a copy.
    pub const COPY_SOURCE: Self =
        Self::new(vk::PipelineStageFlags2::ALL_TRANSFER, vk::AccessFlags2::TRANSFER_READ, vk::ImageLayout::TRANSFER_SRC_OPTIMAL);

    /// The state after a use by a pass, by its [`Access`]. `Clear` is also the state of the target
    /// of a copy.
    pub const fn of(access: Access) -> Self {
        let image = access.image();
        Self::new(image.stage, image.access, image.layout)
    }

    /// A state without an owner.
    pub const fn new(stage: vk::PipelineStageFlags2, access: vk::AccessFlags2, layout: vk::ImageLayout) -> Self {
        Self { stage, access, layout, queue_family: vk::QUEUE_FAMILY_IGNORED }
    }

    /// The state with a queue family as its owner.
    pub const fn owned_by(self, queue_family: u32) -> Self {
        Self { queue_family, ..self }
    }

    /// Stage and access mask for `vkCmdPipelineBarrier`, on devices without synchronization2.
    /// Stages that it does not know become `ALL_COMMANDS`. No stage at all stays empty here:
    /// whether it means `TOP_OF_PIPE` or `BOTTOM_OF_PIPE` depends on the side.
    pub fn legacy_scope(self) -> (vk::PipelineStageFlags, vk::AccessFlags) {
        (legacy_stage(self.stage), legacy_access(self.access))
    }

    /// Whether any of the accesses writes on the device. Writes of the CPU do not count: a submission makes them visible.
    pub(super) fn writes(&self) -> bool {
        self.access.as_raw() & !READS.as_raw() != 0
    }

    /// Whether reads of another state see what these reads saw, without a barrier between them.
    pub(super) fn is_visible_to(&self, reads: &Self) -> bool {
        use vk::{AccessFlags2 as A, PipelineStageFlags2 as S};
        let shader_reads = A::SHADER_SAMPLED_READ | A::SHADER_STORAGE_READ;
        let access = if self.access.contains(A::SHADER_READ) { self.access | shader_reads } else { self.access };
        let is_seen_by_stage = self.stage.contains(reads.stage) || self.stage.contains(S::ALL_COMMANDS);
        let is_seen_by_access = access.contains(reads.access) || access.contains(A::MEMORY_READ);
        is_seen_by_stage && is_seen_by_access
    }

    pub(super) fn merge(&mut self, other: &Self) {
        self.stage |= other.stage;
        self.access |= other.access;
    }

    /// Whether a shader may sample the image where it is.
    pub(crate) fn is_sampled_in_place(&self) -> bool {
        matches!(
            self.layout,
            vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL
                | vk::ImageLayout::DEPTH_STENCIL_READ_ONLY_OPTIMAL
                | vk::ImageLayout::DEPTH_READ_ONLY_STENCIL_ATTACHMENT_OPTIMAL
                | vk::ImageLayout::DEPTH_READ_ONLY_OPTIMAL
                | vk::ImageLayout::READ_ONLY_OPTIMAL
        )
    }
}

impl From<Access> for ResourceState {
    fn from(access: Access) -> Self {
        Self::of(access)
    }
}

/// Accesses that leave content as it is. What is not among them counts as a write, so that a flag of an extension does.
const READS: vk::AccessFlags2 = {
    use vk::AccessFlags2 as A;
    A::from_raw(
        A::INDIRECT_COMMAND_READ.as_raw()
            | A::INDEX_READ.as_raw()
            | A::VERTEX_ATTRIBUTE_READ.as_raw()
            | A::UNIFORM_READ.as_raw()
            | A::INPUT_ATTACHMENT_READ.as_raw()
            | A::SHADER_READ.as_raw()
            | A::COLOR_ATTACHMENT_READ.as_raw()
            | A::DEPTH_STENCIL_ATTACHMENT_READ.as_raw()
            | A::TRANSFER_READ.as_raw()
            | A::HOST_READ.as_raw()
            | A::HOST_WRITE.as_raw()
            | A::MEMORY_READ.as_raw()
            | A::SHADER_SAMPLED_READ.as_raw()
            | A::SHADER_STORAGE_READ.as_raw()
            | A::ACCELERATION_STRUCTURE_READ_KHR.as_raw()
            | A::SHADER_BINDING_TABLE_READ_KHR.as_raw(),
    )
};

/// Flags of the first 17 bits mean the same in both.
const SHARED_BITS: u64 = 0x1_ffff;

fn legacy_stage(stage: vk::PipelineStageFlags2) -> vk::PipelineStageFlags {
    use vk::{PipelineStageFlags as Old, PipelineStageFlags2 as New};
    let renamed = [
        (New::COPY | New::RESOLVE | New::BLIT | New::CLEAR, Old::TRANSFER),
        (New::INDEX_INPUT | New::VERTEX_ATTRIBUTE_INPUT, Old::VERTEX_INPUT),
        (New::PRE_RASTERIZATION_SHADERS, Old::ALL_GRAPHICS),
    ];
    let renamed = renamed.map(|(new, old)| (new.as_raw(), old.as_raw()));
    Old::from_raw(legacy_bits(stage.as_raw(), renamed, Old::ALL_COMMANDS.as_raw()))
}

fn legacy_access(access: vk::AccessFlags2) -> vk::AccessFlags {
    use vk::{AccessFlags as Old, AccessFlags2 as New};
    let renamed = [
        (New::SHADER_SAMPLED_READ | New::SHADER_STORAGE_READ | New::SHADER_BINDING_TABLE_READ_KHR, Old::SHADER_READ),
        (New::SHADER_STORAGE_WRITE, Old::SHADER_WRITE),
    ];
    let renamed = renamed.map(|(new, old)| (new.as_raw(), old.as_raw()));
    Old::from_raw(legacy_bits(access.as_raw(), renamed, (Old::MEMORY_READ | Old::MEMORY_WRITE).as_raw()))
}

/// Bits that have other names, and `unknown` for those that have none.
fn legacy_bits<const N: usize>(bits: u64, renamed: [(u64, u32); N], unknown: u32) -> u32 {
    let (mut legacy, mut rest) = ((bits & SHARED_BITS) as u32, bits & !SHARED_BITS);
    for (new, old) in renamed.into_iter().filter(|(new, _)| bits & new != 0) {
        (legacy, rest) = (legacy | old, rest & !new);
    }
    if rest == 0 {
        legacy
    } else {
        legacy | unknown
    }
}
