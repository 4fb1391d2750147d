//! The declaration of a denoiser: its resources and its passes in order.

use super::{alias, Access, FrameContext, ImageFormat, Span};
use crate::shaders::Shader;
use ash::vk;

/// Where in the host's frame a pass belongs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u32)]
pub enum Phase {
    /// After the G-buffer, before light transport.
    BeforeLighting = 0,
    /// After light transport.
    AfterLighting = 1,
    /// Whenever the host does tone mapping and anti-aliasing.
    PostProcess = 2,
}

impl Phase {
    /// Every phase, in order.
    pub const ALL: [Self; 3] = [Self::BeforeLighting, Self::AfterLighting, Self::PostProcess];
}

/// Who owns a resource and how long its content lives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Lifetime {
    /// Of the host; only read.
    Input {
        /// May be bound as [`crate::Binding::Absent`].
        optional: bool,
    },
    /// Of the host; every texel of the render rect is written.
    Output,
    /// Content is undefined before its first use in a frame and dead after its last: the host may alias it.
    Transient,
    /// Two copies. [`UseFrame::Previous`] is what [`UseFrame::Current`] was one frame ago; two suffice for any number of frames in flight.
    History,
    /// One copy that survives the frame: its last read as `Previous` comes before its first write as `Current`.
    HistoryInPlace,
}

impl Lifetime {
    /// Copies that a host allocates: none of an input, two of a history.
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

/// What a resource is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// A 2D image with one mip level and one layer, of `div_ceil(allocated_extent, divisor)` texels.
    Image {
        /// Format.
        format: ImageFormat,
        /// 1: per pixel; 3: per 3×3 stratum.
        divisor: u32,
    },
    /// A buffer.
    Buffer {
        /// Bytes.
        size: u64,
    },
}

/// Index into [`Declaration::resources`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ResourceId(pub u32);

/// One resource.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ResourceDecl {
    /// Stable key, `snake_case`.
    pub name: &'static str,
    /// Image or buffer.
    pub shape: Shape,
    /// Owner and life of the content.
    pub lifetime: Lifetime,
    /// Union over all uses; a host ORs in its own.
    pub image_usage: vk::ImageUsageFlags,
    /// Union over all uses; a host ORs in its own.
    pub buffer_usage: vk::BufferUsageFlags,
}

impl ResourceDecl {
    /// Texels of an image for an allocated extent; `None` for a buffer.
    pub fn extent(&self, allocated_extent: [u32; 2]) -> Option<[u32; 2]> {
        match self.shape {
            Shape::Image { divisor, .. } => Some(allocated_extent.map(|side| side.div_ceil(divisor))),
            Shape::Buffer { .. } => None,
        }
    }

    /// Bytes of one copy, texels alone: what a device adds for alignment is not in it.
    pub fn bytes(&self, allocated_extent: [u32; 2]) -> u64 {
        match (self.shape, self.extent(allocated_extent)) {
            (Shape::Image { format, .. }, Some([w, h])) => {
                u64::from(w) * u64::from(h) * super::format::bytes_per_texel(format.preferred())
            }
            (Shape::Buffer { size }, _) => size,
            (Shape::Image { .. }, None) => 0,
        }
    }
}

/// Which copy of a history a use means. Everything else is always `Current`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u32)]
pub enum UseFrame {
    /// Of this frame.
    Current = 0,
    /// Of the frame before.
    Previous = 1,
}

/// How a pass uses one resource. The order of a pass's uses is the order of its bindings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Use {
    /// Which resource.
    pub resource: ResourceId,
    /// Which copy.
    pub frame: UseFrame,
    /// How.
    pub access: Access,
}

/// The smallest schedulable unit: one dispatch, or the upload that starts a frame. Hazard-free inside; every barrier belongs between passes.
#[derive(Clone, Debug)]
pub struct PassDecl {
    /// Unique in a denoiser: for labels and profiles.
    pub name: &'static str,
    /// Where in the frame.
    pub phase: Phase,
    /// What it touches.
    pub uses: Vec<Use>,
    pub(crate) work: Work,
}

/// What a pass records.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Work {
    /// Uploads [`crate::FrameConstants`] to binding 0 and fills binding 1 with zeros.
    StartFrame,
    /// Fills binding 0, an image of unsigned integers, with zeros.
    Clear,
    /// One dispatch that covers the render extent.
    Dispatch {
        shader: &'static Shader,
        /// À-trous level, or what else the shader's first push constant means.
        level: u32,
        grid: Grid,
    },
    /// The same, with the view of the frame for the first push constant.
    DebugView {
        shader: &'static Shader,
        /// Bit i: binding i is what the shader calls it, and does not stand in for an image that the preset lacks.
        available: u32,
    },
}

/// Invocations of a dispatch.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Grid {
    /// One a pixel of this frame.
    Pixels,
    /// One a stratum of so many pixels a side, of this frame and of the previous one, which is walked, too.
    Strata(u32),
}

