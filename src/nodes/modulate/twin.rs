//! The stage `modulate`: irradiance multiplied by albedo again, signals summed, emission added \[SVGF 3\].

use crate::nodes::demodulate::twin::{divisor, divisor_at, reflectance, with_coat};
use crate::nodes::import::twin::rendered_guide;
use crate::nodes::upsample::twin::{upsample, UpsampleInputs};
use crate::reference::bindings::Bindings;
use crate::reference::compare::{Condition, Rule};
use crate::reference::conventions::is_demodulated;
use crate::reference::guide::unpack_guide;
use crate::reference::outgoing::Outgoing;
use crate::reference::rules::{pixels, rounded, HALF, STATISTICS, WEIGHTED};
use crate::reference::specular_albedo::SpecularF0;
use crate::reference::statistics::count;
use crate::reference::Image;
use crate::{Counter, Statistics};
use crate::{Error, FrameConstants};

mod detail;
#[cfg(test)]
mod tests;

use detail::restored;

/// Albedos of specular light, as the stage `demodulate` was given them.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct SpecularAlbedos<'a> {
    /// rgb: reflectance of the coat or metal under light from everywhere.
    pub albedo: Option<&'a Image<[f32; 4]>>,
    /// rgb: reflectance at normal incidence, for a host without the other.
    pub f0: Option<SpecularF0<'a>>,
}

/// Inputs of [`modulate`]; images have the allocated extent.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ModulateInputs<'a> {
    /// Guides of every rendered pixel.
    pub guide: &'a Image<[u16; 4]>,
    /// rgb: denoised irradiance of every signal.
    pub irradiance: &'a [&'a Image<[f32; 4]>],
    /// rgb: albedo, the one that `demodulate` was given.
    pub albedo: Option<&'a Image<[f32; 4]>>,
    /// rgb: albedo and reflectance at normal incidence of specular light, where the second signal is that.
    pub specular: Option<SpecularAlbedos<'a>>,
    /// rgb: radiance that is added as it is.
    pub emission: Option<&'a Image<[f32; 4]>>,
    /// What `denoised_radiance` can hold.
    pub outgoing: Outgoing,
}

/// Outputs of [`modulate`].
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ModulateOutputs {
    /// rgb: linear radiance, from 0 on; alpha 1.
    pub denoised_radiance: Image<[f32; 4]>,
    /// Bad emissions. Bad albedos were counted by `demodulate`, unless light came divided.
    pub statistics: Statistics,
}

/// `Σ_signals c·divisor + emission`, with the divisor of each signal, or the albedo where light came divided.
pub(crate) fn modulate(frame: &FrameConstants, inputs: &ModulateInputs) -> ModulateOutputs {
    let texels = Image::compute(inputs.guide.extent(), frame.render_extent, |p| {
        let surface = unpack_guide(inputs.guide.at(p));
        let albedo = inputs.albedo.filter(|_| !surface.is_background()).map(|albedo| albedo.at(p));
        let (divisor_of_albedo, is_albedo_bad) = divisor(albedo);
        let comes_divided = is_demodulated(frame);
        let albedo = if comes_divided { reflectance(albedo.unwrap_or([1.0; 4])) } else { divisor_of_albedo };
        let of_coat = |s: SpecularAlbedos| divisor_at(frame, &surface, s.albedo, s.f0, true, p).0;
        let factors = [albedo, inputs.specular.map_or(albedo, of_coat)];
        let [r, g, b, _] = inputs.emission.map_or([0.0; 4], |emission| emission.at(p));
        let is_bad = [r, g, b].iter().any(|e| !e.is_finite());
        let emission = if is_bad { [0.0; 3] } else { [r, g, b] };
        let radiance = [0, 1, 2].map(|i| {
            let reflected: f32 = inputs.irradiance.iter().zip(factors).map(|(signal, albedo)| signal.at(p)[i] * albedo[i]).sum();
            reflected * frame.inverse_filter_exposure + emission[i]
        });
        let [r, g, b] = radiance.map(|c| inputs.outgoing.store(c));
        ([r, g, b, 1.0], is_bad, inputs.outgoing.is_too_bright(radiance), comes_divided && is_albedo_bad)
    });
    let mut statistics = Statistics::default();
    statistics[Counter::Emission] = count(texels.texels().iter().map(|t| t.1));
    statistics[Counter::Saturated] = count(texels.texels().iter().map(|t| t.2));
    statistics[Counter::Albedo] = count(texels.texels().iter().map(|t| t.3));
    ModulateOutputs { denoised_radiance: texels.map(|t| t.0), statistics }
}

/// How what it writes is compared with the GPU.
pub(crate) const RULES: &[Rule] = &[
    STATISTICS,
    Rule { when: Condition::IsNot("GATHERS", 1), ..pixels("denoised_radiance", HALF) },
    Rule { when: Condition::Neither(["GATHERS", "WIDE"]), ..rounded("denoised_radiance") },
    Rule { when: Condition::Is("GATHERS", 1), ..pixels("denoised_radiance", WEIGHTED) },
];

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let specular = b.is_on("SPECULAR")?;
    let (rendered_guide, guide, filtered) = (rendered_guide(b, b.is_on("APART")?)?, b.packed("guide")?, b.colours("filtered")?);
    let gathers = b.is_on("GATHERS").unwrap_or(false);
    let upsampled = gathers.then(|| {
        let inputs = UpsampleInputs { rendered_guide: &rendered_guide, guide, is_volume: false, filtered: &filtered };
        upsample(b.frame, &inputs, |irradiance| irradiance)
    });
    let restored = b.has("irradiance_history_0").then(|| restored(b, &filtered)).transpose()?;
    let irradiance = upsampled.as_ref().or(restored.as_ref()).map_or(filtered, |images| images.iter().collect());
    let coat = b.optional_colour("specular_albedo")?;
    let albedo = with_coat(b.optional_colour("albedo")?, coat.filter(|_| !specular));
    let inputs = ModulateInputs {
        guide: &rendered_guide,
        irradiance: &irradiance,
        albedo: albedo.as_deref(),
        specular: specular.then_some(SpecularAlbedos { albedo: coat, f0: SpecularF0::of(b)? }),
        emission: b.optional_colour("emission")?,
        outgoing: Outgoing::of(b)?,
    };
    let outputs = modulate(&b.frame.of_guides(), &inputs);
    b.count(&outputs.statistics)?;
    b.write("denoised_radiance", outputs.denoised_radiance)
}
