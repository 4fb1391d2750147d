//! The stage `specular_accumulation`: specular irradiance blended with what was seen in the surface before.

use crate::nodes::demodulate::twin::reflectance;
use crate::nodes::temporal_accumulation::twin::{blend, fresh, ratio_at, AlphaBounds, Reprojected, StrataRatio};
use crate::reference::binary16::LARGEST_HALF;
use crate::reference::bindings::Bindings;
use crate::reference::both_confidences::{change_by, specular_confidence};
use crate::reference::compare::{Reading, Rule, Tolerance, Unit};
use crate::reference::conventions::{is_reset, roughness_channel};
use crate::reference::guide::{unpack_guide, Surface};
use crate::reference::luminance::{luminance, texel_luminance};
use crate::reference::luminance_history::{luminance_history_of, split_luminance_history, LuminanceHistory, Reason};
use crate::reference::material::{classes_beyond, tuning_at};
use crate::reference::reflection::{
    hit_distance_of, lobe_radius, mirror_share, mixed_roughness, pack_reflection, reach, roughness_of, SeenReflection,
    UNKNOWN_ROUGHNESS,
};
use crate::reference::rules::{pixels, rule, STATISTICS};
use crate::reference::scenery::Instances;
use crate::reference::statistics::count;
use crate::reference::surface_motion::unpack_surface_motion;
use crate::reference::virtual_motion::{Mirror, VirtualMotion};
use crate::reference::{render_rect::RenderRect, Image};
use crate::{Counter, Error, FrameConstants, Statistics, Tuning};
use glam::IVec2;

mod agreement;
mod evidence;
mod past;
#[cfg(test)]
mod tests;

use past::BestPast;

/// The smallest weight of the new sample where the past is sure, as a share of that elsewhere: a mirror is accumulated and not filtered,
/// so that all noise of what it shows is left to its history.
const STEADY_ALPHA: f32 = 0.4;

/// Of light that is mixed, the share that a lobe explains where nobody says how much base and coat reflect.
const UNKNOWN_SHARE: f32 = 0.5;

/// Images that the previous frame left.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PreviousSpecular<'a> {
    /// The guide.
    pub guide: &'a Image<[u16; 4]>,
    /// rgb: irradiance.
    pub history: &'a Image<[f32; 4]>,
    /// Unpacked.
    pub luminance_history: &'a Image<LuminanceHistory>,
    /// The image `reflection`, see [`crate::reference::unpack_reflection`].
    pub reflection: &'a Image<u32>,
}

/// Inputs of [`specular_accumulation`]; images have the allocated extent.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SpecularAccumulationInputs<'a> {
    /// The image `guide`, from the stage `import`.
    pub guide: &'a Image<[u16; 4]>,
    /// The image `surface_motion`, from the stage `import`.
    pub surface_motion: &'a Image<[u16; 4]>,
    /// rgb: specular irradiance; alpha: hit distance, as the stage `demodulate` has it (0: unknown; negative: no sample).
    pub noisy: &'a Image<[f32; 4]>,
    /// Whether the history was filtered.
    pub is_filtered: bool,
    /// Whether history that lies between pixels is looked up by a cubic.
    pub is_sharp: bool,
    /// Whether the irradiance is diffuse and specular light together.
    pub is_mixed: bool,
    /// Of mixed light: rgb, the reflectance of base and coat.
    pub reflectances: Option<[&'a Image<[f32; 4]>; 2]>,
    /// x: roughness of the host.
    pub roughness: Option<&'a Image<[f32; 4]>>,
    /// By which instances mirrors and the things in them move.
    pub instances: Instances<'a>,
    /// Confidence in the history.
    pub history_confidence: Option<&'a Image<f32>>,
    /// Whether that of specular light lies in its last bits.
    pub is_beside_diffuse: bool,
    /// Of mixed light: the ratio by which it changed.
    pub light_ratio: Option<StrataRatio<'a>>,
    /// Classes of materials, where the host gives them.
    pub material_class: Option<&'a Image<u32>>,
    /// The previous frame, which is not read in a reset frame.
    pub previous: PreviousSpecular<'a>,
}

/// The least weight of a hit distance one pixel away at which a pixel may show what is seen there.
const SMALLEST_ASIDE: f32 = 0.01;

