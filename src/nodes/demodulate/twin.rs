//! The stage `demodulate`: radiance divided by albedo, so that the filters do not blur textures \[SVGF 3\].

use crate::reference::binary16::{store, LARGEST_HALF};
use crate::reference::bindings::Bindings;
use crate::reference::compare::{Reading, Rule, Unit};
use crate::reference::guide::{unpack_guide, Surface};
use crate::reference::holes::{fill_holes, FillHolesInputs, HOLE};
use crate::reference::kept_radiance::{exposed, finite_radiance, is_finite, is_saturated, kept_radiance, pack_halves};
use crate::reference::luminance::luminance;
use crate::reference::reflection::{FARTHEST_HIT, UNKNOWN_HIT};
use crate::reference::rules::{pixels, rounded, rule, HALF, STATISTICS};
use crate::reference::specular_albedo::SpecularF0;
use crate::reference::statistics::count;
use crate::reference::strata::{Strata, NO_PIXEL};
use crate::reference::Image;
use crate::{Counter, Statistics};
use crate::{Error, FrameConstants, Tuning};
use glam::IVec2;
use std::borrow::Cow;

#[cfg(test)]
mod tests;

/// The largest component below which an albedo divides no more than one that has this: little of the light of a dark surface is a
/// reflection, and its neighbours would multiply it. Below half of it, it does not divide at all.
pub(crate) const DARK_ALBEDO: f32 = 0.05;

/// The least component that divides.
pub(crate) const LEAST_ALBEDO: f32 = 0.02;

/// The least component that divides, as a share of the largest one.
pub(crate) const SATURATED_ALBEDO: f32 = 0.1;

/// Inputs of [`demodulate`]; images have the allocated extent.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DemodulateInputs<'a> {
    /// The image `guide`, from the stage `import`.
    pub guide: &'a Image<[u16; 4]>,
    /// rgb: noisy radiance of every signal, linear, scene units.
    pub noisy: &'a [&'a Image<[f32; 4]>],
    /// rgb: albedo at the primary hit.
    pub albedo: Option<&'a Image<[f32; 4]>>,
    /// rgb: reflectance at normal incidence, from which the divisor of specular light comes where there is no albedo.
    pub specular_f0: Option<SpecularF0<'a>>,
    /// x: distance from the surface to what is seen in it, scene units; 0 or infinite: beyond the scene.
    pub specular_hit_distance: Option<&'a Image<[f32; 4]>>,
    /// Whether the light is specular, and the albedo that of a coat or metal.
    pub is_specular: bool,
    /// Whether the input is sub-sampled: pixels without a sample are no bad values then, and others fill them.
    pub is_sub_sampled: bool,
}

/// Outputs of [`demodulate`].
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct DemodulateOutputs {
    /// rgb: irradiance of every signal, half precision; alpha 0, or the hit distance (0: unknown; [`FARTHEST_HIT`]: beyond the scene)
    /// where that is given. [`HOLE`] where the radiance is not finite, and of a whole input what the 3×3 pixels around it gave:
    /// [`EMPTY_HOLE`](crate::reference::holes::EMPTY_HOLE) for nothing.
    pub irradiance: Vec<Image<[f32; 4]>>,
    /// Bad radiances (once a signal) and albedos (once a pixel).
    pub statistics: Statistics,
}

/// What divides light, of an albedo: what is not finite reflects all of it.
pub(crate) fn reflectance([r, g, b, _]: [f32; 4]) -> [f32; 3] {
    [r, g, b].map(|a| if a.is_finite() { a.clamp(0.0, 1.0) } else { 1.0 })
}

fn largest(reflectance: [f32; 3]) -> f32 {
    reflectance.into_iter().fold(0.0, f32::max)
}

fn is_black(reflectance: [f32; 3]) -> bool {
    largest(reflectance) < 0.5 * DARK_ALBEDO
}

/// Whether light is kept apart from all other: its albedo does not divide it, or is unknown.
pub(crate) fn is_apart(albedo: [f32; 4]) -> bool {
    !is_known(albedo) || is_black(reflectance(albedo))
}

