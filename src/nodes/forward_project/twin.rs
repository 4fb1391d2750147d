//! The stage `forward_project` \[ASVGF 3.1, 3.3\]: one pixel of every stratum of the previous frame, found in this one, to be
//! shaded again.

use crate::config::MotionUnit;
use crate::reference::bindings::Bindings;
use crate::reference::compare::Rule;
use crate::reference::conventions::{is_reset, motion_points_up, motion_unit};
use crate::reference::forward_projection::{
    covering_pixel, invert_transform, is_visible, previous_world_position, project, ForwardPosition,
};
use crate::reference::guide::{pcg, unpack_guide};
use crate::reference::reprojection::{about_eye, InstanceTransform};
use crate::reference::rules::{strata, EXACT, STATISTICS};
use crate::reference::strata::{pack_gradient_sample, GradientSample, Strata, NO_PIXEL};
use crate::reference::Image;
use crate::{Counter, Statistics};
use crate::{Error, FrameConstants, Tuning};
use glam::{IVec2, UVec2, Vec4};

#[cfg(test)]
mod tests;

/// Candidates and keys are drawn apart: what is picked in one frame must not rank it in the next.
const CANDIDATE_SALT: u32 = 0x9e37_79b9;

/// Inputs of both passes; guides have the allocated extent, candidates one texel a stratum of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ForwardProjectInputs<'a> {
    /// The image `guide`, from the stage `import`.
    pub guide: &'a Image<[u16; 4]>,
    /// Guide and candidates of the previous frame. Not read in a reset frame; `None` is treated as one.
    pub previous: Option<PreviousCandidates<'a>>,
    /// Transforms of the host's instances, as for `import`: indexed by surface id, previous from current.
    pub instance_transforms: Option<&'a [InstanceTransform]>,
    /// Motion of the host at the pixels of the previous frame. xy: motion to this frame, in the unit of the conventions; z: linear
    /// depth in this frame, 0 or less where the matrices shall do.
    pub forward_motion: Option<&'a Image<[f32; 4]>>,
    /// Pixels a side of a stratum.
    pub stratum_size: u32,
}

/// Guide and candidates that the previous frame left.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PreviousCandidates<'a> {
    /// The guide of the previous frame.
    pub guide: &'a Image<[u16; 4]>,
    /// The image `candidates`, from [`forward_project_resolve`].
    pub candidates: &'a Image<[u16; 4]>,
}

/// Outputs of [`forward_project_resolve`], one texel a stratum of the allocated extent.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ForwardProjectOutputs {
    /// See [`crate::reference::unpack_gradient_sample`].
    pub gradient_samples: Image<[u16; 4]>,
    /// x, y: the pixel that the next frame carries forward, 65535 for none; z, w: its surface id.
    pub gradient_candidates: Image<[u16; 4]>,
}

/// Projects the candidates of the previous frame. Each claims the stratum that it lands in: the largest key stays, 0 is nobody's.
/// Counts the forward motions that are not finite.
pub(crate) fn forward_project_claim(
    frame: &FrameConstants,
    tuning: &Tuning,
    inputs: &ForwardProjectInputs,
    claims: &mut Image<u32>,
) -> Statistics {
    let mut statistics = Statistics::default();
    let Some(previous) = inputs.previous.filter(|_| !is_reset(frame)) else { return statistics };
    let projection = Projection { frame, tuning, inputs, previous };
    let count = Strata::of_previous(frame, inputs.stratum_size).count().element_product();
    for index in 0..count {
        match projection.sample(index) {
            Ok(sample) => {
                let [x, y] = sample.pixel.map(|v| (v / inputs.stratum_size) as i32);
                if let Some(claim) = claims.get_mut(x, y) {
                    *claim = key_of(frame, index, count).max(*claim);
                }
            }
            Err(Lost::BadMotion) => statistics[Counter::ForwardMotion] += 1,
            Err(Lost::Gone) => {}
        }
    }
    statistics
}