/// Outputs of [`specular_accumulation`].
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SpecularAccumulationOutputs {
    /// rgb: accumulated irradiance, half precision; alpha 0.
    pub accumulated: Image<[f32; 4]>,
    /// Rounded to halves.
    pub luminance_history: Image<LuminanceHistory>,
    /// See [`crate::reference::unpack_reflection`].
    pub reflection: Image<u32>,
    /// Ids without a transform.
    pub statistics: Statistics,
}

/// The frame with what all of its pixels share.
struct Scene<'a> {
    frame: &'a FrameConstants,
    tuning: &'a Tuning,
    inputs: &'a SpecularAccumulationInputs<'a>,
    rect: RenderRect,
    motion: VirtualMotion<'a>,
    previous_surfaces: Image<Surface>,
}

/// The surface of a pixel, with what is expected of it in the previous frame.
struct Centre {
    mirror: Mirror,
    reprojected: Reprojected,
    /// What contrasts are taken about: the luminance of this frame in the light of the previous one.
    origin: f32,
    /// By which its history is scaled.
    ratio: [f32; 3],
}

/// Accumulates specular light along the motion of surfaces and of what is seen in them, whichever tells more.
pub(crate) fn specular_accumulation(
    frame: &FrameConstants,
    tuning: &Tuning,
    inputs: &SpecularAccumulationInputs,
) -> SpecularAccumulationOutputs {
    let scene = Scene::new(frame, tuning, inputs);
    let texels = Image::compute(inputs.guide.extent(), frame.render_extent, |p| scene.accumulated(p));
    let mut statistics = Statistics::default();
    statistics[Counter::HitId] = count(texels.texels().iter().map(|t| t.4[0]));
    statistics[Counter::SpecularMotion] = count(texels.texels().iter().map(|t| t.4[1]));
    if let Some(classes) = inputs.material_class.filter(|_| inputs.is_mixed) {
        statistics[Counter::MaterialClass] = classes_beyond(frame, classes, inputs.guide);
    }
    SpecularAccumulationOutputs {
        statistics,
        accumulated: texels.map(|t| t.0),
        luminance_history: texels.map(|t| t.1.in_halves()),
        reflection: texels.map(|t| pack_reflection(&t.2, t.3)),
    }
}

impl<'a> Scene<'a> {
    fn new(frame: &'a FrameConstants, tuning: &'a Tuning, inputs: &'a SpecularAccumulationInputs<'a>) -> Self {
        let extent = inputs.guide.extent();
        Self {
            frame,
            tuning,
            inputs,
            rect: RenderRect::new(frame.render_extent),
            motion: VirtualMotion::new(frame, inputs.guide),
            previous_surfaces: match is_reset(frame) {
                true => Image::new(extent, Surface::default()),
                false => Image::compute(extent, frame.previous_render_extent, |p| unpack_guide(inputs.previous.guide.at(p))),
            },
        }
    }
}

