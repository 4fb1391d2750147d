//! What a host sees: plain data that declares every resource, every pass and how a pass touches a resource.
//!
//! Nothing in here talks to Vulkan or contains `unsafe`: the types map one to one onto a host's own frame graph.

mod access;
mod debug_view;
mod declaration;
mod format;
mod frame;
mod tuning;

mod alias;

pub(crate) use alias::{alias, Span};

pub use access::{Access, BufferAccess, ImageAccess};
pub use debug_view::DebugView;
pub use declaration::{
    Boundary, BoundaryUse, Declaration, Lifetime, Memory, PassDecl, Phase, ResourceDecl, ResourceId, ResourceMemory, Shape, Use,
    UseFrame,
};
pub(crate) use declaration::{Grid, Work};
#[cfg(feature = "executor")]
pub(crate) use format::bytes_per_texel;
#[cfg(any(test, feature = "executor"))]
pub(crate) use format::component_of;
pub use format::{Component, ImageFormat};
pub use frame::{FrameContext, FrameParams, FrameState, ResetReason};
pub use tuning::{ToneCurve, Tuning, TuningField};
