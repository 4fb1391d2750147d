//! The errors of filters that are shown.

use atrous::config::Preset;

use super::World;
use crate::content::Content;
use crate::error::Result;
use crate::error_view::{ErrorViews, Wake};
use crate::panes::PaneWriter;
use crate::shared::ErrorReport;

impl World {
    /// Measures the errors that are shown, of the last frame against the reference as it is now; `wake` is called when one is measured.
    ///
    /// # Errors
    /// As [`ErrorViews::measure`].
    pub fn measure_errors(&mut self, writer: &mut PaneWriter, contents: [Content; 2], wake: &Wake) -> Result<()> {
        let mut presets: Vec<Preset> = contents.into_iter().filter_map(Content::compared).collect();
        presets.dedup();
        if presets.is_empty() {
            self.errors = None;
            return Ok(());
        }
        let errors = match &mut self.errors {
            Some(errors) => errors,
            empty => empty.insert(ErrorViews::new(&self.gpu, self.tracer.extent())?),
        };
        errors.keep(&self.gpu, &presets)?;
        let Some(reference) = &self.reference else { return Ok(()) };
        let (of, reference) = ((self.tracer.frame(), reference.samples()), reference.source(self.tracer.outputs()));
        for filter in self.filters.iter().filter(|f| presets.contains(&f.preset) && f.is_current(&self.tracer)) {
            errors.measure(&self.gpu, writer, filter.preset, of, [&filter.linear(), &reference], wake)?;
        }
        Ok(())
    }

    /// Those that were measured.
    pub fn errors(&self) -> Vec<ErrorReport> {
        self.errors.as_ref().map(ErrorViews::reports).unwrap_or_default()
    }
}
