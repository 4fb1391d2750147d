//! Labelled panels side by side.

use crate::pictures::picture::checked_extent;
use crate::pictures::strip_layout::{Layout, GAP, LEADING};
use crate::pictures::{Picture, PictureError, Region};

const BACKGROUND: [u8; 3] = [24, 25, 29];
const TITLE: [u8; 3] = [255, 255, 255];
const LABEL: [u8; 3] = [255, 255, 255];
const NOTE: [u8; 3] = [176, 180, 190];
/// Outlines of the first, second, third inset, then again: of the palette of Okabe and Ito, readable on dark and bright.
const INSETS: [[u8; 3]; 3] = [[240, 228, 66], [86, 180, 233], [230, 159, 0]];
/// Panels of the same size in a row or a grid, each under its label, with a title above and enlarged insets below.
///
/// ```
/// # use atrous_lab::pictures::{Picture, PictureError, Region, Strip};
/// # fn main() -> Result<(), PictureError> {
/// # let (noisy, denoised) = (Picture::filled(320, 180, [9; 3])?, Picture::filled(320, 180, [99; 3])?);
/// let strip = Strip::new("Cornell box, frame 17")
///     .panel("noisy\nRMSE 0.0576", noisy)
///     .panel("SVGF\nRMSE 0.0289", denoised)
///     .inset(Region { x: 140, y: 90, width: 64, height: 36 })
///     .render()?;
/// # assert!(strip.width() > 640);
/// # Ok(()) }
/// ```
#[derive(Debug, Clone)]
pub struct Strip {
    pub(crate) title: String,
    pub(crate) panels: Vec<(String, Picture)>,
    pub(crate) insets: Vec<Region>,
    pub(crate) upscale: u32,
    pub(crate) columns: Option<u32>,
}

impl Strip {
    /// A strip without panels. The title says what all panels share: scene, frame, preset. May be empty.
    pub fn new(title: impl Into<String>) -> Self {
        Self { title: title.into(), panels: Vec::new(), insets: Vec::new(), upscale: 1, columns: None }
    }

    /// Adds a panel on the right. The first line of the label is bright, further lines are dimmer. A line that does not
    /// fit above the panel is shortened.
    #[must_use]
    pub fn panel(mut self, label: impl Into<String>, picture: Picture) -> Self {
        self.panels.push((label.into(), picture));
        self
    }

    /// Shows a region of all panels enlarged below each, as wide as the panel, and outlines it in the panel. In pixels
    /// of the panels before [`Strip::upscale`]. May be called several times.
    #[must_use]
    pub fn inset(mut self, region: Region) -> Self {
        self.insets.push(region);
        self
    }

    /// Repeats each pixel of the panels `factor` times in both directions; 1 by default. Text
    /// and outlines grow with panels wider than 480 pixels, not with this factor.
    #[must_use]
    pub fn upscale(mut self, factor: u32) -> Self {
        self.upscale = factor;
        self
    }

    /// Panels in a row before the next row begins; by default all are in one row.
    #[must_use]
    pub fn columns(mut self, columns: u32) -> Self {
        self.columns = Some(columns);
        self
    }

    /// Draws the strip.
    ///
    /// # Errors
    /// [`PictureError::NoPanel`]; [`PictureError::PanelSize`] if the panels differ in size; [`PictureError::Region`] if
    /// an inset leaves the panels; [`PictureError::Zero`] for 0 columns or a factor of 0; [`PictureError::TooLarge`].
    pub fn render(&self) -> Result<Picture, PictureError> {
        let layout = Layout::new(self)?;
        let (width, height) = checked_extent(layout.width(), layout.height())?;
        let mut strip = Picture::filled(width, height, BACKGROUND)?;
        let title = layout.title_font.shortened(&self.title, width - 2 * GAP);
        layout.title_font.draw(&mut strip, &title, [GAP as i32, GAP as i32], TITLE);
        for (i, (label, picture)) in self.panels.iter().enumerate() {
            let (column, row) = (i as u32 % layout.columns, i as u32 / layout.columns);
            let x = GAP + column * (layout.panel[0] + GAP);
            let y = layout.title_height + row * layout.cell_height() as u32;
            self.draw_panel(&mut strip, &layout, label, picture, [x, y])?;
        }
        Ok(strip)
    }

    fn draw_panel(
        &self,
        strip: &mut Picture,
        layout: &Layout,
        label: &str,
        picture: &Picture,
        [x, mut y]: [u32; 2],
    ) -> Result<(), PictureError> {
        let font = layout.label_font;
        for (i, line) in label.lines().enumerate() {
            let top = y + LEADING + i as u32 * (font.height() + LEADING);
            let colour = if i == 0 { LABEL } else { NOTE };
            font.draw(strip, &font.shortened(line, layout.panel[0]), [x as i32, top as i32], colour);
        }
        y += layout.label_height;
        strip.paste(&picture.upscale(self.upscale)?, x, y);
        self.draw_insets(strip, layout, picture, [x, y])
    }

    /// Outlines the regions in the panel at (`x`, `y`), and draws them enlarged below it.
    fn draw_insets(&self, strip: &mut Picture, layout: &Layout, picture: &Picture, [x, y]: [u32; 2]) -> Result<(), PictureError> {
        let mut inset_y = y + layout.panel[1] + GAP;
        let line = layout.line;
        for ((region, size), colour) in self.insets.iter().zip(&layout.insets).zip(INSETS.iter().cycle()) {
            let [width, height] = *size;
            strip.paste(&enlarge(&picture.crop(*region)?, width, height)?, x, inset_y);
            strip.outline(Region { x, y: inset_y, width, height }, *colour, 2 * line);
            inset_y += height + GAP;
            // Outside the region, so that the outline hides nothing of what it shows; cut to the panel.
            let start = |v: u32| (v * self.upscale).saturating_sub(line);
            let end = |v: u32, side: u32| (v * self.upscale).saturating_add(line).min(side);
            let (left, top) = (start(region.x), start(region.y));
            let right = end(region.x + region.width, layout.panel[0]);
            let bottom = end(region.y + region.height, layout.panel[1]);
            let around = Region { x: x + left, y: y + top, width: right - left, height: bottom - top };
            strip.outline(around, *colour, line);
        }
        Ok(())
    }
}

/// Nearest pixel at any ratio: an inset is as wide as its panel even if that is no multiple of the region.
fn enlarge(crop: &Picture, width: u32, height: u32) -> Result<Picture, PictureError> {
    let nearest = |i: u32, from: u32, to: u32| (u64::from(i) * u64::from(from) / u64::from(to)) as usize;
    let mut pixels = Vec::with_capacity(width as usize * height as usize);
    for y in 0..height {
        let row = nearest(y, crop.height(), height) * crop.width() as usize;
        pixels.extend((0..width).map(|x| crop.pixels()[row + nearest(x, crop.width(), width)]));
    }
    Picture::from_pixels(width, height, pixels)
}
