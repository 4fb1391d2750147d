//! Motion of surfaces from the previous frame, in the encoding of the metrics: pixels, previous − current, y down.

use crate::frame::FrameInputs;
use crate::projection::Projection;
use atrous::config::{Conventions, MotionDepth};
use atrous::FrameParams;

/// Background, in a depth that the metrics can compare.
const FAR: f32 = 1e30;

/// Motion and depths of a frame.
#[derive(Clone, Debug, Default)]
pub struct SurfaceMotion {
    /// Motion, pixels.
    pub motion_px: Vec<[f32; 2]>,
    /// Depth that the surface had in the previous camera.
    pub previous_depth: Vec<f32>,
    /// Depth in this camera.
    pub depth: Vec<f32>,
    /// Whether a pixel shows a surface, and no background.
    pub is_surface: Vec<bool>,
    /// Ids; 0 where there are none.
    pub id: Vec<u32>,
}

/// Computes all of it. `before` are the parameters of the previous frame.
pub fn of_frame(frame: &FrameInputs, before: &FrameParams, c: &Conventions) -> SurfaceMotion {
    with_motions(frame, before, c, frame.images.get("motion"))
}

/// The same for a world in which nothing moves by itself: by depth and matrices alone.
pub fn of_still(frame: &FrameInputs, before: &FrameParams, c: &Conventions) -> SurfaceMotion {
    with_motions(frame, before, c, None)
}

fn with_motions(frame: &FrameInputs, before: &FrameParams, c: &Conventions, motions: Option<&Vec<[f32; 4]>>) -> SurfaceMotion {
    let projection = Projection::new(&frame.params, before, c);
    let mut result = SurfaceMotion::default();
    let pixels = frame.noisy.len();
    let depths = frame.images.get("depth");
    for i in 0..pixels {
        let at = projection.middle(i);
        let z = projection.linear_depth(at, depths.map_or(1.0, |d| d[i][0]));
        let carried = || projection.previous(at, z);
        let (motion, previous) = match motions.map(|m| m[i]) {
            Some(v) => {
                let previous = match c.motion_depth {
                    MotionDepth::Absolute => v[2],
                    MotionDepth::Difference => z + v[2],
                    MotionDepth::None => carried().1,
                };
                (projection.pixels(v), previous)
            }
            None => carried(),
        };
        result.motion_px.push(if motion.is_finite() { motion.into() } else { [0.0; 2] });
        result.previous_depth.push(if previous.is_finite() { previous } else { FAR });
        let id = frame.surface_id.as_ref().map_or(1, |ids| ids[i]);
        result.is_surface.push(z.is_finite() && z > 0.0 && z < c.background_depth && id != 0);
        result.depth.push(if z.is_finite() { z } else { FAR });
    }
    result.id = frame.surface_id.clone().unwrap_or_else(|| vec![0; pixels]);
    result
}

/// Moves what is seen through flat glass as the still world behind it moves, where that is known. `before` are the parameters of the previous frame.
pub fn see_through(frame: &mut FrameInputs, before: &FrameParams, c: &Conventions) {
    let Some(mut motions) = frame.images.remove("motion") else { return };
    let projection = Projection::new(&frame.params, before, c);
    for (i, (motion, depth)) in motions.iter_mut().zip(frame.through.iter().flat_map(|through| &through.depth)).enumerate() {
        let Some(z) = *depth else { continue };
        let seen = projection.encoded(projection.previous(projection.middle(i), z).0);
        if seen.is_finite() {
            (motion[0], motion[1]) = seen.into();
        }
    }
    frame.images.insert("motion", motions);
}