fn is_known(albedo: [f32; 4]) -> bool {
    albedo[..3].iter().all(|a| a.is_finite())
}

fn limited(reflectance: [f32; 3]) -> [f32; 3] {
    let least = LEAST_ALBEDO.max(SATURATED_ALBEDO * largest(reflectance));
    reflectance.map(|a| a.max(least))
}

/// The divisor of radiance, with which `modulate` multiplies again: the albedo within 0 to 1, 1 for a component that is not finite,
/// and 1 where it is black. Also whether a component was not finite.
pub(crate) fn divisor(albedo: Option<[f32; 4]>) -> ([f32; 3], bool) {
    let albedo = albedo.unwrap_or([1.0; 4]);
    let reflectance = reflectance(albedo);
    let divisor = match is_black(reflectance) {
        true => [1.0; 3],
        false => limited(reflectance.map(|a| a * (DARK_ALBEDO / largest(reflectance)).max(1.0))),
    };
    (divisor, !is_known(albedo))
}

/// The same of specular light, of which there is little where little is reflected: black divides as a dark albedo does.
fn specular_divisor(albedo: Option<[f32; 4]>) -> ([f32; 3], bool) {
    let albedo = albedo.unwrap_or([1.0; 4]);
    (limited(reflectance(albedo).map(|a| a.max(DARK_ALBEDO))), !is_known(albedo))
}

/// The divisor of a pixel's light, by the host's albedo or that of its reflectance at normal incidence; 1 in the background. Also whether
/// a component was not finite.
pub(crate) fn divisor_at(
    frame: &FrameConstants,
    surface: &Surface,
    albedo: Option<&Image<[f32; 4]>>,
    specular_f0: Option<SpecularF0>,
    is_specular: bool,
    p: IVec2,
) -> ([f32; 3], bool) {
    let traced = frame.guide_pixel(p);
    let given = albedo.map(|albedo| albedo.at(traced));
    let computed = || specular_f0.map(|f0| f0.albedo(frame, traced, p, surface));
    let albedo = given.or_else(computed).filter(|_| !surface.is_background());
    if is_specular {
        specular_divisor(albedo)
    } else {
        divisor(albedo)
    }
}

/// The albedo that divides: of mixed light, base and coat together.
pub(crate) fn with_coat<'a>(
    albedo: Option<&'a Image<[f32; 4]>>,
    coat: Option<&Image<[f32; 4]>>,
) -> Option<Cow<'a, Image<[f32; 4]>>> {
    let albedo = albedo?;
    let Some(coat) = coat else { return Some(Cow::Borrowed(albedo)) };
    Some(Cow::Owned(Image::compute(albedo.extent(), albedo.extent(), |p| {
        let (base, coat) = (albedo.at(p), coat.at(p));
        std::array::from_fn(|i| base[i] + coat[i])
    })))
}

/// A hit distance as half floats hold it, and whether it was bad.
fn stored_hit_distance(distance: f32) -> (f32, bool) {
    match distance {
        UNKNOWN_HIT => (0.0, false),
        d if d.is_nan() || d < 0.0 => (0.0, true),
        0.0 => (FARTHEST_HIT, false),
        d => (d.clamp(1.0 / 16384.0, FARTHEST_HIT), false),
    }
}

