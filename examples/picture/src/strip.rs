//! Labelled panels side by side.

use crate::picture::checked_extent;
use crate::text::Font;
use crate::{Picture, PictureError, Region};

const BACKGROUND: [u8; 3] = [24, 25, 29];
const TITLE: [u8; 3] = [255, 255, 255];
const LABEL: [u8; 3] = [255, 255, 255];
const NOTE: [u8; 3] = [176, 180, 190];
/// Outlines of the first, second, third inset, then again: of the palette of Okabe and Ito, readable on dark and bright.
const INSETS: [[u8; 3]; 3] = [[240, 228, 66], [86, 180, 233], [230, 159, 0]];
/// Pixels between panels and around the strip.
const GAP: u32 = 8;
/// Pixels above and below a line of text.
const LEADING: u32 = 3;

/// Panels of the same size in a row or a grid, each under its label, with a title above and enlarged insets below.
///
/// ```
/// # use atrous_picture::{Picture, PictureError, Region, Strip};
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
    title: String,
    panels: Vec<(String, Picture)>,
    insets: Vec<Region>,
    upscale: u32,
    columns: Option<u32>,
}

impl Strip {
    /// A strip without panels. The title says what all panels share: scene, frame, preset. May be empty.
    pub fn new(title: impl Into<String>) -> Self {
        Self {
            title: title.into(),
            panels: Vec::new(),
            insets: Vec::new(),
            upscale: 1,
            columns: None,
        }
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

    /// Repeats each pixel of the panels `factor` times in both directions; 1 by default. Text is not enlarged.
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
        layout
            .title_font
            .draw(&mut strip, &title, [GAP as i32, GAP as i32], TITLE);
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
            font.draw(
                strip,
                &font.shortened(line, layout.panel[0]),
                [x as i32, top as i32],
                colour,
            );
        }
        y += layout.label_height;
        strip.paste(&picture.upscale(self.upscale)?, x, y);
        let mut inset_y = y + layout.panel[1] + GAP;
        for ((region, [width, height]), colour) in self
            .insets
            .iter()
            .zip(&layout.insets)
            .zip(INSETS.iter().cycle())
        {
            let enlarged = enlarge(&picture.crop(*region)?, *width, *height)?;
            strip.paste(&enlarged, x, inset_y);
            strip.outline(
                Region {
                    x,
                    y: inset_y,
                    width: *width,
                    height: *height,
                },
                *colour,
                2,
            );
            inset_y += height + GAP;
            let scaled = |v: u32| v * self.upscale;
            // One pixel outside, so that the outline hides nothing of what it shows; cut to the panel.
            let (left, top) = (
                scaled(region.x).saturating_sub(1),
                scaled(region.y).saturating_sub(1),
            );
            let right = (scaled(region.x + region.width) + 1).min(layout.panel[0]);
            let bottom = (scaled(region.y + region.height) + 1).min(layout.panel[1]);
            strip.outline(
                Region {
                    x: x + left,
                    y: y + top,
                    width: right - left,
                    height: bottom - top,
                },
                *colour,
                1,
            );
        }
        Ok(())
    }
}

/// Nearest pixel at any ratio: an inset is as wide as its panel even if that is no multiple of the region.
fn enlarge(crop: &Picture, width: u32, height: u32) -> Result<Picture, PictureError> {
    let nearest =
        |i: u32, from: u32, to: u32| (u64::from(i) * u64::from(from) / u64::from(to)) as usize;
    let mut pixels = Vec::with_capacity(width as usize * height as usize);
    for y in 0..height {
        let row = nearest(y, crop.height(), height) * crop.width() as usize;
        pixels.extend((0..width).map(|x| crop.pixels()[row + nearest(x, crop.width(), width)]));
    }
    Picture::from_pixels(width, height, pixels)
}

/// Sizes in pixels of the strip's parts.
struct Layout {
    /// Width and height of a panel, upscaled.
    panel: [u32; 2],
    insets: Vec<[u32; 2]>,
    columns: u32,
    rows: u32,
    title_font: Font,
    title_height: u32,
    label_font: Font,
    label_height: u32,
}

impl Layout {
    fn new(strip: &Strip) -> Result<Self, PictureError> {
        let (_, first) = strip.panels.first().ok_or(PictureError::NoPanel)?;
        if strip.columns == Some(0) {
            return Err(PictureError::Zero("the number of columns"));
        }
        check_panels(strip, first)?;
        let scaled = first.upscale(strip.upscale)?;
        let panel = [scaled.width(), scaled.height()];
        let insets = strip
            .insets
            .iter()
            .map(|region| inset_size(*region, panel))
            .collect::<Result<_, _>>()?;
        let panels = u32::try_from(strip.panels.len()).unwrap_or(u32::MAX);
        let columns = strip.columns.unwrap_or(panels).min(panels);
        let longest = strip
            .panels
            .iter()
            .flat_map(|(label, _)| label.lines())
            .map(|l| l.chars().count())
            .max();
        let label_font = Font::fitting(longest.unwrap_or(0), panel[0], (panel[0] / 16).max(8));
        let lines = strip
            .panels
            .iter()
            .map(|(label, _)| label.lines().count())
            .max()
            .unwrap_or(0) as u32;
        let label_height = if lines == 0 {
            0
        } else {
            LEADING + lines * (label_font.height() + LEADING)
        };
        let title_width = columns.saturating_mul(panel[0].saturating_add(GAP)) - GAP;
        let title_font = Font::fitting(strip.title.chars().count(), title_width, 20);
        let title_height = if strip.title.is_empty() {
            GAP
        } else {
            GAP + title_font.height() + LEADING
        };
        let rows = panels.div_ceil(columns);
        Ok(Self {
            panel,
            insets,
            columns,
            rows,
            title_font,
            title_height,
            label_font,
            label_height,
        })
    }

    fn width(&self) -> u64 {
        u64::from(GAP) + u64::from(self.columns) * u64::from(self.panel[0] + GAP)
    }

    fn height(&self) -> u64 {
        u64::from(self.title_height) + u64::from(self.rows) * self.cell_height()
    }

    /// Height of a panel with its label, its insets and the gap below.
    fn cell_height(&self) -> u64 {
        let insets: u64 = self
            .insets
            .iter()
            .map(|inset| u64::from(inset[1] + GAP))
            .sum();
        u64::from(self.label_height) + u64::from(self.panel[1] + GAP) + insets
    }
}

fn check_panels(strip: &Strip, first: &Picture) -> Result<(), PictureError> {
    let expected = [first.width(), first.height()];
    for (label, picture) in &strip.panels {
        let given = [picture.width(), picture.height()];
        if given != expected {
            return Err(PictureError::PanelSize {
                label: label.clone(),
                given,
                expected,
            });
        }
    }
    strip
        .insets
        .iter()
        .try_for_each(|region| first.check(*region))
}

/// As wide as the panel, and as high as the shape of the region asks for.
fn inset_size(region: Region, panel: [u32; 2]) -> Result<[u32; 2], PictureError> {
    let height = u64::from(panel[0]) * u64::from(region.height) / u64::from(region.width);
    let (width, height) = checked_extent(panel[0].into(), height.max(1))?;
    Ok([width, height])
}
