//! The stage `volume_motion` \[PSVGF\]: points of the previous frame, carried forward to this one, give a volume motion vectors of
//! its own.

use crate::nodes::volume_points::twin::{unpack_volume_point, VolumePoint};
use crate::reference::binary16::{from_half_bits, half_bits};
use crate::reference::bindings::Bindings;
use crate::reference::compare::{Reading, Rule, Unit};
use crate::reference::conventions::is_reset;
use crate::reference::forward_projection::{covering_pixel, floor_quotient, previous_world_position, project, ForwardPosition};
use crate::reference::guide::{pcg, unpack_guide};
use crate::reference::rules::{pixels, rule, EXACT};
use crate::reference::{render_rect::RenderRect, Image};
use crate::{Error, FrameConstants};
use glam::IVec2;

#[cfg(test)]
mod tests;

/// Steps of a pixel in which a motion is found.
const STEPS: f32 = 64.0;

/// A texel of `volume_motion`: pixels of the previous frame.
pub(crate) fn pack_volume_motion([x, y]: [f32; 2]) -> u32 {
    u32::from(half_bits(x)) | u32::from(half_bits(y)) << 16
}

/// The content of a texel of `volume_motion`.
pub(crate) fn unpack_volume_motion(texel: u32) -> [f32; 2] {
    [from_half_bits(texel as u16), from_half_bits((texel >> 16) as u16)]
}

/// The point that contributes most in a pixel.
#[derive(Clone, Copy, Default)]
struct Winner {
    /// Motion in steps of 1/64 pixel.
    motion: [f32; 2],
    /// 0: there is no point.
    weight: f32,
}

/// A black point counts next to nothing, but more than none.
const SMALLEST_LUMINANCE: f32 = 1.0 / 1_048_576.0;
const LARGEST_DEPTH: f32 = 1e6;

/// Carries `previous_points`, as written by `volume_points` in the previous frame, to this one. Each claims the pixel that it lands
/// in, where no surface of `guide` hides it: the largest key stays, 0 is nobody's. Points are not read in a reset frame.
pub(crate) fn volume_motion_claim(
    frame: &FrameConstants,
    guide: &Image<[u16; 4]>,
    previous_points: &Image<[u16; 4]>,
    claims: &mut Image<u32>,
) {
    if is_reset(frame) {
        return;
    }
    let [width, height] = frame.previous_render_extent;
    let keys = Keys::new(frame, width * height);
    for index in 0..width * height {
        let q = pixel_of(frame, index);
        let point = unpack_volume_point(previous_points.at(q));
        if point.linear_depth == 0.0 {
            continue;
        }
        let position = carried(frame, q, &point);
        let Some(p) = covering_pixel(frame, &position) else { continue };
        let surface = unpack_guide(guide.at(p));
        if !surface.is_background() && position.depth > surface.linear_depth * position.depth_denominator {
            continue;
        }
        if let Some(claim) = claims.get_mut(p.x, p.y) {
            *claim = keys.of(index, point.contribution).max(*claim);
        }
    }
}

/// The mean motion for every pixel of the points whose keys stayed in the 3×3 pixels around, else that of its surface; see
/// [`unpack_volume_motion`]. `surface_motion` is from the stage `import`.
pub(crate) fn volume_motion_resolve(
    frame: &FrameConstants,
    previous_points: &Image<[u16; 4]>,
    surface_motion: &Image<[u16; 4]>,
    claims: &Image<u32>,
) -> Image<u32> {
    let [width, height] = frame.previous_render_extent;
    let keys = Keys::new(frame, width * height);
    let winners = Image::compute(claims.extent(), frame.render_extent, |p| match claims.at(p) {
        0 => Winner::default(),
        key => winner(frame, previous_points, pixel_of(frame, keys.index_of(key))),
    });
    Image::compute(surface_motion.extent(), frame.render_extent, |p| match mean_motion(frame, &winners, p) {
        Some(motion) => pack_volume_motion(motion),
        None => {
            let [x, y, ..] = surface_motion.at(p);
            u32::from(x) | u32::from(y) << 16
        }
    })
}

/// A pixel of the previous frame by its number.
fn pixel_of(frame: &FrameConstants, index: u32) -> IVec2 {
    let [width, _] = frame.previous_render_extent;
    IVec2::new((index % width) as i32, (index / width) as i32)
}

/// The position in this frame of a point that was in pixel `q` of the previous one.
fn carried(frame: &FrameConstants, q: IVec2, point: &VolumePoint) -> ForwardPosition {
    project(frame, previous_world_position(frame, q, point.linear_depth))
}

fn winner(frame: &FrameConstants, previous_points: &Image<[u16; 4]>, q: IVec2) -> Winner {
    let point = unpack_volume_point(previous_points.at(q));
    let position = carried(frame, q, &point);
    let luminance = f32::from_bits(u32::from(point.contribution) << 16).max(SMALLEST_LUMINANCE);
    Winner {
        motion: [0, 1].map(|axis| motion_steps(frame, q, &position, axis) as f32),
        weight: luminance * point.linear_depth.min(LARGEST_DEPTH),
    }
}

