//! Blends each pixel with its own past, found by motion and tested tap by tap. \[SVGF\] 4.1.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::{by_signals, pass, UNREAD};
use crate::graph::{Accumulated, Confidence, Graph, Guides, History, Irradiance, LightRatio, Value};
use crate::graph::{VolumeAccumulated, VolumeMotion, VolumeRadiance};
use crate::shaders;

/// Parameters of the node `temporal_accumulation`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Accumulation {
    /// Confidence that may shorten the history of a pixel \[ASVGF\]. Default: none \[SVGF\].
    pub confidence: Option<Confidence>,
    /// Whether disocclusions borrow the history of pixels nearby \[PSVGF\]. It also sets the cap of the history length where light
    /// changed: with a confidence of 1 − a the length is at most 1/a, as \[PSVGF\] has it. Without repair it is at most
    /// 1/(alpha + a·(1 − alpha)). Default: false.
    pub repair: bool,
    /// Whether irradiance of the history is read by the cubic of Catmull and Rom, where 4×4 pixels
    /// show the surface. Otherwise 2×2 pixels are read, which blurs a little more with every frame
    /// of motion. A pixel whose normal differs from that of the surface also counts for less.
    /// Default: false.
    pub sharp: bool,
    /// Ratio of light by which history is scaled before the blend, with the confidence of the same gradients. Default: none.
    pub light_ratio: Option<LightRatio>,
    /// Smallest weight of the new sample in the irradiance. Default: [`crate::Tuning::alpha`].
    pub alpha: Value,
    /// Smallest weight of the new sample in the moments. Default: [`crate::Tuning::alpha_moments`].
    pub alpha_moments: Value,
    /// Cap of the history length. Default: [`crate::Tuning::max_history_length`].
    pub max_history_length: Value,
    /// Largest relative difference of depth. Default: [`crate::Tuning::depth_tolerance`].
    pub depth_tolerance: Value,
    /// Smallest cosine between normals. Default: [`crate::Tuning::normal_tolerance`].
    pub normal_tolerance: Value,
}

impl Graph {
    /// Accumulates one or two signals in place. Their moments reach `history` by the node `variance`. A pixel with a negative alpha has
    /// no sample of its own: its history stays, and what was filled in (-1) counts for half a frame, nothing (-2) for none.
    /// \[SVGF\] 4.1, \[ASVGF\] 3.5.
    pub fn temporal_accumulation(
        &mut self,
        guides: &Guides,
        irradiance: &Irradiance,
        history: &History,
        accumulation: Accumulation,
    ) -> Accumulated {
        let node = self.node("temporal_accumulation", &self.label_of(irradiance));
        let modules = (&shaders::TEMPORAL_ACCUMULATION_SIGNALS_1, &shaders::TEMPORAL_ACCUMULATION_SIGNALS_2);
        let mut pass = pass(&node, by_signals(irradiance, modules.0, modules.1))
            .constant("REPAIR", u32::from(accumulation.repair))
            .constant("SHARP", u32::from(accumulation.sharp))
            .value("alpha", accumulation.alpha)
            .value("alpha_moments", accumulation.alpha_moments)
            .value("max_history_length", accumulation.max_history_length)
            .value("depth_tolerance", accumulation.depth_tolerance)
            .value("normal_tolerance", accumulation.normal_tolerance)
            .bind("guide", guides.guide)
            .previous("previous_guide", guides.guide)
            .bind("surface_motion", guides.surface_motion)
            .each_previous("history", history.colour())
            .each_previous("previous_luminance_history", history.luminance_history())
            .each("irradiance", irradiance.images())
            .each("new_luminance", history.new_luminance())
            .bind_some("material_class", guides.material_class)
            .bind_some("history_confidence", accumulation.confidence.map(|confidence| confidence.image()));
        if let Some(ratio) = accumulation.light_ratio {
            pass = pass.constant("STRATUM_SIZE", ratio.stratum_size).bind("light_ratio", ratio.image);
        }
        if let Some(normal) = guides.object_normal {
            pass = pass.bind("object_normal", normal).previous("previous_object_normal", normal);
        }
        self.add(pass);
        self.renewed(irradiance).cast::<crate::graph::kind::Accumulated>().with_holes_of(irradiance)
    }

    /// Accumulates the radiance of a volume in place, along its own motion, tested by the depth of the surface behind alone
    /// \[PSVGF\].
    pub fn volume_accumulation(
        &mut self,
        guides: &Guides,
        radiance: &VolumeRadiance,
        history: &History,
        motion: &VolumeMotion,
    ) -> VolumeAccumulated {
        let node = self.node("temporal_accumulation", &self.label_of(radiance));
        let pass = pass(&node, &shaders::TEMPORAL_ACCUMULATION_SIGNALS_1)
            .constant("VOLUME", 1)
            .value("alpha", Value::Tunable("volume_alpha"))
            .value("alpha_moments", Value::Tunable("volume_alpha"))
            .value("depth_tolerance", Value::Tunable("volume_depth_tolerance"))
            .value("normal_tolerance", UNREAD)
            .bind("guide", guides.guide)
            .previous("previous_guide", guides.guide)
            .bind("volume_motion", motion.image())
            .each_previous("history", history.colour())
            .each_previous("previous_luminance_history", history.luminance_history())
            .each("irradiance", radiance.images())
            .each("new_luminance", history.new_luminance());
        self.add(pass);
        self.renewed(radiance).cast()
    }
}
