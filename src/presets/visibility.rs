//! The filter of lights' visibility: shadows of the sun, or of lamps.

use crate::config::Config;
use crate::graph::{Graph, Guides, Visibility, VisibilityAccumulated};
use crate::nodes::Lights;

/// Levels: a kernel with a standard deviation of 9 pixels, penumbrae of some 40 pixels from side to side.
const LEVELS: u32 = 4;

/// The first half of the passes of visibility. They run before those of surfaces, while the motion of
/// surfaces is at hand.
pub(crate) fn visibility_accumulated(g: &mut Graph, guides: &Guides, config: &Config) -> VisibilityAccumulated {
    let samples =
        g.visibility_samples(guides, Lights { count: config.visibility, coloured: config.coloured_visibility, ambient: false });
    g.visibility_accumulation(guides, &samples)
}

/// The second half, after the filter of surfaces, whose images are free again by then.
pub(crate) fn visibility(g: &mut Graph, guides: &Guides, accumulated: &VisibilityAccumulated) -> Visibility {
    g.visibility_filter(guides, accumulated, LEVELS)
}

/// The first half of the passes of ambient occlusion, which are those of visibility.
pub(crate) fn ambient_accumulated(g: &mut Graph, guides: &Guides) -> VisibilityAccumulated {
    g.scope(AMBIENT, |g| {
        let samples = g.visibility_samples(guides, Lights { ambient: true, ..Lights::default() });
        g.visibility_accumulation(guides, &samples)
    })
}

/// The second half.
pub(crate) fn ambient(g: &mut Graph, guides: &Guides, accumulated: &VisibilityAccumulated) -> Visibility {
    g.scope(AMBIENT, |g| visibility(g, guides, accumulated))
}

/// Behind the names of nodes and images.
const AMBIENT: &str = "ambient";
