//! The declaration of a denoiser: its resources and its passes in order.

use super::{Access, FrameContext, Lifetime, ResourceDecl, ResourceId};
use crate::shaders::Shader;

/// Where in the host's frame a pass belongs.
///
/// Closed by the contract: a host may match every one, and another would be a breaking change.
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

/// Which copy of a history a use means. Everything else is always `Current`.
///
/// Closed by the contract: a host may match every one, and another would be a breaking change.
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
    pub name: String,
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

    /// Every transient with its first and last pass.
    pub(crate) fn transients(&self) -> impl Iterator<Item = (ResourceId, usize, usize)> + '_ {
        (0..self.resources.len() as u32).map(ResourceId).filter_map(|id| {
            let (first, last) = self.life(id)?;
            (self.resource(id).lifetime == Lifetime::Transient).then_some((id, first, last))
        })
    }

    /// Which physical copy a use means in a frame: 0 or 1.
    pub fn copy(&self, u: &Use, frame: &FrameContext) -> usize {
        match self.resource(u.resource).lifetime {
            Lifetime::History => frame.history_copy(u.frame),
            _ => 0,
        }
    }
}