/// Resources and passes: plain data, made without a device.
#[derive(Clone, Debug)]
pub struct Declaration {
    pub(crate) allocated_extent: [u32; 2],
    pub(crate) resources: Vec<ResourceDecl>,
    pub(crate) passes: Vec<PassDecl>,
}

/// First and last access of a resource inside one phase: for semaphores and queue ownership between phases.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BoundaryUse {
    /// Which resource.
    pub resource: ResourceId,
    /// Which copy.
    pub frame: UseFrame,
    /// Its first access.
    pub first: Access,
    /// Its last access.
    pub last: Access,
    /// Whether the phase writes it.
    pub written: bool,
}

/// What a phase touches.
pub type Boundary = Vec<BoundaryUse>;

/// Bytes of one resource.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ResourceMemory {
    /// Name of the resource.
    pub name: &'static str,
    /// Life of its content.
    pub lifetime: Lifetime,
    /// Bytes of all its copies; 0 for an input, which is the host's.
    pub bytes: u64,
}

/// Bytes of texels and buffers, before a device's own alignment.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Memory {
    /// Survives the frame.
    pub history: u64,
    /// Transients, aliased by lifetime as the built-in executor does.
    pub transient: u64,
    /// Transients if none is aliased.
    pub transient_unaliased: u64,
    /// Outputs, which are the host's.
    pub output: u64,
    /// Each resource.
    pub resources: Vec<ResourceMemory>,
}

impl Declaration {
    /// Every resource; [`ResourceId`] is an index into it.
    pub fn resources(&self) -> &[ResourceDecl] {
        &self.resources
    }

    /// Every pass, in the order in which they must run.
    pub fn passes(&self) -> &[PassDecl] {
        &self.passes
    }

    /// The extent that images are allocated with.
    pub fn allocated_extent(&self) -> [u32; 2] {
        self.allocated_extent
    }

    /// The declaration of a resource.
    pub fn resource(&self, id: ResourceId) -> &ResourceDecl {
        &self.resources[id.0 as usize]
    }

    /// A resource by name.
    pub fn find(&self, name: &str) -> Option<ResourceId> {
        self.resources.iter().position(|r| r.name == name).map(|i| ResourceId(i as u32))
    }

    /// First and last pass that touch a resource, whichever copy.
    pub fn life(&self, id: ResourceId) -> Option<(usize, usize)> {
        let touches = |pass: &PassDecl| pass.uses.iter().any(|u| u.resource == id);
        Some((self.passes.iter().position(touches)?, self.passes.iter().rposition(touches)?))
    }

    /// First and last access of every resource that a phase touches, in order of first use.
    pub fn boundary(&self, phase: Phase) -> Boundary {
        let mut boundary: Boundary = Vec::new();
        for u in self.passes.iter().filter(|p| p.phase == phase).flat_map(|p| &p.uses) {
            match boundary.iter_mut().find(|b| b.resource == u.resource && b.frame == u.frame) {
                Some(b) => {
                    b.last = u.access;
                    b.written |= u.access.writes();
                }
                None => boundary.push(BoundaryUse {
                    resource: u.resource,
                    frame: u.frame,
                    first: u.access,
                    last: u.access,
                    written: u.access.writes(),
                }),
            }
        }
        boundary
    }

    /// Bytes, known before any is spent.
    pub fn memory(&self) -> Memory {
        let bytes = |r: &ResourceDecl| r.bytes(self.allocated_extent) * r.lifetime.copies() as u64;
        let sum = |want: fn(Lifetime) -> bool| self.resources.iter().filter(|r| want(r.lifetime)).map(bytes).sum();
        let spans: Vec<Span> = self.transients().map(|(id, first, last)| self.span(id, first, last)).collect();
        Memory {
            history: sum(Lifetime::is_history),
            transient: alias(&spans).1,
            transient_unaliased: sum(|l| l == Lifetime::Transient),
            output: sum(|l| l == Lifetime::Output),
            resources: self
                .resources
                .iter()
                .map(|r| ResourceMemory { name: r.name, lifetime: r.lifetime, bytes: bytes(r) })
                .collect(),
        }
    }

    /// Every transient with its first and last pass.
    pub(crate) fn transients(&self) -> impl Iterator<Item = (ResourceId, usize, usize)> + '_ {
        (0..self.resources.len() as u32).map(ResourceId).filter_map(|id| {
            let (first, last) = self.life(id)?;
            (self.resource(id).lifetime == Lifetime::Transient).then_some((id, first, last))
        })
    }

    fn span(&self, id: ResourceId, first: usize, last: usize) -> Span {
        Span { first, last, size: self.resource(id).bytes(self.allocated_extent), alignment: 1 }
    }

    /// Which physical copy a use means in a frame: 0 or 1.
    pub fn copy(&self, u: &Use, frame: &FrameContext) -> usize {
        match self.resource(u.resource).lifetime {
            Lifetime::History => frame.history_copy(u.frame),
            _ => 0,
        }
    }
}
