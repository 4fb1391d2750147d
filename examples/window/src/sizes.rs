//! How many pixels light, guides and the shown picture have.

use ash::vk;
use atrous_engine::TracerOptions;

use super::settings::Settings;

/// Fixed while the window is open.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sizes {
    /// Pixels of the guides.
    pub rendered: vk::Extent2D,
    /// Pixels that filters gather over time, where they are not those of the guides.
    pub output: Option<vk::Extent2D>,
    /// Light has half of the rendered columns and rows.
    pub half_light: bool,
}

impl Sizes {
    /// Light, guides and picture of the same size.
    #[cfg(test)]
    pub fn of(rendered: vk::Extent2D) -> Self {
        Self { rendered, output: None, half_light: false }
    }

    /// Pixels of the shown picture.
    pub fn shown(&self) -> vk::Extent2D {
        self.output.unwrap_or(self.rendered)
    }

    /// Whether filters map tones themselves: whatever gathers over time comes behind their tone map.
    pub fn are_tones_mapped(&self, settings: &Settings) -> bool {
        settings.taa || self.output.is_some()
    }

    /// For the tracer of the picture.
    pub fn tracer_options(&self, settings: &Settings) -> TracerOptions {
        TracerOptions { jitter: self.are_tones_mapped(settings), half_light: self.half_light, ..TracerOptions::default() }
    }
}
