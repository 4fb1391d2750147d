//! The ratio of light at a pixel, smooth between strata.

use super::StrataRatio;
use crate::reference::strata::Strata;
use crate::reference::Image;
use crate::FrameConstants;
use glam::{IVec2, Vec2};

/// The bilinear mean of the strata around a pixel that have a ratio; 1 where none has.
pub(super) fn ratio_at(frame: &FrameConstants, StrataRatio { image, stratum_size }: StrataRatio, p: IVec2) -> [f32; 3] {
    let last = Strata::new(frame, stratum_size).count().as_ivec2() - 1;
    let position = (p.as_vec2() + 0.5) / stratum_size as f32 - 0.5;
    let corner = position.floor();
    let (mut sum, mut weights) = ([0.0; 3], 0.0);
    for (x, y) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
        let ratio = texel(image, corner.as_ivec2() + IVec2::new(x, y), last);
        let weight = side(position - corner, x, y);
        if ratio[3] >= 0.0 {
            sum = [0, 1, 2].map(|i| sum[i] + weight * ratio[i]);
            weights += weight;
        }
    }
    sum.map(|sum| if weights > 0.0 { sum / weights } else { 1.0 })
}

fn texel(image: &Image<[f32; 4]>, s: IVec2, last: IVec2) -> [f32; 4] {
    image.at(s.clamp(IVec2::ZERO, last))
}

fn side(f: Vec2, x: i32, y: i32) -> f32 {
    (if x == 0 { 1.0 - f.x } else { f.x }) * (if y == 0 { 1.0 - f.y } else { f.y })
}
