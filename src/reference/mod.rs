//! The CPU twin of every stage: plain `f32`, no `unsafe`, written from the equations and not from the shaders.
//!
//! A twin reads and writes images in the packed representation of the GPU's images, so that either can stand in for the other. It
//! reads and writes [`Bindings`] by the names of the shader, and rules say when what the GPU wrote is equal. The twins stand beside
//! their nodes, in `src/nodes/NAME/twin.rs`; here is the engine that runs them, and what they share.
//!
//! Images have the allocated extent; what lies outside the frame's render extent is never read and is left at its default.
//! [`Engine`] runs a declaration pass by pass over a sequence of frames and checks its inputs; a stage that is called by itself
//! panics on an image that is smaller than the render extent.
//!
//! | tag | source |
//! | --- | --- |
//! | \[EAW\] | Dammertz et al.: Edge-Avoiding À-Trous Wavelet Transform for fast Global Illumination Filtering, HPG 2010 |
//! | \[SVGF\] | Schied et al.: Spatiotemporal Variance-Guided Filtering, HPG 2017 |
//! | \[ASVGF\] | Schied, Peters, Dachsbacher: Gradient Estimation for Real-Time Adaptive Temporal Filtering, PACMCGIT 1(2), 2018 |
//! | \[PSVGF\] | Alber: Percentile-based Adaptive Spatiotemporal Variance-Guided Filtering for GI and Volumes, KIT |
//! | \[Karis 2014\] | High-Quality Temporal Supersampling, SIGGRAPH courses 2014 |
//! | \[Narkowicz 2015\] | ACES Filmic Tone Mapping Curve |

pub(crate) mod binary16;
pub(crate) mod bindings;
pub(crate) mod blocks;
pub(crate) mod both_confidences;
pub(crate) mod compare;
pub(crate) mod conventions;
pub(crate) mod curvature;
mod engine;
pub(crate) mod forward_projection;
pub(crate) mod geometry_weights;
pub(crate) mod guide;
pub(crate) mod holes;
mod image;
pub(crate) mod kept_radiance;
pub(crate) mod light_ratio;
pub(crate) mod luminance;
pub(crate) mod luminance_history;
pub(crate) mod material;
pub(crate) mod nearest_history;
pub(crate) mod octahedral;
pub(crate) mod outgoing;
mod pass;
pub(crate) mod projection;
pub(crate) mod range;
pub(crate) mod rare_light;
pub(crate) mod reflection;
pub(crate) mod render_rect;
pub(crate) mod reprojection;
pub(crate) mod rules;
pub(crate) mod scenery;
pub(crate) mod shadow_motion;
pub(crate) mod specular_albedo;
mod stage;
pub(crate) mod statistics;
pub(crate) mod strata;
pub(crate) mod surface_motion;
#[cfg(test)]
pub(crate) mod test_scene;
pub(crate) mod texels;
pub(crate) mod upscale_history;
pub(crate) mod virtual_motion;
pub(crate) mod visibility;
pub(crate) mod volume;

pub use bindings::{Bindings, Twin};
pub use engine::Engine;
pub use image::Image;
pub use luminance::luminance;
pub use luminance_history::{unpack_luminance_history, LuminanceHistory, Reason};
pub use octahedral::decode_normal;
pub use pass::TwinOutputs;
pub use projection::Projections;
pub use reprojection::{motion_in_pixels, InstanceTransform};
pub(crate) use stage::CpuStage;
pub use texels::Texels;

#[cfg(test)]
pub(crate) use {
    binary16::{round_image_to_half, round_to_half, LARGEST_HALF},
    guide::{pack_guide, unpack_guide, Surface},
    nearest_history::{HistoryGuides, SignalHistory},
    reflection::{pack_reflection, SeenReflection, FARTHEST_HIT},
    strata::{pack_gradient_sample, unpack_gradient_sample, GradientSample},
    surface_motion::{pack_surface_motion, unpack_surface_motion, SurfaceMotion, LARGEST_MOTION},
    visibility::VisibilityHistory,
};
