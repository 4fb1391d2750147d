//! Resources of passes: images and buffers with an owner and a life.

use super::texel::Texel;
use super::{ImageFormat, Setup};
use ash::vk;

/// The owner of a resource and the life of its content.
///
/// Closed by the contract: you may match every one, since a new one would be a breaking change.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Lifetime {
    /// Your resource, which is only read.
    Input {
        /// Whether it may be bound as [`crate::Binding::Absent`].
        optional: bool,
    },
    /// Your resource. Every texel of the render rect is written. Earlier passes of the same phase
    /// may use it as scratch memory: its content is undefined from its first use in a frame to its
    /// last.
    Output,
    /// Content is undefined before its first use in a frame and dead after its last, so you may
    /// alias it.
    Transient,
    /// Two copies, which exchange their roles in each frame: [`super::UseFrame::Previous`] was
    /// [`super::UseFrame::Current`] one frame ago. Two suffice for any number of frames in flight.
    History,
    /// One copy that survives the frame: its last read as `Previous` comes before its first write as `Current`.
    HistoryInPlace,
}

impl Lifetime {
    /// Number of copies that you allocate: none of an input, two of a history.
    pub const fn copies(self) -> usize {
        match self {
            Self::Input { .. } => 0,
            Self::History => 2,
            _ => 1,
        }
    }

    /// Whether its content survives the frame.
    pub const fn is_history(self) -> bool {
        matches!(self, Self::History | Self::HistoryInPlace)
    }
}

/// The shape of a resource: image or buffer.
///
/// Closed by the contract: you may match every one, since a new one would be a breaking change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// A 2D image with one mip level and one layer.
    Image {
        /// Format.
        format: ImageFormat,
        /// Its texels.
        texels: TexelGrid,
    },
    /// A buffer.
    Buffer {
        /// Bytes.
        size: u64,
    },
}

/// The texels of an image.
///
/// Closed by the contract: you may match every one, since a new one would be a breaking change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TexelGrid {
    /// One for every square of so many rendered pixels a side: 1, per pixel; 3, per 3×3 stratum.
    Rendered(u32),
    /// One for every square of so many pixels of the light a side, where it has fewer: [`crate::Config::light_extent`].
    Light(u32),
    /// One for every pixel of the output: [`crate::Config::output_extent`].
    Output,
}

impl TexelGrid {
    /// Columns and rows for an extent that is rendered.
    pub(crate) fn extent(self, setup: &Setup, rendered: [u32; 2]) -> [u32; 2] {
        match self {
            Self::Rendered(side) => rendered.map(|pixels| pixels.div_ceil(side.max(1))),
            Self::Light(side) => setup.light_of(rendered).map(|pixels| pixels.div_ceil(side.max(1))),
            Self::Output => setup.output_extent.unwrap_or(rendered),
        }
    }
}

impl From<u32> for TexelGrid {
    fn from(side: u32) -> Self {
        Self::Light(side)
    }
}

/// Index into [`super::Declaration::resources`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ResourceId(pub u32);

/// One resource.
#[derive(Clone, Debug, PartialEq)]
pub struct ResourceDecl {
    /// Stable key, `snake_case`.
    pub name: String,
    /// Image or buffer.
    pub shape: Shape,
    /// Owner and life of the content.
    pub lifetime: Lifetime,
    /// Union over all uses. Add the flags of your own uses.
    pub image_usage: vk::ImageUsageFlags,
    /// Union over all uses. Add the flags of your own uses.
    pub buffer_usage: vk::BufferUsageFlags,
}

impl ResourceDecl {
    /// Columns and rows of an image for the extents of a setup; `None` for a buffer.
    pub fn extent(&self, setup: &Setup) -> Option<[u32; 2]> {
        match self.shape {
            Shape::Image { .. } if self.is_part_of_image(setup) => setup.image_extent,
            Shape::Image { texels, .. } => Some(texels.extent(setup, setup.allocated_extent)),
            Shape::Buffer { .. } => None,
        }
    }

    /// Whether it is an image of the host in which the picture is a part.
    pub(crate) fn is_part_of_image(&self, setup: &Setup) -> bool {
        let is_of_host = matches!(self.lifetime, Lifetime::Input { .. } | Lifetime::Output);
        // With such images light and output have the pixels of the guides.
        let is_of_pixels = |texels| matches!(texels, TexelGrid::Rendered(1) | TexelGrid::Light(1) | TexelGrid::Output);
        let is_of_pixels = matches!(self.shape, Shape::Image { texels, .. } if is_of_pixels(texels));
        setup.image_extent.is_some() && is_of_host && is_of_pixels
    }

    /// Bytes of the texels of one copy, without the alignment of a device. 0 for a format that none
    /// of our images can have.
    pub fn bytes(&self, setup: &Setup) -> u64 {
        match (self.shape, self.extent(setup)) {
            (Shape::Image { format, .. }, Some([w, h])) => {
                let texel = Texel::of(format.preferred()).map_or(0, |texel| texel.bytes() as u64);
                u64::from(w) * u64::from(h) * texel
            }
            (Shape::Buffer { size }, _) => size,
            (Shape::Image { .. }, None) => 0,
        }
    }
}