impl Scene<'_> {
    fn accumulated(&self, p: IVec2) -> ([f32; 4], LuminanceHistory, SeenReflection, Option<f32>, [bool; 2]) {
        let [r, g, b, own_distance] = self.inputs.noisy.at(p);
        let stored = self.inputs.roughness.map(|image| image.at(self.frame.guide_pixel(p))[roughness_channel(self.frame)]);
        let stored = stored.unwrap_or(UNKNOWN_ROUGHNESS);
        let roughness = roughness_of(self.frame, stored);
        let surface = self.motion.surfaces.at(p);
        let noisy = [r, g, b, own_distance];
        let with = |(texel, luminance_history), seen, share| (texel, luminance_history, seen, share, [false; 2]);
        if surface.is_background() {
            return with(fresh(noisy, Reason::None), SeenReflection { hit_distance: 0.0, roughness }, None);
        }
        let mut c = self.centre(p, surface);
        let (hit_distance, reaches) = self.hit_distance_now(&c, own_distance, roughness);
        let mut seen = SeenReflection { hit_distance, roughness };
        let explained = if self.inputs.is_mixed { self.explained_share(p) } else { 1.0 };
        if self.inputs.is_mixed {
            seen.roughness = mixed_roughness(self.frame, surface.linear_depth, seen, explained);
        }
        // The part of the light that moves as an image does. No ratio scales that.
        let mirrored = explained * mirror_share(seen.roughness);
        if let Some(ratio) = self.inputs.light_ratio {
            c.ratio = ratio_at(self.frame, ratio, p).map(|ratio| ratio.powf(1.0 - mirrored));
        }
        if is_reset(self.frame) {
            return with(fresh(noisy, Reason::Reset), seen, None);
        }
        let unknown = if self.inputs.is_mixed || stored != UNKNOWN_ROUGHNESS { seen.roughness } else { 0.0 };
        let best = self.best_past(&c, &mut seen, unknown, reaches, explained);
        let (texel, luminance_history) =
            best.as_ref().map_or(fresh(noisy, Reason::Depth), |best| self.blend(&c, noisy, mirrored, best));
        let instances = &self.inputs.instances;
        let is_bad = [
            instances.lacks_transform(self.frame, &c.mirror, seen.hit_distance),
            instances.has_bad_motion(&c.mirror, seen.hit_distance),
        ];
        (texel, luminance_history, seen, best.map(|best| best.image_share), is_bad)
    }

    /// Of mixed light: the share of the coat in all that is reflected.
    fn explained_share(&self, p: IVec2) -> f32 {
        let Some(images) = self.inputs.reflectances else { return UNKNOWN_SHARE };
        let [base, coat] = images.map(|image| luminance(reflectance(image.at(self.frame.guide_pixel(p)))));
        if base + coat > 0.0 {
            coat / (base + coat)
        } else {
            UNKNOWN_SHARE
        }
    }

    fn tuning_at(&self, p: IVec2) -> Tuning {
        tuning_at(self.frame, self.tuning, self.inputs.material_class, p)
    }

    fn centre(&self, p: IVec2, surface: Surface) -> Centre {
        let motion = unpack_surface_motion(self.inputs.surface_motion.at(p));
        Centre {
            mirror: self.motion.mirror(p, motion.motion),
            reprojected: Reprojected::new(self.frame, &self.tuning_at(p), (surface, p), &motion),
            origin: (texel_luminance(self.inputs.noisy.at(p)) / self.frame.exposure_ratio.max(1e-20)).min(LARGEST_HALF),
            ratio: [1.0; 3],
        }
    }

    /// Hit distance of this frame, over as many of 3×3 pixels as the lobe blurs, with the least and the greatest reach there. `own`: negative
    /// where there is no sample.
    fn hit_distance_now(&self, c: &Centre, own: f32, roughness: f32) -> (f32, [f32; 2]) {
        let depth = c.mirror.surface.linear_depth;
        let sharpness = |hit_distance| {
            let radius = lobe_radius(self.frame, depth, SeenReflection { hit_distance, roughness });
            (1.0 / (radius * radius).max(1e-6)).min(64.0)
        };
        let own_sharpness = sharpness(own.max(0.0));
        let (mut sum, mut weights, mut reaches) = (0.0, 0.0, [1.0_f32, 0.0]);
        let (mut known, mut unknown) = (0, 0);
        for (offset, q) in self.rect.window(c.mirror.p, 1, 1) {
            let (tap, distance) = (self.motion.surfaces.at(q), self.inputs.noisy.at(q)[3]);
            if distance < 0.0 || tap.is_background() || tap.id != c.mirror.surface.id {
                continue;
            }
            let there = reach(tap.linear_depth, distance);
            reaches = [reaches[0].min(there), reaches[1].max(there)];
            if distance > 0.0 {
                let weight = (-(offset.length_squared() as f32) * own_sharpness).exp2();
                sum += weight * there;
                weights += weight;
                known += 1;
            } else {
                unknown += 1;
            }
        }
        let mean = if weights > 0.0 { hit_distance_of(depth, sum / weights) } else { 0.0 };
        // A mirror that shows nothing of known distance does not show what is seen beside it, unless that is most of what is around: a bad distance.
        let shows_nothing = own == 0.0 && unknown > known && (-sharpness(mean)).exp2() < SMALLEST_ASIDE;
        (if shows_nothing { 0.0 } else { mean }, if reaches[0] > reaches[1] { [0.0, 1.0] } else { reaches })
    }

    /// How far light changed, 0 to 1. `mirrored`: the part of it that moves as an image does.
    fn change_by(&self, confidence: f32, mirrored: f32) -> f32 {
        let of_image = 1.0 - specular_confidence(confidence);
        match (self.inputs.is_beside_diffuse, self.inputs.is_mixed) {
            (false, _) => 1.0 - confidence,
            (true, false) => of_image,
            (true, true) => change_by(confidence) * (1.0 - mirrored) + of_image * mirrored,
        }
    }

    fn blend(&self, c: &Centre, noisy: [f32; 4], mirrored: f32, best: &BestPast) -> ([f32; 4], LuminanceHistory) {
        let (past, p) = (&best.past, c.mirror.p);
        let confidence = self.inputs.history_confidence;
        let change = confidence.map_or(0.0, |confidence| self.change_by(confidence.at(p), mirrored));
        let scale = 1.0 + (STEADY_ALPHA - 1.0) * best.steadiness;
        let tuning = self.tuning_at(p);
        let tuning = Tuning { alpha: tuning.alpha * scale, alpha_moments: tuning.alpha_moments * scale, ..tuning };
        let bounds = AlphaBounds::new(&tuning, confidence.is_some(), false, change);
        let before = LuminanceHistory {
            mean: past.mean,
            deviation: past.variance.sqrt(),
            history_length: past.frames,
            ..LuminanceHistory::default()
        };
        blend(self.frame, noisy, past.irradiance, (&before, past.range), bounds, c.ratio)
    }
}

