//! The ratio of light at a pixel, smooth between strata.

use super::StrataRatio;
use crate::reference::render_rect::RenderRect;
use crate::reference::strata::Strata;
use crate::FrameConstants;
use glam::IVec2;

/// The bilinear mean of the strata around a pixel that have a ratio; 1 where none has.
pub(crate) fn ratio_at(frame: &FrameConstants, StrataRatio { image, stratum_size }: StrataRatio, p: IVec2) -> [f32; 3] {
    let strata = RenderRect::new(Strata::new(frame, stratum_size).count().into());
    let (mut sum, mut weights) = ([0.0; 3], 0.0);
    for (s, weight) in strata.cells_around(p, stratum_size) {
        let ratio = image.at(s);
        if ratio[3] >= 0.0 {
            sum = [0, 1, 2].map(|i| sum[i] + weight * ratio[i]);
            weights += weight;
        }
    }
    sum.map(|sum| if weights > 0.0 { sum / weights } else { 1.0 })
}
