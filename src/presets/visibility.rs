//! The filter of a light's visibility: shadows of the sun, or of a lamp.

use crate::graph::{Graph, Guides, Visibility};

/// Levels: a kernel with a standard deviation of 9 pixels, penumbrae of some 40 pixels from side to side.
const LEVELS: u32 = 4;

/// The passes of one light's visibility, beside those of any preset, whose guides they read; before them, so that their images are
/// free again for the others.
pub fn visibility(g: &mut Graph, guides: &Guides) -> Visibility {
    let samples = g.visibility_samples(guides);
    let accumulated = g.visibility_accumulation(guides, &samples);
    g.visibility_filter(guides, &accumulated, LEVELS)
}
