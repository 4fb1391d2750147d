//! The contract with your engine: plain data that declares every resource, every pass and each
//! access of a pass to a resource.
//!
//! Nothing in here talks to Vulkan or contains `unsafe`: the types map one to one onto your own
//! frame graph.

mod access;
mod binding;
mod boundary;
mod debug_view;
mod declaration;
mod dispatch;
mod format;
mod frame;
mod inputs;
mod material;
mod memory;
mod pipeline_decl;
mod resource;
mod setup;
mod statistics;
mod statistics_watch;
// Texels are decoded for copies and captures alone.
#[cfg_attr(not(feature = "executor"), allow(dead_code))]
pub(crate) mod texel;
mod tracker;
mod tuning;

mod alias;

pub(crate) use alias::{alias, Span};

pub use crate::shaders::Component;
pub use access::{Access, BufferAccess, ImageAccess};
pub use binding::Binding;
pub use boundary::{Boundary, BoundaryUse};
pub use debug_view::DebugView;
pub(crate) use declaration::life;
pub use declaration::{Declaration, PassDecl, Phase, Use, UseFrame};
pub(crate) use dispatch::{Dispatch, Grid, GridExtents, Parameter, Slot, Work};
pub(crate) use format::component_of;
pub use format::ImageFormat;
pub use frame::{FrameContext, FrameParams, FrameState, ResetReason};
pub use inputs::{Input, InputKind, InputLayer, InputRole};
pub use material::Material;
pub use memory::{Memory, Placement, ResourceMemory};
pub use pipeline_decl::{PipelineConstant, PipelineDecl};
pub use resource::{Lifetime, ResourceDecl, ResourceId, Shape, TexelGrid};
pub use setup::Setup;
pub(crate) use setup::MAX_FRAMES_IN_FLIGHT;
pub(crate) use statistics::STATISTICS_BYTES;
pub use statistics::{Counter, Statistics};
pub use statistics_watch::{Finding, HistoryLoss, RepeatedNoise, StatisticsWatch};
#[cfg(feature = "executor")]
pub(crate) use tracker::WHOLE;
pub use tracker::{Barrier, BarrierTarget, Barriers2, LegacyBarriers, PhysicalResource, ResourceState, Subresource, Tracker};
pub use tuning::{ToneCurve, Tuning, TuningField};
