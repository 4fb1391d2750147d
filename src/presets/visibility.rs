//! The filter of a light's visibility: shadows of the sun, or of a lamp.

use crate::graph::{Graph, Guides, Visibility, VisibilityAccumulated};

/// Levels: a kernel with a standard deviation of 9 pixels, penumbrae of some 40 pixels from side to side.
const LEVELS: u32 = 4;

/// The first half of the passes of one light's visibility. They run before those of surfaces, while
/// the motion of surfaces is at hand.
pub(crate) fn visibility_accumulated(g: &mut Graph, guides: &Guides) -> VisibilityAccumulated {
    let samples = g.visibility_samples(guides);
    g.visibility_accumulation(guides, &samples)
}

/// The second half, after the filter of surfaces, whose images are free again by then.
pub(crate) fn visibility(g: &mut Graph, guides: &Guides, accumulated: &VisibilityAccumulated) -> Visibility {
    g.visibility_filter(guides, accumulated, LEVELS)
}
