//! The stage `sample_albedo`: light of gradient samples over the albedo of the points that it comes from.

use crate::nodes::demodulate::twin::{divisor_at, with_coat};
use crate::reference::binary16::store;
use crate::reference::bindings::Bindings;
use crate::reference::compare::Rule;
use crate::reference::conventions::{is_reset, is_reshaded};
use crate::reference::guide::unpack_guide;
use crate::reference::rules::{pixels, strata, HALF};
use crate::reference::specular_albedo::SpecularF0;
use crate::reference::strata::{unpack_gradient_sample, Strata};
use crate::reference::Image;
use crate::{Error, FrameConstants};
use glam::{IVec2, UVec2};

/// Inputs of [`sample_albedo`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct SampleAlbedoInputs<'a> {
    /// The image `guide`, from the stage `import`.
    pub guide: &'a Image<[u16; 4]>,
    /// The image `gradient_samples`, from the stage `forward_project`.
    pub gradient_samples: &'a Image<[u16; 4]>,
    /// The image `gradient_candidates` of this frame, from the same stage.
    pub candidates: &'a Image<[u16; 4]>,
    /// `candidate_albedo` of the previous frame; not read in a reset frame.
    pub previous_candidate_albedo: Option<&'a Image<[f32; 4]>>,
    /// rgb: irradiance of every signal, as written by `demodulate`.
    pub irradiance: &'a [&'a Image<[f32; 4]>],
    /// rgb: albedo by which `demodulate` divided.
    pub albedo: Option<&'a Image<[f32; 4]>>,
    /// rgb: reflectance at normal incidence, where that made the divisor.
    pub specular_f0: Option<SpecularF0<'a>>,
    /// Whether the light is specular, and the albedo that of a coat or metal.
    pub is_specular: bool,
}

/// Outputs of [`sample_albedo`].
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SampleAlbedoOutputs {
    /// rgb: irradiance of every signal; half precision.
    pub irradiance: Vec<Image<[f32; 4]>>,
    /// One texel a stratum: the divisor at the pixel that the next frame carries forward; half precision.
    pub candidate_albedo: Image<[f32; 4]>,
}

/// Divides the irradiance of every sample by the divisor of its own point, in the place of that of its pixel.
pub(crate) fn sample_albedo(frame: &FrameConstants, stratum_size: u32, inputs: &SampleAlbedoInputs) -> SampleAlbedoOutputs {
    let strata = Strata::new(frame, stratum_size);
    let divisor_at = |p: IVec2| {
        let surface = unpack_guide(inputs.guide.at(p));
        let (divisor, _) = divisor_at(frame, &surface, inputs.albedo, inputs.specular_f0, inputs.is_specular, p);
        divisor.map(store)
    };
    let last_pixel = UVec2::from(frame.render_extent).as_ivec2() - 1;
    let candidate_albedo = Image::compute(inputs.candidates.extent(), strata.count().into(), |s| {
        let [x, y, ..] = inputs.candidates.at(s).map(i32::from);
        let [r, g, b] = divisor_at(IVec2::new(x, y).min(last_pixel));
        [r, g, b, 0.0]
    });
    let factor_at = |p: IVec2| {
        let s = p / stratum_size as i32;
        let previous = inputs.previous_candidate_albedo.filter(|_| is_reshaded(frame) && !is_reset(frame))?;
        let sample = unpack_gradient_sample(stratum_size, s.as_uvec2().into(), inputs.gradient_samples.at(s))?;
        let before = previous.at(UVec2::from(sample.previous_pixel).as_ivec2() / stratum_size as i32);
        let is_sample = UVec2::from(sample.pixel).as_ivec2() == p;
        is_sample.then(|| divisor_at(p)).map(|now| [0, 1, 2].map(|i| now[i] / before[i]))
    };
    let factors = Image::compute(inputs.guide.extent(), frame.render_extent, |p| factor_at(p).unwrap_or([1.0; 3]));
    let corrected = |irradiance: &&Image<[f32; 4]>| {
        Image::compute(irradiance.extent(), frame.render_extent, |p| {
            let [r, g, b, a] = irradiance.at(p);
            let [fr, fg, fb] = factors.at(p);
            [store(r * fr), store(g * fg), store(b * fb), a]
        })
    };
    SampleAlbedoOutputs { irradiance: inputs.irradiance.iter().map(corrected).collect(), candidate_albedo }
}

