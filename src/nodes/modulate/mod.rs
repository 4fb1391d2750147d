//! Multiplies the albedo back, adds the signals and the emission.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::pass;
use crate::contract::{Grid, Input, Lifetime, TexelGrid};
use crate::graph::{Feedback, Graph, Guides, History, Image, Irradiance, Port, Radiance, HDR, WIDE_HDR};
use crate::shaders;

/// Parameters of the node `modulate`.
#[derive(Clone, Copy, Debug)]
pub struct Modulate {
    /// Whether your optional input `albedo` multiplies the irradiance, as for the node
    /// `demodulate`. Default: true.
    pub albedo: bool,
    /// Whether `specular_albedo` is added to `albedo`, as of [`crate::nodes::Albedo::Mixed`]. Default: false.
    pub mixed: bool,
    /// Whether the second signal is specular light, with the optional inputs `specular_albedo` or
    /// `specular_f0` instead of `albedo`: see [`crate::nodes::Albedo::Specular`]. Default: false.
    pub specular: bool,
    /// Whether your optional input `emission` is added. Default: true.
    pub emission: bool,
    /// Whether the radiance is of 32-bit floats instead of halves, as with [`crate::Config::float_output`]. Default: false.
    pub float_output: bool,
    /// The history that this frame's light was accumulated onto, with [`Feedback::Accumulated`]. The detail that noise does not explain, by
    /// [`crate::nodes::Estimator::OfMean`], is taken from it: it is no longer filtered away. Default: none.
    pub detail: Option<History>,
}

impl Default for Modulate {
    fn default() -> Self {
        Self { albedo: true, mixed: false, specular: false, emission: true, float_output: false, detail: None }
    }
}

impl Graph {
    /// Radiance of the sum of one or two signals, each with an irradiance for every rendered pixel,
    /// or for every pixel of the light, which it brings to the rendered ones as [`Self::upsample`] does.
    pub fn modulate(&mut self, guides: &Guides, filtered: &Irradiance, modulate: Modulate) -> Radiance {
        let label = self.label_of(filtered);
        let node = self.node("modulate", &label);
        let is_light = |image: &Image| matches!(self.texels_of(*image), Some(TexelGrid::Light(_)));
        let gathers = filtered.images().iter().all(is_light);
        if !gathers && filtered.images().iter().any(is_light) {
            let problem = "one signal has the pixels of the light, and one those of the guides; give that one to `upsample` first";
            self.fail(&node, "filtered", problem.to_owned());
        }
        let module = match gathers {
            true => [&shaders::MODULATE_FLOAT_0_UPSAMPLED_1, &shaders::MODULATE_FLOAT_1_UPSAMPLED_1],
            false => [&shaders::MODULATE_FLOAT_0, &shaders::MODULATE_FLOAT_1],
        }[usize::from(modulate.float_output)];
        let format = if modulate.float_output { WIDE_HDR } else { HDR };
        let denoised = self.named_image("modulated", &label, format, TexelGrid::Rendered(1), Lifetime::Transient);
        let rendered = self.rendered_inputs(guides);
        let mut pass = pass(&node, module)
            .grid(if gathers { Grid::Pixels } else { Grid::Guides })
            .bind("denoised_radiance", denoised)
            .each("filtered", filtered.images())
            .bind("guide", guides.guide)
            .bind_some("depth", rendered.depth)
            .bind_some("normal", rendered.normal)
            .bind_some("surface_id", rendered.surface_id);
        if rendered.depth.is_some() && rendered.albedo.is_none() {
            pass = pass.constant("APART", 0);
        }
        if modulate.albedo {
            pass = pass.bind("albedo", self.input(Input::ALBEDO));
        }
        if modulate.mixed && !modulate.specular {
            pass = pass.bind("specular_albedo", self.input(Input::SPECULAR_ALBEDO));
        }
        if modulate.specular {
            pass = pass
                .constant("SPECULAR", 1)
                .bind("specular_albedo", self.input(Input::SPECULAR_ALBEDO))
                .bind("specular_f0", self.input(Input::SPECULAR_F0))
                .bind("roughness", self.input(Input::ROUGHNESS));
        }
        if modulate.emission {
            pass = pass.bind("emission", self.input(Input::EMISSION));
        }
        if let Some(history) = modulate.detail {
            if let Some(problem) = self.misfit(&history, filtered, gathers) {
                self.fail(&node, "detail", problem.to_owned());
            } else {
                let luminance = self.current_luminance_history(&history);
                let colour: Vec<Image> = history.colour().iter().map(|image| self.refreshed(*image)).collect();
                pass = pass.each("irradiance_history", &colour).each("luminance_history", &luminance);
            }
        }
        self.add(pass);
        Port::of(self.refreshed(denoised))
    }

    /// The reason why a history is not that of the light that is modulated.
    fn misfit(&self, history: &History, filtered: &Irradiance, gathers: bool) -> Option<&'static str> {
        let grid = |images: &[Image]| images.first().and_then(|image| self.texels_of(*image));
        if history.feedback != Feedback::Accumulated {
            return Some("the history is of filtered light, which has no detail left; leave it out");
        }
        if history.colour().len() != filtered.signals() {
            return Some("the history is of another number of signals than the filtered light; make both of the same port");
        }
        (gathers || grid(history.colour()) != grid(filtered.images()))
            .then_some("the history has the pixels of the light, which are fewer than those of the picture; leave it out")
    }
}
