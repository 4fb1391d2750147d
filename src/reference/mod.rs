//! The CPU twin of every stage: plain `f32`, no `unsafe`, written from the equations and not from the shaders.
//!
//! A twin reads and writes images in the packed representation of the GPU's images, so that either can stand in for the other. Each
//! stage is a pure function with inputs and outputs of its own. A [`Stage`] has it behind one interface: its twin reads and writes
//! [`Bindings`] by the names of the shader, and its rules say when what the GPU wrote is equal. [`STAGES`] lists them all.
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

mod adaptive_alpha;
#[cfg(test)]
mod adaptive_history_tests;
mod atrous;
mod binary16;
mod bindings;
mod block_difference;
mod block_percentiles;
mod blocks;
mod change_test;
mod compare;
mod conventions;
mod debug_view;
mod demodulate;
mod eaw;
mod engine;
mod firefly;
mod forward_project;
mod forward_projection;
mod geometry_weights;
mod gradient;
mod gradient_atrous;
mod guide;
mod image;
mod import;
mod luminance;
mod modulate;
mod moments;
mod nearest_history;
mod octahedral;
mod pass;
mod percentile_rule;
mod projection;
mod render_rect;
mod reprojection;
mod rules;
mod stage;
mod statistics;
mod strata;
mod surface_motion;
mod taa;
mod temporal_accumulation;
#[cfg(test)]
mod test_scene;
mod texels;
mod tone_map;
mod variance;
mod volume;
mod volume_motion;
mod volume_points;

pub use adaptive_alpha::{adaptive_alpha, AdaptiveAlphaInput};
pub use atrous::{atrous, volume_atrous, AtrousInputs, AtrousLevel, LUMINANCE_EPSILON};
pub use binary16::{round_image_to_half, round_to_half, LARGEST_HALF};
pub use bindings::{Bindings, Twin};
pub use block_difference::{block_difference, pack_difference, unpack_difference, BlockDifferenceInputs, Difference};
pub use block_percentiles::{block_percentiles, pack_percentiles, unpack_percentiles, BlockPercentilesInputs, Percentiles};
pub use blocks::BLOCK_SIZE;
pub use change_test::{change_test, CHANGE_EPSILON};
pub use compare::{Per, Rule, Tolerance, Values, When};
pub use debug_view::{debug_view, DebugViewInputs};
pub use demodulate::{demodulate, DemodulateInputs, DemodulateOutputs, ALBEDO_EPSILON};
pub use eaw::{eaw, EawInputs, HOLE};
pub use engine::Engine;
pub use firefly::{firefly, FireflyInputs};
pub use forward_project::{
    forward_project_claim, forward_project_resolve, ForwardProjectInputs, ForwardProjectOutputs, PreviousCandidates,
};
pub use geometry_weights::DEPTH_EPSILON;
pub use gradient::{gradient, GradientInput, GradientInputs, GradientOutputs};
pub use gradient_atrous::{gradient_atrous, GradientAtrousInputs, GRADIENT_ITERATIONS};
pub use guide::{fold_id, pack_guide, unpack_guide, Surface};
pub use image::Image;
pub use import::{decode_normal, import, ImportInputs, ImportOutputs};
pub use luminance::luminance;
pub use modulate::{modulate, ModulateInputs, ModulateOutputs};
pub use moments::{pack_moments, unpack_moments, Moments, Reason};
pub use nearest_history::HistoryGuides;
pub use octahedral::{octahedral10, octahedral10_to_normal, octahedral8, octahedral8_to_normal};
pub use pass::Written;
pub use percentile_rule::{percentile_rule, PercentileRuleInputs, RANGE_EPSILON};
pub use projection::Projections;
pub use reprojection::{motion_in_pixels, InstanceTransform};
pub use stage::Stage;
pub use statistics::{Counter, Statistics};
pub use strata::{pack_gradient_sample, unpack_gradient_sample, GradientSample};
pub use surface_motion::{
    pack_depth_gradient, pack_surface_motion, unpack_depth_gradient, unpack_surface_motion, SurfaceMotion, LARGEST_MOTION,
};
pub use taa::{taa, TaaInputs};
pub use temporal_accumulation::{
    temporal_accumulation, volume_accumulation, ObjectNormals, PreviousFrame, SignalHistory, TemporalAccumulationInputs,
    TemporalAccumulationOutputs, VolumeAccumulationInputs,
};
pub use texels::Texels;
pub use tone_map::tone_map;
pub use variance::{fading_variance, variance, volume_variance, VarianceInputs, VolumeVarianceInputs};
pub use volume_motion::{pack_volume_motion, unpack_volume_motion, volume_motion_claim, volume_motion_resolve};
pub use volume_points::{
    pack_volume_point, unpack_volume_point, volume_points, VolumePoint, VolumePointsInputs, VolumePointsOutputs,
};

use rules::*;

/// Every stage that has a twin.
pub static STAGES: &[Stage] = &[
    Stage::new("import", import::twin, IMPORT),
    Stage::new("forward_project", forward_project::twin, FORWARD_PROJECT),
    Stage::new("gradient", gradient::twin, GRADIENT),
    Stage::new("gradient_atrous", gradient_atrous::twin, &[strata("gradient_out", WEIGHTED)]),
    Stage::new("adaptive_alpha", adaptive_alpha::twin, &[pixels("history_confidence", HALF)]),
    Stage::new("demodulate", demodulate::twin, &[STATISTICS, pixels("irradiance_0", HALF), pixels("irradiance_1", HALF)]),
    Stage::new("block_percentiles", block_percentiles::twin, &[rule("block_percentiles", Per::Block, Values::Percentiles, HALF)]),
    Stage::new("firefly", firefly::twin, &[pixels("irradiance", HALF)]),
    Stage::new("block_difference", block_difference::twin, BLOCK_DIFFERENCE),
    Stage::new("percentile_rule", percentile_rule::twin, &[pixels("history_confidence", STEEP)]),
    Stage::new("change_test", change_test::twin, &[pixels("history_confidence", STEEP)]),
    Stage::new("temporal_accumulation", temporal_accumulation::twin, TEMPORAL_ACCUMULATION),
    Stage::new("variance", variance::twin, &[pixels("estimated_0", ESTIMATED), pixels("estimated_1", ESTIMATED)]),
    Stage::new("atrous", atrous::twin, &[pixels("output_0", WEIGHTED), pixels("output_1", WEIGHTED)]),
    Stage::new("eaw", eaw::twin, &[pixels("output_0", WEIGHTED), pixels("output_1", WEIGHTED)]),
    Stage::new("modulate", modulate::twin, &[STATISTICS, pixels("denoised_radiance", HALF)]),
    Stage::new(
        "volume_motion",
        volume_motion::twin,
        &[pixels("claims", EXACT), rule("volume_motion", Per::Pixel, Values::Halves, EXACT)],
    ),
    Stage::new("volume_points", volume_points::twin, &[STATISTICS, pixels("radiance", HALF), pixels("volume_points", EXACT)]),
    Stage::new("tone_map", tone_map::twin, &[pixels("tone_mapped", HALF)]),
    Stage::new("taa", taa::twin, &[pixels("taa_history", CLIPPED), pixels("display", CLIPPED)]),
    Stage::new("debug_view", debug_view::twin, &[pixels("debug_view", PICTURE)]),
];
