//! The stage `volume_motion` \[PSVGF\]: points of the previous frame, carried forward to this one, give a volume motion vectors of its own.

use super::binary16::{from_half_bits, half_bits};
use super::conventions::is_reset;
use super::forward_projection::{covering_pixel, floor_quotient, previous_world_position, project, ForwardPosition};
use super::guide::unpack_guide;
use super::volume_points::unpack_volume_point;
use super::Image;
use crate::FrameConstants;
use glam::IVec2;

#[cfg(test)]
mod tests;

/// Steps of a pixel in which a motion is found.
const STEPS: f32 = 64.0;

/// A texel of `volume_motion`: pixels of the previous frame.
pub fn pack_volume_motion([x, y]: [f32; 2]) -> u32 {
    u32::from(half_bits(x)) | u32::from(half_bits(y)) << 16
}

/// The content of a texel of `volume_motion`.
pub fn unpack_volume_motion(texel: u32) -> [f32; 2] {
    [from_half_bits(texel as u16), from_half_bits((texel >> 16) as u16)]
}

/// Inputs of [`volume_motion`]; images have the allocated extent.
#[derive(Clone, Copy, Debug)]
pub struct VolumeMotionInputs<'a> {
    /// As written by `import`.
    pub guide: &'a Image<[u16; 4]>,
    /// As written by `import`, for pixels in which no point lands.
    pub surface_motion: &'a Image<[u16; 4]>,
    /// As written by `volume_points` in the previous frame. Not read in a reset frame; `None` is treated as one.
    pub previous_points: Option<&'a Image<[u16; 4]>>,
}

/// For every pixel the motion of the point in it that contributes most, else that of its surface; see [`unpack_volume_motion`].
pub fn volume_motion(frame: &FrameConstants, inputs: &VolumeMotionInputs) -> Image<u32> {
    let mut winners: Image<(u32, [f32; 2])> = Image::new(inputs.guide.extent(), (0, [0.0; 2]));
    if let Some(points) = inputs.previous_points.filter(|_| !is_reset(frame)) {
        let [width, height] = frame.previous_render_extent;
        for index in 0..width * height {
            let q = IVec2::new((index % width) as i32, (index / width) as i32);
            let point = unpack_volume_point(points.at(q));
            if point.linear_depth == 0.0 {
                continue;
            }
            let position = project(frame, previous_world_position(frame, q, point.linear_depth));
            let Some(p) = covering_pixel(frame, &position) else { continue };
            let surface = unpack_guide(inputs.guide.at(p));
            if !surface.is_background() && position.depth > surface.linear_depth * position.depth_denominator {
                continue;
            }
            let key = key_of(index, width * height, point.contribution);
            if let Some(winner) = winners.get_mut(p.x, p.y).filter(|winner| key > winner.0) {
                *winner = (key, [0, 1].map(|axis| representable(motion_steps(frame, q, &position, axis))));
            }
        }
    }
    Image::compute(inputs.guide.extent(), frame.render_extent, |p| match winners.at(p) {
        (0, _) => {
            let [x, y, ..] = inputs.surface_motion.at(p);
            u32::from(x) | u32::from(y) << 16
        }
        (_, motion) => pack_volume_motion(motion),
    })
}

/// By which the points in a pixel are ranked: as much of the contribution as there is room for, and the number of the pixel plus 1 below.
fn key_of(index: u32, count: u32, contribution: u16) -> u32 {
    let mask = (2 << count.ilog2()) - 1;
    u32::from(contribution) << 17 & !mask | (index + 1)
}

/// Motion of a point from pixel `q` of the previous frame to its position in this one, unjittered: the nearest step on one axis.
fn motion_steps(frame: &FrameConstants, q: IVec2, position: &ForwardPosition, axis: usize) -> i32 {
    let (w, side) = (position.denominator[axis], frame.render_extent[axis] as f32);
    let before = (q[axis] as f32 + 0.5 + frame.previous_jitter[axis]) * side * w;
    let now = (position.numerator[axis] + frame.jitter[axis] * w) * frame.previous_render_extent[axis] as f32;
    let denominator = side * w;
    floor_quotient((before - now) * STEPS + 0.5 * denominator, denominator)
}

/// Exact as a half float, which has 11 bits: of a longer motion the low ones are cut.
fn representable(steps: i32) -> f32 {
    let magnitude = steps.unsigned_abs();
    let excess = magnitude.checked_ilog2().unwrap_or(0).saturating_sub(10);
    steps.signum() as f32 * (magnitude >> excess << excess) as f32 / STEPS
}