/// Divides the radiance of every signal by the albedo. The background passes.
pub(crate) fn demodulate(frame: &FrameConstants, tuning: &Tuning, inputs: &DemodulateInputs) -> DemodulateOutputs {
    let extent = inputs.guide.extent();
    let divisors = Image::compute(extent, frame.render_extent, |p| {
        let surface = unpack_guide(inputs.guide.at(p));
        let f0 = inputs
            .specular_f0
            .filter(|_| inputs.albedo.is_none() && !surface.is_background())
            .map(|f0| f0.image.at(frame.guide_pixel(p)));
        let is_f0_bad = f0.is_some_and(|f0| f0[..3].iter().any(|c| !c.is_finite()));
        let (divisor, is_bad) = divisor_at(frame, &surface, inputs.albedo, inputs.specular_f0, inputs.is_specular, p);
        (divisor, is_bad || is_f0_bad)
    });
    let distances = inputs.specular_hit_distance.map(|image| {
        Image::compute(extent, frame.render_extent, |p| {
            let is_hole = inputs.noisy.first().is_some_and(|noisy| !is_finite(noisy.at(p)));
            match is_hole || unpack_guide(inputs.guide.at(p)).is_background() {
                true => (0.0, false),
                false => stored_hit_distance(image.at(p)[0]),
            }
        })
    });
    let mut statistics = Statistics::default();
    statistics[Counter::Albedo] = count(divisors.texels().iter().map(|d| d.1));
    statistics[Counter::HitDistance] = distances.as_ref().map_or(0, |d| count(d.texels().iter().map(|d| d.1)));
    let mut irradiance = Vec::with_capacity(inputs.noisy.len());
    for noisy in inputs.noisy {
        let texels = Image::compute(extent, frame.render_extent, |p| {
            let ([r, g, b, _], [dr, dg, db]) = (exposed(frame, noisy.at(p)), divisors.at(p).0);
            if is_finite(noisy.at(p)) {
                let irradiance = [r / dr, g / dg, b / db];
                let [r, g, b] = irradiance.map(store);
                ([r, g, b, 0.0], false, is_saturated(irradiance))
            } else {
                ([0.0, 0.0, 0.0, HOLE], !inputs.is_sub_sampled, false)
            }
        });
        statistics[Counter::Radiance] += count(texels.texels().iter().map(|t| t.1));
        statistics[Counter::Saturated] += count(texels.texels().iter().map(|t| t.2));
        let holed = texels.map(|t| t.0);
        let whole = || {
            let inputs = FillHolesInputs { guide: inputs.guide, holed: &holed, radius: 1 };
            fill_holes(frame, tuning, &inputs).0
        };
        let filled = if inputs.is_sub_sampled { holed.clone() } else { whole() };
        irradiance.push(match &distances {
            Some(distances) if irradiance.is_empty() => Image::compute(extent, frame.render_extent, |p| {
                let [r, g, b, alpha] = filled.at(p);
                [r, g, b, if alpha < 0.0 { alpha } else { store(distances.at(p).0) }]
            }),
            _ => filled,
        });
    }
    DemodulateOutputs { irradiance, statistics }
}

/// [`demodulate`] of two signals, the first by `inputs.albedo` and the second, which is specular light, by `specular_albedo`.
pub(crate) fn of_each(
    frame: &FrameConstants,
    tuning: &Tuning,
    inputs: &DemodulateInputs,
    specular_albedo: Option<&Image<[f32; 4]>>,
) -> DemodulateOutputs {
    let (first, second) = inputs.noisy.split_at(1);
    let diffuse = DemodulateInputs { noisy: first, specular_f0: None, specular_hit_distance: None, ..*inputs };
    let mut outputs = demodulate(frame, tuning, &diffuse);
    let specular =
        demodulate(frame, tuning, &DemodulateInputs { noisy: second, albedo: specular_albedo, is_specular: true, ..*inputs });
    outputs.irradiance.extend(specular.irradiance);
    DemodulateOutputs { statistics: outputs.statistics.plus(&specular.statistics), ..outputs }
}

/// Luminance of the radiance of all signals, if it is known, and of the albedo, of every pixel: of these temporal gradients are made
/// \[ASVGF\] 3.3.
pub(crate) fn luminances(
    frame: &FrameConstants,
    guide: &Image<[u16; 4]>,
    noisy: &[&Image<[f32; 4]>],
    albedo: Option<&Image<[f32; 4]>>,
) -> Image<(Option<f32>, f32)> {
    Image::compute(guide.extent(), frame.render_extent, |p| {
        let is_background = unpack_guide(guide.at(p)).is_background();
        let l = kept_radiance(frame, noisy, p).map(|radiance| luminance(radiance).min(LARGEST_HALF));
        let (a, _) = divisor(albedo.filter(|_| !is_background).map(|albedo| albedo.at(frame.guide_pixel(p))));
        (l, luminance(a))
    })
}

