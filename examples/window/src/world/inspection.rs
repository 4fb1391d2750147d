//! What a pixel and the filters say.

use atrous::DebugView;

use super::World;
use crate::content::Content;
use crate::error::Result;
use crate::filter::Filter;
use crate::panes::Panes;
use crate::shared::{FilterReport, Probe, HISTOGRAM_BARS};

/// What the magnifier shows of a pixel.
const PROBED: [DebugView; 8] = [
    DebugView::HistoryLength,
    DebugView::Deviation,
    DebugView::Alpha,
    DebugView::Lambda,
    DebugView::Motion,
    DebugView::Depth,
    DebugView::SurfaceId,
    DebugView::Disocclusion,
];

impl World {
    /// What a pixel says: of the first filter that is shown, right before left.
    ///
    /// # Errors
    /// A lost device.
    pub fn probe(&mut self, panes: &Panes, contents: [Content; 2], pixel: [u32; 2]) -> Result<Probe> {
        let colour = |image| self.gpu.read_half_texel(image, pixel).map(|[r, g, b, _]| [r, g, b]);
        let colours = [colour(&panes.images[0])?, colour(&panes.images[1])?];
        let mut probe = Probe { pixel, colours, ..Probe::default() };
        let preset = [contents[1], contents[0]].into_iter().find_map(Content::preset);
        let Some(filter) = self.filters.iter_mut().find(|f| Some(f.preset) == preset) else { return Ok(probe) };
        probe.preset = preset;
        // The view may have fewer pixels than the picture.
        let (view, picture) = (filter.debug.extent, panes.extent());
        let seen = [pixel[0] * view.width / picture.width, pixel[1] * view.height / picture.height];
        for view in filter.report().views.into_iter().filter(|view| PROBED.contains(view)) {
            filter.show(&self.gpu, view)?;
            probe.numbers[view as usize] = Some(self.gpu.read_half_texel(&filter.debug, seen)?[3]);
        }
        Ok(probe)
    }

    /// Pixels by history length, of the first filter in `contents`.
    ///
    /// # Errors
    /// A lost device.
    pub fn histogram(&mut self, contents: [Content; 2]) -> Result<Option<[u32; HISTOGRAM_BARS]>> {
        let preset = contents.into_iter().find_map(Content::preset);
        match self.filters.iter_mut().find(|f| Some(f.preset) == preset) {
            Some(filter) => Ok(filter.histogram()?),
            None => Ok(None),
        }
    }

    /// Times, memory and views of the filters that saw the last frame.
    pub fn reports(&self) -> Vec<FilterReport> {
        self.filters.iter().filter(|f| f.is_current(&self.tracer)).map(Filter::report).collect()
    }
}
