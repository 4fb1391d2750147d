//! The tunables of a pixel, by the class of its material.

use super::guide::unpack_guide;
use super::statistics::count;
use super::Image;
use crate::{FrameConstants, Tuning};
use glam::IVec2;

/// The class of a pixel of light, with whether it is beyond the table: then it counts as 0.
fn class_of(frame: &FrameConstants, classes: &Image<u32>, p: IVec2) -> (usize, bool) {
    let class = classes.at(frame.guide_pixel(p)) as usize;
    let is_bad = class >= frame.materials.len();
    (if is_bad { 0 } else { class }, is_bad)
}

/// Surfaces whose class is beyond the table.
pub(crate) fn classes_beyond(frame: &FrameConstants, classes: &Image<u32>, guide: &Image<[u16; 4]>) -> u32 {
    let is_bad = |p| !unpack_guide(guide.at(p)).is_background() && class_of(frame, classes, p).1;
    count(Image::compute(guide.extent(), frame.render_extent, is_bad).texels().iter().copied())
}

/// Tunables for a pixel: those of the frame, times the factors of its class.
pub(crate) fn tuning_at(frame: &FrameConstants, tuning: &Tuning, classes: Option<&Image<u32>>, p: IVec2) -> Tuning {
    let Some(classes) = classes else { return *tuning };
    let [depth, normal, light, longest_history] = frame.materials[class_of(frame, classes, p).0];
    Tuning {
        depth_tolerance: tuning.depth_tolerance * depth,
        sigma_z: tuning.sigma_z * depth,
        normal_tolerance: 1.0 - normal * (1.0 - tuning.normal_tolerance),
        sigma_n: tuning.sigma_n / normal,
        sigma_l: tuning.sigma_l * light,
        max_history_length: tuning.max_history_length.min(longest_history),
        ..*tuning
    }
}