/// How what it writes is compared with the GPU.
pub(crate) const RULES: &[Rule] = &[
    pixels("irradiance_0", HALF),
    pixels("irradiance_1", HALF),
    strata("candidate_albedo_0", HALF),
    strata("candidate_albedo_1", HALF),
];

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let (albedo, specular_albedo) = (b.optional_colour("albedo")?, b.optional_colour("specular_albedo")?);
    let (is_of_each, specular_f0, size) = (b.is_on("SPECULAR")?, SpecularF0::of(b)?, b.stratum_size()?);
    let (irradiance, albedo) = (b.colours("irradiance")?, with_coat(albedo, specular_albedo.filter(|_| !is_of_each)));
    let first = SampleAlbedoInputs {
        guide: b.packed("guide")?,
        gradient_samples: b.packed("gradient_samples")?,
        candidates: b.packed("candidates")?,
        previous_candidate_albedo: b.optional_colour("previous_candidate_albedo_0")?,
        irradiance: if is_of_each { &irradiance[..1] } else { &irradiance },
        albedo: albedo.as_deref(),
        specular_f0: specular_f0.filter(|_| !is_of_each),
        is_specular: b.is_on("COAT")?,
    };
    let mut outputs = sample_albedo(b.frame, size, &first);
    if is_of_each {
        let previous_candidate_albedo = b.optional_colour("previous_candidate_albedo_1")?;
        let irradiance = &irradiance[1..];
        let is_specular = true;
        let second = SampleAlbedoInputs {
            previous_candidate_albedo,
            irradiance,
            albedo: specular_albedo,
            specular_f0,
            is_specular,
            ..first
        };
        let specular = sample_albedo(b.frame, size, &second);
        b.write("candidate_albedo_1", specular.candidate_albedo)?;
        outputs.irradiance.extend(specular.irradiance);
    }
    b.write("candidate_albedo_0", outputs.candidate_albedo)?;
    b.write_signals("irradiance", outputs.irradiance)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::binary16::round_to_half;
    use crate::reference::test_scene::*;
    use crate::reference::{pack_gradient_sample, GradientSample};
    use crate::Flags;

    const EXTENT: [u32; 2] = [6, 3];

    /// A pattern of stripes: the left stratum repeats at pixel (1, 2) a sample of pixel (4, 0) of the frame before.
    fn of(frame: &FrameConstants, previous: [f32; 4]) -> SampleAlbedoOutputs {
        let guides = guides(EXTENT, |_, _| surface(4.0));
        let sample = GradientSample { pixel: [1, 2], previous_pixel: [4, 0] };
        let albedo = paint(EXTENT, |x, _| if x % 2 == 0 { [0.8, 0.4, 0.2, 0.0] } else { [0.1, 0.2, 0.0, 0.0] });
        let divisors = paint([2, 1], |x, _| if x == 1 { previous } else { [f32::NAN; 4] });
        let inputs = SampleAlbedoInputs {
            guide: &guides.guide,
            gradient_samples: &paint([2, 1], |x, _| pack_gradient_sample(3, (x == 0).then_some(sample))),
            candidates: &paint([2, 1], |x, _| [x as u16 * 3 + 2, 1, 0, 0]),
            previous_candidate_albedo: Some(&divisors),
            irradiance: &[&Image::new(EXTENT, [2.0, 3.0, 5.0, 7.0]), &Image::new(EXTENT, [1.0, 1.0, 1.0, 0.0])],
            albedo: Some(&albedo),
            specular_f0: None,
            is_specular: false,
        };
        sample_albedo(frame, 3, &inputs)
    }

    fn reshaded_frame() -> FrameConstants {
        let frame = frame(EXTENT);
        FrameConstants { flags: frame.flags | Flags::RESHADED, ..frame }
    }

    #[test]
    fn a_sample_alone_is_divided_by_the_albedo_of_its_own_point() {
        let outputs = of(&reshaded_frame(), [0.8, 0.4, 0.2, 0.0]);
        for (image, before) in outputs.irradiance.iter().zip([[2.0, 3.0, 5.0, 7.0], [1.0, 1.0, 1.0, 0.0]]) {
            for (i, texel) in image.texels().iter().enumerate() {
                // Blue of the pixel divides by a tenth of its green.
                let factor = if i == 2 * 6 + 1 { [0.125, 0.5, 0.1, 1.0] } else { [1.0; 4] };
                let near = (0..4).all(|c| (texel[c] - factor[c] * before[c]).abs() <= 2e-3 * before[c]);
                assert!(near, "pixel {i}: {texel:?} of {before:?}");
            }
        }
        let kept = outputs.candidate_albedo.texels();
        assert_eq!(kept[0], [0.8, 0.4, 0.2, 0.0].map(round_to_half), "of pixel (2, 1)");
        assert_eq!(kept[1], [0.1, 0.2, 0.02, 0.0].map(round_to_half), "of pixel (5, 1)");
    }

    #[test]
    fn without_samples_nothing_changes() {
        let reset = FrameConstants { flags: reshaded_frame().flags | Flags::RESET, ..reshaded_frame() };
        for frame in [frame(EXTENT), reset] {
            let outputs = of(&frame, [f32::NAN; 4]);
            assert!(outputs.irradiance[0].texels().iter().all(|t| *t == [2.0, 3.0, 5.0, 7.0]));
        }
    }
}
