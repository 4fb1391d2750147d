//! The layout of a strip: places of its parts.

use crate::pictures::picture::checked_extent;
use crate::pictures::text::Font;
use crate::pictures::{Picture, PictureError, Region, Strip};

/// Pixels between panels and around the strip.
pub(crate) const GAP: u32 = 8;
/// Pixels above and below a line of text.
pub(crate) const LEADING: u32 = 3;

/// Sizes in pixels of the strip's parts.
pub(crate) struct Layout {
    /// Width and height of a panel, upscaled.
    pub(crate) panel: [u32; 2],
    pub(crate) insets: Vec<[u32; 2]>,
    pub(crate) columns: u32,
    pub(crate) rows: u32,
    pub(crate) title_font: Font,
    pub(crate) title_height: u32,
    pub(crate) label_font: Font,
    pub(crate) label_height: u32,
    /// Thickness of the thinnest line.
    pub(crate) line: u32,
}

impl Layout {
    pub(crate) fn new(strip: &Strip) -> Result<Self, PictureError> {
        let (_, first) = strip.panels.first().ok_or(PictureError::NoPanel)?;
        if strip.columns == Some(0) {
            return Err(PictureError::Zero("the number of columns"));
        }
        check_panels(strip, first)?;
        let panel: [u32; 2] = first.upscaled_extent(strip.upscale)?.into();
        let insets = strip.insets.iter().map(|region| inset_size(*region, panel)).collect::<Result<_, _>>()?;
        let panels = u32::try_from(strip.panels.len()).unwrap_or(u32::MAX);
        let columns = strip.columns.unwrap_or(panels).min(panels);
        // Wide strips are shown reduced: their text has to stay legible.
        let scale = (panel[0] / 480).max(1);
        let labels = || strip.panels.iter().map(|(label, _)| label.as_str());
        let longest = labels().flat_map(str::lines).map(|line| line.chars().count()).max().unwrap_or(0);
        let label_font = Font::fitting(longest, panel[0], (panel[0] / 16).max(8), scale);
        let lines = labels().map(|label| label.lines().count()).max().unwrap_or(0) as u32;
        let label_height = if lines == 0 { 0 } else { LEADING + lines * (label_font.height() + LEADING) };
        let title_width = columns.saturating_mul(panel[0].saturating_add(GAP)) - GAP;
        let title_font = Font::fitting(strip.title.chars().count(), title_width, 20 * scale, scale);
        let title_height = if strip.title.is_empty() { GAP } else { GAP + title_font.height() + GAP };
        let rows = panels.div_ceil(columns);
        Ok(Self { panel, insets, columns, rows, title_font, title_height, label_font, label_height, line: scale })
    }

    pub(crate) fn width(&self) -> u64 {
        u64::from(GAP) + u64::from(self.columns) * u64::from(self.panel[0] + GAP)
    }

    pub(crate) fn height(&self) -> u64 {
        u64::from(self.title_height) + u64::from(self.rows) * self.cell_height()
    }

    /// Height of a panel with its label, its insets and the gap below.
    pub(crate) fn cell_height(&self) -> u64 {
        let insets: u64 = self.insets.iter().map(|inset| u64::from(inset[1] + GAP)).sum();
        u64::from(self.label_height) + u64::from(self.panel[1] + GAP) + insets
    }
}

fn check_panels(strip: &Strip, first: &Picture) -> Result<(), PictureError> {
    let expected = [first.width(), first.height()];
    for (label, picture) in &strip.panels {
        let given = [picture.width(), picture.height()];
        if given != expected {
            return Err(PictureError::PanelSize { label: label.clone(), given, expected });
        }
    }
    strip.insets.iter().try_for_each(|region| first.check(*region))
}

/// The size of an inset: as wide as the panel, and as high as the shape of the region asks for.
fn inset_size(region: Region, panel: [u32; 2]) -> Result<[u32; 2], PictureError> {
    let height = u64::from(panel[0]) * u64::from(region.height) / u64::from(region.width);
    let (width, height) = checked_extent(panel[0].into(), height.max(1))?;
    Ok([width, height])
}
