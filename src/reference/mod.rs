//! The CPU twin of every stage: plain `f32`, no `unsafe`, written from the equations and not from the shaders.
//!
//! A twin reads and writes images in the packed representation of the GPU's images, so that either can stand in for the other. Each
//! stage is a pure function with inputs and outputs of its own. A [`Stage`] has it behind one interface: its twin reads and writes
//! [`Bindings`] by the names of the shader, and its rules say when what the GPU wrote is equal. [`STAGES`](crate::nodes::STAGES)
//! lists them all, and each stands beside its node, in `src/nodes/NAME/twin.rs`; here is what they share.
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

#[cfg(test)]
mod adaptive_history_tests;
pub(crate) mod binary16;
pub(crate) mod bindings;
pub(crate) mod blocks;
mod compare;
pub(crate) mod conventions;
pub(crate) mod curvature;
mod engine;
pub(crate) mod forward_projection;
pub(crate) mod geometry_weights;
pub(crate) mod guide;
mod image;
pub(crate) mod kept_radiance;
pub(crate) mod light_ratio;
pub(crate) mod luminance;
pub(crate) mod moments;
pub(crate) mod nearest_history;
pub(crate) mod octahedral;
mod pass;
pub(crate) mod projection;
pub(crate) mod reflection;
pub(crate) mod render_rect;
pub(crate) mod reprojection;
pub(crate) mod rules;
pub(crate) mod specular_albedo;
mod stage;
pub(crate) mod statistics;
pub(crate) mod strata;
pub(crate) mod surface_motion;
#[cfg(test)]
pub(crate) mod test_scene;
pub(crate) mod texels;
pub(crate) mod virtual_motion;
pub(crate) mod visibility;
pub(crate) mod volume;

pub use crate::nodes::adaptive_alpha::twin::{adaptive_alpha, AdaptiveAlphaInput, AdaptiveAlphaOutputs};
pub use crate::nodes::atrous::twin::{atrous, volume_atrous, AtrousInputs, AtrousLevel, LUMINANCE_EPSILON};
pub use crate::nodes::block_difference::twin::{
    block_difference, pack_difference, unpack_difference, BlockDifferenceInputs, Difference,
};
pub use crate::nodes::block_percentiles::twin::{
    block_percentiles, pack_percentiles, unpack_percentiles, BlockPercentilesInputs, Percentiles,
};
pub use crate::nodes::change_test::twin::{change_test, ChangeTestOutputs, CHANGE_EPSILON};
pub use crate::nodes::debug_view::twin::{debug_view, DebugViewInputs};
pub use crate::nodes::demodulate::twin::{
    demodulate, noisy_luminance, noisy_red_blue, DemodulateInputs, DemodulateOutputs, ALBEDO_EPSILON,
};
pub use crate::nodes::eaw::twin::{eaw, EawInputs, HOLE};
pub use crate::nodes::fill_holes::twin::{fill_holes, FillHolesInputs};
pub use crate::nodes::firefly::twin::{firefly, FireflyInputs};
pub use crate::nodes::forward_project::twin::{
    forward_project_claim, forward_project_resolve, ForwardProjectInputs, ForwardProjectOutputs, PreviousCandidates,
};
pub use crate::nodes::gradient::twin::{gradient, GradientInput, GradientInputs, GradientOutputs};
pub use crate::nodes::gradient_atrous::twin::{
    gradient_atrous, light_ratio, GradientAtrousInputs, GradientAtrousOutputs, Light, GRADIENT_ITERATIONS,
};
pub use crate::nodes::import::twin::{decode_normal, import, ImportInputs, ImportOutputs};
pub use crate::nodes::modulate::twin::{modulate, ModulateInputs, ModulateOutputs};
pub use crate::nodes::percentile_rule::twin::{percentile_rule, PercentileRuleInputs, RANGE_EPSILON};
pub use crate::nodes::sample_albedo::twin::{sample_albedo, SampleAlbedoInputs, SampleAlbedoOutputs};
pub use crate::nodes::shadowed_light::twin::shadowed_light;
pub use crate::nodes::specular_accumulation::twin::{
    specular_accumulation, PreviousSpecular, SpecularAccumulationInputs, SpecularAccumulationOutputs,
};
pub use crate::nodes::taa::twin::{taa, TaaInputs};
pub use crate::nodes::temporal_accumulation::twin::{
    temporal_accumulation, volume_accumulation, ObjectNormals, PreviousFrame, SignalHistory, StrataRatio,
    TemporalAccumulationInputs, TemporalAccumulationOutputs, VolumeAccumulationInputs,
};
pub use crate::nodes::tone_map::twin::tone_map;
pub use crate::nodes::variance::twin::{fading_variance, variance, volume_variance, VarianceInputs, VolumeVarianceInputs};
pub use crate::nodes::visibility_accumulation::twin::{visibility_accumulation, VisibilityAccumulationInputs};
pub use crate::nodes::visibility_filter::twin::{visibility_filter, VisibilityFilterInputs};
pub use crate::nodes::visibility_samples::twin::{visibility_samples, NO_SAMPLE};
pub use crate::nodes::volume_motion::twin::{pack_volume_motion, unpack_volume_motion, volume_motion_claim, volume_motion_resolve};
pub use crate::nodes::volume_points::twin::{
    pack_volume_point, unpack_volume_point, volume_points, VolumePoint, VolumePointsInputs, VolumePointsOutputs,
};
pub use binary16::{round_image_to_half, round_to_half, LARGEST_HALF};
pub use bindings::{Bindings, Twin};
pub use blocks::BLOCK_SIZE;
pub use compare::{Per, Rule, Tolerance, Values, When};
pub use engine::Engine;
pub use geometry_weights::DEPTH_EPSILON;
pub use guide::{fold_id, pack_guide, unpack_guide, Surface};
pub use image::Image;
pub use luminance::luminance;
pub use moments::{pack_moments, unpack_moments, Moments, Reason};
pub use nearest_history::HistoryGuides;
pub use octahedral::{octahedral10, octahedral10_to_normal, octahedral8, octahedral8_to_normal};
pub use pass::Written;
pub use projection::Projections;
pub use reflection::{pack_reflection, unpack_image_share, unpack_reflection, SeenReflection, FARTHEST_HIT};
pub use reprojection::{motion_in_pixels, InstanceTransform};
pub use stage::Stage;
pub use strata::{pack_gradient_sample, unpack_gradient_sample, GradientSample};
pub use surface_motion::{
    pack_depth_gradient, pack_surface_motion, unpack_depth_gradient, unpack_surface_motion, SurfaceMotion, LARGEST_MOTION,
};
pub use texels::Texels;
pub use visibility::{pack_visibility, unpack_visibility, VisibilityHistory};
