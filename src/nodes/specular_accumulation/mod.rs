//! Blends specular light with its own past, found at the previous places of the surface and of the
//! image behind it. \[Zimmer et al. 2015\], \[Stachowiak 2015\]
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::pass;
use crate::contract::{Input, Lifetime};
use crate::graph::{Accumulated, Confidence, Feedback, Graph, Guides, History, Irradiance, LightRatio, Port, Reflection, Value};
use crate::graph::{HDR, PACKED_32};
use crate::shaders;

/// Parameters of the node `specular_accumulation`.
#[derive(Clone, Copy, Debug, Default)]
pub struct SpecularAccumulation {
    /// Confidence that may shorten the history of a pixel \[ASVGF\]. Default: none.
    pub confidence: Option<Confidence>,
    /// Smallest weight of the new sample. Default: [`crate::Tuning::alpha`].
    pub alpha: Value,
    /// Smallest weight of the new sample in the moments. Default: [`crate::Tuning::alpha_moments`].
    pub alpha_moments: Value,
    /// Whether history between pixels is read by the cubic of Catmull and Rom over 4x4 pixels,
    /// where the lobe covers less than about 4 pixels: motion does not blur reflections then.
    /// Default: false.
    pub sharp: bool,
    /// Whether the irradiance is diffuse and specular light together: [`crate::config::Signals::Mixed`]. The optional inputs `albedo`
    /// and `specular_albedo` tell how much of it a lobe explains.
    /// Default: false.
    pub mixed: bool,
    /// Of light that is mixed, the ratio by which it changed: history is scaled by it as far as it is no image of something else.
    /// Default: none.
    pub light_ratio: Option<LightRatio>,
}

/// History of specular light, with the image that its accumulation writes.
#[derive(Clone, Copy, Debug)]
pub struct SpecularHistory {
    /// The history that the next frame reads; give it to the node `variance`.
    pub history: History,
    accumulated: Accumulated,
    feedback: Feedback,
}

/// Outputs of the node `specular_accumulation`.
#[derive(Clone, Copy, Debug)]
pub struct AccumulatedSpecular {
    /// Specular irradiance, blended with its past.
    pub accumulated: Accumulated,
    /// Reflections in the surfaces.
    pub reflection: Reflection,
}

impl Graph {
    /// Makes the history of [`Self::specular_accumulation`] for the next frame. Make it before the
    /// nodes that read the previous one.
    pub fn specular_history(&mut self, irradiance: &Irradiance, feedback: Feedback) -> SpecularHistory {
        let label = self.label_of(irradiance);
        let accumulated: Accumulated = Port::of(self.named_image("accumulated", &label, HDR, 1, Lifetime::Transient));
        SpecularHistory { history: self.history(&accumulated, feedback), accumulated, feedback }
    }

    /// Accumulates specular light, demodulated by [`Self::demodulate`] with
    /// [`crate::nodes::Albedo::Specular`]; one signal. The optional input `roughness` gives the
    /// width of lobes; without it all surfaces are rough. The optional inputs `specular_hit_id` and
    /// `instance_transforms`, with the `surface_id` of [`Self::import`], or `specular_motion`, follow what moves.
    pub fn specular_accumulation(
        &mut self,
        guides: &Guides,
        irradiance: &Irradiance,
        history: &SpecularHistory,
        parameters: SpecularAccumulation,
    ) -> AccumulatedSpecular {
        let label = self.label_of(irradiance);
        let node = self.node("specular_accumulation", &label);
        if irradiance.signals() != 1 {
            self.fail(&node, "irradiance", "two signals were given; specular light is one".to_owned());
        }
        let SpecularHistory { history, accumulated, feedback } = history;
        let reflection = self.named_image("reflection", &label, PACKED_32, 1, Lifetime::History);
        let pass = pass(&node, &shaders::SPECULAR_ACCUMULATION)
            .constant("FILTERED", u32::from(*feedback == Feedback::Filtered))
            .constant("SHARP", u32::from(parameters.sharp))
            .constant("MIXED", u32::from(parameters.mixed))
            .constant("BESIDE_DIFFUSE", parameters.confidence.is_some_and(|confidence| self.is_of_both(&confidence)).into())
            .value("alpha", parameters.alpha)
            .value("alpha_moments", parameters.alpha_moments)
            .bind("guide", guides.guide)
            .previous("previous_guide", guides.guide)
            .bind("surface_motion", guides.surface_motion)
            .bind("noisy", irradiance.image())
            .bind("roughness", self.input(Input::ROUGHNESS))
            .bind_some("history_confidence", parameters.confidence.map(|confidence| confidence.image()))
            .bind("specular_hit_id", self.input(Input::SPECULAR_HIT_ID))
            .bind("specular_motion", self.input(Input::SPECULAR_MOTION))
            .bind_some("surface_id", self.given(Input::SURFACE_ID))
            .bind("instance_transforms", self.input(Input::INSTANCE_TRANSFORMS))
            .bind_some("material_class", guides.material_class)
            .previous("history", history.colour()[0])
            .previous("previous_luminance_history", history.luminance_history()[0])
            .previous("previous_reflection", reflection)
            .bind("accumulated", accumulated.image())
            .bind("new_luminance", history.new_luminance()[0])
            .bind("reflection", reflection);
        let pass = match parameters.mixed {
            true => pass.bind("albedo", self.input(Input::ALBEDO)).bind("specular_albedo", self.input(Input::SPECULAR_ALBEDO)),
            false => pass,
        };
        let pass = match parameters.light_ratio.filter(|_| parameters.mixed) {
            Some(ratio) => pass.constant("STRATUM_SIZE", ratio.stratum_size).bind("light_ratio", ratio.image),
            None => pass,
        };
        self.add(pass);
        AccumulatedSpecular {
            accumulated: self.renewed(accumulated).with_holes_of(irradiance),
            reflection: Reflection { image: self.refreshed(reflection), mixed: parameters.mixed },
        }
    }
}
