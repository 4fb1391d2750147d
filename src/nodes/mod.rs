//! The stages as nodes of a [`Graph`]: the shader of each, its images, and their uses.
//!
//! A node is a method of [`Graph`] in the file of its stage, with its parameters in a struct that has defaults. It adds passes and
//! allocates nothing. Beside it, in `twin.rs`, stands the stage on the CPU; [`STAGES`] lists them all.

pub(crate) mod adaptive_alpha;
pub(crate) mod atrous;
pub(crate) mod block_difference;
pub(crate) mod block_percentiles;
pub(crate) mod change_test;
pub(crate) mod debug_view;
pub(crate) mod demodulate;
pub(crate) mod eaw;
pub(crate) mod fill_holes;
pub(crate) mod firefly;
pub(crate) mod forward_project;
pub(crate) mod gradient;
pub(crate) mod gradient_atrous;
pub(crate) mod import;
pub(crate) mod modulate;
pub(crate) mod percentile_rule;
pub(crate) mod sample_albedo;
pub(crate) mod shadowed_light;
pub(crate) mod specular_accumulation;
pub(crate) mod taa;
pub(crate) mod temporal_accumulation;
pub(crate) mod tone_map;
pub(crate) mod variance;
pub(crate) mod visibility_accumulation;
pub(crate) mod visibility_filter;
pub(crate) mod visibility_samples;
pub(crate) mod volume_motion;
pub(crate) mod volume_points;

pub use adaptive_alpha::Confidences;
pub use atrous::{Atrous, Kernel, VolumeAtrous};
pub use block_percentiles::BLOCK_SIZE;
pub use change_test::Tested;
pub use debug_view::{Known, Ramp, ViewLegend};
pub use demodulate::{Albedo, Demodulate};
pub use eaw::Eaw;
pub use forward_project::ForwardProject;
pub use gradient::Gradients;
pub use gradient_atrous::GradientAtrous;
pub use import::Import;
pub use modulate::Modulate;
pub use specular_accumulation::{AccumulatedSpecular, SpecularAccumulation, SpecularHistory};
pub use temporal_accumulation::Accumulation;
pub use variance::{Estimator, Variance};
pub use volume_points::Volume;

use crate::graph::{Graph, Image, Port, Value};
use crate::reference::rules::*;
use crate::reference::{Per, Stage, Values};
use crate::shaders::Shader;

/// Every stage that has a twin.
pub static STAGES: &[Stage] = &[
    Stage::new("import", import::twin::twin, IMPORT),
    Stage::new("forward_project", forward_project::twin::twin, FORWARD_PROJECT),
    Stage::new("gradient", gradient::twin::twin, GRADIENT),
    Stage::new("gradient_atrous", gradient_atrous::twin::twin, GRADIENT_ATROUS),
    Stage::new(
        "adaptive_alpha",
        adaptive_alpha::twin::twin,
        &[pixels("history_confidence", HALF), pixels("unscaled_confidence", HALF)],
    ),
    Stage::new("demodulate", demodulate::twin::twin, DEMODULATE),
    Stage::new("sample_albedo", sample_albedo::twin::twin, SAMPLE_ALBEDO),
    Stage::new(
        "block_percentiles",
        block_percentiles::twin::twin,
        &[rule("block_percentiles", Per::Block, Values::Percentiles, HALF)],
    ),
    Stage::new("fill_holes", fill_holes::twin::twin, &[STATISTICS, pixels("filled", HALF)]),
    Stage::new("firefly", firefly::twin::twin, &[pixels("irradiance", HALF), rounded("irradiance")]),
    Stage::new("block_difference", block_difference::twin::twin, BLOCK_DIFFERENCE),
    Stage::new("percentile_rule", percentile_rule::twin::twin, &[pixels("history_confidence", STEEP)]),
    Stage::new(
        "change_test",
        change_test::twin::twin,
        &[pixels("history_confidence", STEEP), rule("steadiness", Per::Block, Values::Plain, STEEP)],
    ),
    Stage::new("temporal_accumulation", temporal_accumulation::twin::twin, TEMPORAL_ACCUMULATION),
    Stage::new("specular_accumulation", specular_accumulation::twin::twin, SPECULAR_ACCUMULATION),
    Stage::new("variance", variance::twin::twin, VARIANCE),
    Stage::new("atrous", atrous::twin::twin, FILTERED),
    Stage::new("eaw", eaw::twin::twin, FILTERED),
    Stage::new("modulate", modulate::twin::twin, &[STATISTICS, pixels("denoised_radiance", HALF), rounded("denoised_radiance")]),
    Stage::new(
        "volume_motion",
        volume_motion::twin::twin,
        &[pixels("claims", EXACT), rule("volume_motion", Per::Pixel, Values::Halves, EXACT)],
    ),
    Stage::new("volume_points", volume_points::twin::twin, &[STATISTICS, pixels("radiance", HALF), pixels("volume_points", EXACT)]),
    Stage::new("visibility_samples", visibility_samples::twin::twin, VISIBILITY_SAMPLES),
    Stage::new("visibility_accumulation", visibility_accumulation::twin::twin, VISIBILITY_ACCUMULATION),
    Stage::new("visibility_filter", visibility_filter::twin::twin, VISIBILITY_FILTER),
    Stage::new("shadowed_light", shadowed_light::twin::twin, &[STATISTICS, pixels("radiance", HALF)]),
    Stage::new("tone_map", tone_map::twin::twin, &[pixels("tone_mapped", HALF)]),
    Stage::new("taa", taa::twin::twin, &[pixels("taa_history", CLIPPED), pixels("display", CLIPPED)]),
    Stage::new("debug_view", debug_view::twin::twin, &[pixels("debug_view", PICTURE)]),
];

impl Stage {
    /// The stage of this name.
    pub fn find(name: &str) -> Option<&'static Self> {
        STAGES.iter().find(|stage| stage.name == name)
    }
}

/// Of a push constant that the variant of a shader does not read: so the tunable of its name is none of the graph.
const UNREAD: Value = Value::Fixed(0.0);

/// The module of a shader for one or two signals.
fn by_signals<K>(port: &Port<K>, one: &'static Shader, two: &'static Shader) -> &'static Shader {
    if port.signals() == 1 {
        one
    } else {
        two
    }
}

impl Graph {
    /// The label behind the name of a node: that of its only signal. Two signals that are filtered together have none.
    fn label_of<K>(&self, port: &Port<K>) -> String {
        match port.images() {
            [only] => self.label(*only).to_owned(),
            _ => String::new(),
        }
    }

    /// The images of a port with the content that they have now, after passes that wrote them.
    fn renewed<K>(&self, port: &Port<K>) -> Port<K> {
        let images: Vec<Image> = port.images().iter().map(|image| self.refreshed(*image)).collect();
        Port::of_images(&images).unwrap_or(*port)
    }

    /// An image for every signal of a port.
    fn image_each<K, L>(&mut self, of: &Port<K>, base: &str, format: crate::ImageFormat, divisor: u32) -> Port<L> {
        let images: Vec<Image> = of
            .images()
            .iter()
            .map(|image| {
                let label = self.label(*image).to_owned();
                self.named_image(base, &label, format, divisor, crate::Lifetime::Transient)
            })
            .collect();
        Port::of_images(&images).unwrap_or_else(|| of.cast())
    }
}