/// Luminance of the radiance of all signals, -1 where one is not finite, and of the albedo, of every pixel as two halves: what the next
/// frame compares with.
pub(crate) fn noisy_luminance(
    frame: &FrameConstants,
    guide: &Image<[u16; 4]>,
    noisy: &[&Image<[f32; 4]>],
    albedo: Option<&Image<[f32; 4]>>,
) -> Image<u32> {
    luminances(frame, guide, noisy, albedo).map(|(l, a)| pack_halves([l.unwrap_or(-1.0), *a]))
}

/// Red and blue of the radiance of all signals that are finite, of every pixel as two halves.
pub(crate) fn noisy_red_blue(frame: &FrameConstants, noisy: &[&Image<[f32; 4]>], extent: [u32; 2]) -> Image<u32> {
    Image::compute(extent, frame.render_extent, |p| {
        let [r, _, b] = finite_radiance(frame, noisy, p);
        pack_halves([r, b])
    })
}

/// The pixel whose light is that of a stratum: the candidate, or the first pixel where there is none.
fn candidate(strata: Strata, candidates: &Image<[u16; 4]>, s: IVec2) -> IVec2 {
    match candidates.at(s) {
        [NO_PIXEL, ..] => strata.first_pixel(s),
        [x, y, ..] => IVec2::new(x.into(), y.into()),
    }
}

/// How what it writes is compared with the GPU.
pub(crate) const RULES: &[Rule] = &[
    STATISTICS,
    pixels("irradiance_0", HALF),
    pixels("irradiance_1", HALF),
    rounded("irradiance_0"),
    rounded("irradiance_1"),
    rule("noisy_luminance", Unit::Stratum, Reading::Halves, HALF),
    rule("noisy_red_blue", Unit::Stratum, Reading::Halves, HALF),
];

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let noisy = b.colours("noisy")?;
    let coat = if b.is_on("SPECULAR")? { None } else { b.optional_colour("specular_albedo")? };
    let albedo = with_coat(b.optional_colour("albedo")?, coat);
    let inputs = DemodulateInputs {
        guide: b.packed("guide")?,
        noisy: &noisy,
        albedo: albedo.as_deref(),
        specular_f0: SpecularF0::of(b)?,
        specular_hit_distance: b.optional_colour("specular_hit_distance")?,
        is_specular: b.is_on("COAT")?,
        is_sub_sampled: b.is_on("SAMPLING")?,
    };
    let outputs = match b.is_on("SPECULAR")? {
        true => of_each(b.frame, b.tuning, &inputs, b.optional_colour("specular_albedo")?),
        false => demodulate(b.frame, b.tuning, &inputs),
    };
    b.count(&outputs.statistics)?;
    b.write_signals("irradiance", outputs.irradiance)?;
    if b.has("noisy_luminance") {
        let other = b.has("compared_0").then(|| b.colours("compared")).transpose()?;
        let compared = other.as_ref().unwrap_or(&noisy);
        let (strata, extent) = (Strata::new(b.frame, b.stratum_size()?), b.extent_of("noisy_luminance")?);
        let candidates = if b.has("candidates") { Some(b.packed("candidates")?) } else { None };
        let of_strata = |pixels: Image<u32>| {
            Image::compute(extent, strata.count().into(), |s| pixels.at(candidates.map_or(s, |c| candidate(strata, c, s))))
        };
        b.write("noisy_luminance", of_strata(noisy_luminance(b.frame, inputs.guide, compared, inputs.albedo)))?;
        if b.has("noisy_red_blue") {
            b.write("noisy_red_blue", of_strata(noisy_red_blue(b.frame, compared, inputs.guide.extent())))?;
        }
    }
    Ok(())
}