/// Writes down the sample whose key stayed in each stratum, and picks the candidates of the next frame; `surface_id` are the host's
/// ids.
pub(crate) fn forward_project_resolve(
    frame: &FrameConstants,
    tuning: &Tuning,
    inputs: &ForwardProjectInputs,
    claims: &Image<u32>,
    surface_id: Option<&Image<u32>>,
) -> ForwardProjectOutputs {
    let strata = Strata::new(frame, inputs.stratum_size);
    let projection = inputs.previous.map(|previous| Projection { frame, tuning, inputs, previous });
    let mask = key_mask(Strata::of_previous(frame, inputs.stratum_size).count().element_product());
    let texels = Image::compute(claims.extent(), strata.count().into(), |s| {
        let index = (claims.at(s) & mask).checked_sub(1);
        let sample = index.and_then(|index| projection.as_ref()?.sample(index).ok());
        (pack_gradient_sample(strata.size, sample), next_candidate(frame, strata, surface_id, s, sample))
    });
    ForwardProjectOutputs { gradient_samples: texels.map(|t| t.0), gradient_candidates: texels.map(|t| t.1) }
}

/// The bits of a key that hold the number of a stratum.
fn key_mask(count: u32) -> u32 {
    (2 << count.max(1).ilog2()) - 1
}

/// The rank of a sample in its stratum: a hash above, the number of the stratum in the previous frame plus 1 below.
fn key_of(frame: &FrameConstants, index: u32, count: u32) -> u32 {
    (pcg(index.wrapping_add(pcg(frame.frame_index))) & !key_mask(count)) | (index + 1)
}

/// Picks any pixel of the stratum but the one that is a gradient sample in this frame.
fn next_candidate(
    frame: &FrameConstants,
    strata: Strata,
    ids: Option<&Image<u32>>,
    s: IVec2,
    sample: Option<GradientSample>,
) -> [u16; 4] {
    let others: Vec<IVec2> =
        strata.pixels(s).map(|(_, p)| p).filter(|p| sample.is_none_or(|taken| p.as_uvec2() != UVec2::from(taken.pixel))).collect();
    if others.is_empty() {
        return [NO_PIXEL, NO_PIXEL, 0, 0];
    }
    let index = s.x as u32 + s.y as u32 * strata.count().x;
    let chosen = pcg(index.wrapping_add(pcg(frame.frame_index.wrapping_add(CANDIDATE_SALT)))) % others.len() as u32;
    let pixel = others[chosen as usize];
    let id = ids.map_or(u32::MAX, |ids| ids.at(frame.guide_pixel(pixel)));
    [pixel.x as u16, pixel.y as u16, id as u16, (id >> 16) as u16]
}

/// The reason why a candidate is no sample.
enum Lost {
    /// The candidate is not visible in this frame, or there was none.
    Gone,
    /// The host's forward motion is not finite.
    BadMotion,
}

struct Projection<'a> {
    frame: &'a FrameConstants,
    tuning: &'a Tuning,
    inputs: &'a ForwardProjectInputs<'a>,
    previous: PreviousCandidates<'a>,
}