/// Roughness may be rounded either way, and a hit that is far for its depth is the quotient of two numbers that are next to each other.
const REFLECTED: Tolerance = Tolerance { relative: 3e-3, absolute: 1.01 / 1023.0, outliers: 0.0 };

const TRACKED: Tolerance = Tolerance { relative: 3e-3, absolute: 1e-3, outliers: 5e-3 };

/// Where what was seen before lies is computed by quotients, and a pixel of it counts or not.
pub(crate) const RULES: &[Rule] = &[
    STATISTICS,
    pixels("accumulated", TRACKED),
    rule("new_luminance", Unit::Pixel, Reading::Halves, Tolerance { absolute: 3e-3, ..TRACKED }),
    rule("reflection", Unit::Pixel, Reading::Reflection, REFLECTED),
    rule("reflection", Unit::Pixel, Reading::ImageShare, Tolerance { absolute: 0.05, ..TRACKED }),
];

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let transforms = b.instance_transforms()?;
    let luminance_history = luminance_history_of(b.uint("previous_luminance_history")?);
    let ratio = b.optional_colour("light_ratio")?;
    let light_ratio = ratio.map(|image| b.stratum_size().map(|stratum_size| StrataRatio { image, stratum_size })).transpose()?;
    let inputs = SpecularAccumulationInputs {
        guide: b.packed("guide")?,
        surface_motion: b.packed("surface_motion")?,
        noisy: b.colour("noisy")?,
        is_filtered: b.is_on("FILTERED")?,
        is_sharp: b.is_on("SHARP")?,
        is_mixed: b.is_on("MIXED")?,
        reflectances: b.optional_colour("albedo")?.zip(b.optional_colour("specular_albedo")?).map(Into::into),
        roughness: b.optional_colour("roughness")?,
        history_confidence: b.optional_scalar("history_confidence")?,
        is_beside_diffuse: b.is_on("BESIDE_DIFFUSE")?,
        light_ratio,
        material_class: b.optional_uint("material_class")?,
        instances: Instances {
            hit_id: b.optional_uint("specular_hit_id")?,
            motion: b.optional_colour("specular_motion")?,
            surface_id: b.optional_uint("surface_id")?,
            transforms: transforms.as_deref(),
        },
        previous: PreviousSpecular {
            guide: b.packed("previous_guide")?,
            history: b.colour("history")?,
            luminance_history: &luminance_history,
            reflection: b.uint("previous_reflection")?,
        },
    };
    let outputs = specular_accumulation(b.frame, b.tuning, &inputs);
    b.count(&outputs.statistics)?;
    let (accumulated, new_luminance) = split_luminance_history(&outputs.accumulated, &outputs.luminance_history);
    b.write("accumulated", accumulated)?;
    b.write("new_luminance", new_luminance)?;
    b.write("reflection", outputs.reflection)
}