/// Since a single point is anywhere along its ray. Motion falls with depth, so its mean with the weight luminance·depth is the
/// motion at the mean depth, in proportion to luminance; points just before the camera move far and would spoil any other mean.
fn mean_motion(frame: &FrameConstants, winners: &Image<Winner>, p: IVec2) -> Option<[f32; 2]> {
    let (mut sum, mut weight) = ([0.0_f32; 2], 0.0_f32);
    for (_, at) in RenderRect::new(frame.render_extent).window(p, 1, 1) {
        let winner = winners.at(at);
        if winner.weight > 0.0 {
            sum = [0, 1].map(|axis| sum[axis] + winner.motion[axis] * winner.weight);
            weight += winner.weight;
        }
    }
    (weight > 0.0).then(|| sum.map(|sum| representable(nearest_quotient(sum, weight))))
}

fn nearest_quotient(numerator: f32, denominator: f32) -> i32 {
    floor_quotient(numerator + 0.5 * denominator, denominator)
}

/// Ranks of points in a pixel: the contribution, and below it the number of the point's pixel, mixed by the frame, so that no direction
/// always wins among equal ones. Never 0.
#[derive(Clone, Copy)]
struct Keys {
    /// Bits of the number.
    bits: u32,
    /// Added to the number.
    salt: u32,
}

impl Keys {
    const ODD: u32 = 0x9e37_79b1;
    /// Its product with `ODD` is 1 modulo 2³².
    const ODD_INVERSE: u32 = 0x0e8b_2f51;
    /// Of the contribution from 2⁻¹⁶ to 2¹⁶: 128 steps for a factor of 2.
    const RANK_BITS: u32 = 12;
    const LEAST_CONTRIBUTION: u16 = (127 - 16) << 7;

    /// `count`: pixels of the previous frame.
    fn new(frame: &FrameConstants, count: u32) -> Self {
        Self { bits: u32::BITS - count.saturating_sub(1).leading_zeros(), salt: pcg(frame.frame_index) }
    }

    fn mask(self) -> u32 {
        (1 << self.bits) - 1
    }

    /// Undone by itself, since it is by half of the bits.
    fn shifted(self, x: u32) -> u32 {
        x ^ x >> self.bits.div_ceil(2)
    }

    fn of(self, index: u32, contribution: u16) -> u32 {
        let number = self.shifted(self.shifted(index.wrapping_add(self.salt) & self.mask()).wrapping_mul(Self::ODD) & self.mask());
        let rank = u32::from(contribution.saturating_sub(Self::LEAST_CONTRIBUTION)).min((1 << Self::RANK_BITS) - 1);
        let cut = Self::RANK_BITS.saturating_sub(u32::BITS - self.bits);
        (rank >> cut).max(1) << self.bits | number
    }

    fn index_of(self, key: u32) -> u32 {
        let number = self.shifted(self.shifted(key & self.mask()).wrapping_mul(Self::ODD_INVERSE) & self.mask());
        number.wrapping_sub(self.salt) & self.mask()
    }
}

/// Motion of a point from pixel `q` of the previous frame to its position in this one, unjittered: the nearest step on one axis.
fn motion_steps(frame: &FrameConstants, q: IVec2, position: &ForwardPosition, axis: usize) -> i32 {
    let (w, side) = (position.denominator[axis], frame.render_extent[axis] as f32);
    let before = (q[axis] as f32 + 0.5 + frame.previous_jitter[axis]) * side * w;
    let now = (position.numerator[axis] + frame.jitter[axis] * w) * frame.previous_render_extent[axis] as f32;
    let denominator = side * w;
    nearest_quotient((before - now) * STEPS, denominator)
}

/// Exact as a half float, which has 11 bits: of a longer motion the low ones are cut.
fn representable(steps: i32) -> f32 {
    let magnitude = steps.unsigned_abs();
    let excess = magnitude.checked_ilog2().unwrap_or(0).saturating_sub(10);
    steps.signum() as f32 * (magnitude >> excess << excess) as f32 / STEPS
}

/// How what it writes is compared with the GPU.
pub(crate) const RULES: &[Rule] = &[pixels("claims", EXACT), rule("volume_motion", Unit::Pixel, Reading::Halves, EXACT)];

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let (points, claims) = (b.packed("previous_points")?, b.uint("claims")?);
    if b.has("volume_motion") {
        let motion = volume_motion_resolve(b.frame, points, b.packed("surface_motion")?, claims);
        return b.write("volume_motion", motion);
    }
    let mut claims = claims.clone();
    volume_motion_claim(b.frame, b.packed("guide")?, points, &mut claims);
    b.write("claims", claims)
}