impl Projection<'_> {
    /// The candidate of a stratum of the previous frame in this one, where it is visible.
    fn sample(&self, index: u32) -> Result<GradientSample, Lost> {
        let width = Strata::of_previous(self.frame, self.inputs.stratum_size).count().x;
        let stratum = UVec2::new(index % width, index / width);
        let [x, y, id_low, id_high] = self.previous.candidates.at(stratum.as_ivec2());
        if x == NO_PIXEL {
            return Err(Lost::Gone);
        }
        let previous_pixel = IVec2::new(x.into(), y.into());
        let surface = unpack_guide(self.previous.guide.at(previous_pixel));
        if surface.is_background() {
            return Err(Lost::Gone);
        }
        let position = match self.host_position(previous_pixel) {
            Host::Position(position) => position,
            Host::Bad => return Err(Lost::BadMotion),
            Host::Nothing => {
                let id = u32::from(id_low) | u32::from(id_high) << 16;
                let world = previous_world_position(self.frame, previous_pixel, surface.linear_depth);
                project(self.frame, self.carried(world, id).ok_or(Lost::Gone)?)
            }
        };
        let pixel = covering_pixel(self.frame, &position).ok_or(Lost::Gone)?;
        let now = unpack_guide(self.inputs.guide.at(pixel));
        let is_same = !now.is_background() && now.id == surface.id;
        (is_same && is_visible(self.tuning, &position, now.linear_depth, now.gradient))
            .then(|| GradientSample { pixel: pixel.as_uvec2().into(), previous_pixel: previous_pixel.as_uvec2().into() })
            .ok_or(Lost::Gone)
    }

    /// The world position in this frame. An instance beyond the end, or with an entry that is not finite, did not move; `None`
    /// where its transform has no inverse.
    fn carried(&self, world: Vec4, id: u32) -> Option<Vec4> {
        let transform = self.inputs.instance_transforms.and_then(|t| t.get(id as usize));
        match transform.filter(|t| t.iter().flatten().all(|x| x.is_finite())) {
            Some(transform) => invert_transform(&about_eye(self.frame, transform), world),
            None => Some(world),
        }
    }

    fn host_position(&self, pixel: IVec2) -> Host {
        let Some([x, y, z, _]) = self.inputs.forward_motion.map(|m| m.at(pixel)) else { return Host::Nothing };
        if ![x, y, z].iter().all(|v| v.is_finite()) {
            return Host::Bad;
        }
        if z <= 0.0 {
            return Host::Nothing;
        }
        let frame = self.frame;
        let numerator = |i: usize| {
            let (extent, previous) = (frame.render_extent[i] as f32, frame.previous_render_extent[i] as f32);
            let motion = [x, y][i]
                * (match motion_unit(frame) {
                    MotionUnit::Pixels => 1.0,
                    MotionUnit::Uv => extent,
                    MotionUnit::Ndc => extent * 0.5,
                } * frame.motion_scale);
            let motion = if i == 1 && motion_points_up(frame) { -motion } else { motion };
            let start = pixel.as_vec2()[i] + 0.5 + frame.previous_jitter[i];
            start * extent + (motion - frame.jitter[i]) * previous
        };
        Host::Position(ForwardPosition {
            numerator: [numerator(0), numerator(1)],
            denominator: frame.previous_render_extent.map(|side| side as f32),
            depth: z,
            depth_denominator: 1.0,
        })
    }
}

/// Forward motion of a pixel as the host gives it.
enum Host {
    Nothing,
    Bad,
    Position(ForwardPosition),
}

/// Equal to the bit; claims lie a texel a stratum.
pub(crate) const RULES: &[Rule] =
    &[STATISTICS, strata("claims", EXACT), strata("gradient_samples", EXACT), strata("candidates", EXACT)];

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let transforms = b.instance_transforms()?;
    let inputs = ForwardProjectInputs {
        guide: b.packed("guide")?,
        previous: Some(PreviousCandidates { guide: b.packed("previous_guide")?, candidates: b.packed("previous_candidates")? }),
        instance_transforms: transforms.as_deref(),
        forward_motion: b.optional_colour("forward_motion")?,
        stratum_size: b.stratum_size()?,
    };
    let claims = b.uint("claims")?;
    if b.has("gradient_samples") {
        let outputs = forward_project_resolve(b.frame, b.tuning, &inputs, claims, b.optional_uint("surface_id")?);
        b.write("gradient_samples", outputs.gradient_samples)?;
        return b.write("candidates", outputs.gradient_candidates);
    }
    let mut claims = claims.clone();
    let statistics = forward_project_claim(b.frame, b.tuning, &inputs, &mut claims);
    b.count(&statistics)?;
    b.write("claims", claims)
}
