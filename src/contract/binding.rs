//! The image or buffer that you bind for a use of a pass.

use ash::vk;

/// Your binding for one use of a pass.
///
/// Closed by the contract: you may match every one, since a new one would be a breaking change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Binding {
    /// A view of the whole image, and the layout that the image is in when the pass runs: the declared one, or `GENERAL`. A depth
    /// view may be sampled in `DEPTH_STENCIL_READ_ONLY_OPTIMAL` and the other read-only layouts of depth as well.
    Image {
        /// 2D view of mip 0, layer 0: of the colour, or of the depth aspect alone.
        view: vk::ImageView,
        /// Layout of the image.
        layout: vk::ImageLayout,
    },
    /// A range of a buffer.
    Buffer {
        /// Buffer.
        buffer: vk::Buffer,
        /// Offset in bytes, aligned as the device demands for its descriptor type.
        offset: vk::DeviceSize,
        /// Bytes, or `WHOLE_SIZE`.
        range: vk::DeviceSize,
    },
    /// An optional input that you do not have in this frame.
    Absent,
}
