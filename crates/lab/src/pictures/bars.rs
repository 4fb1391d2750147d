//! Stacked bars: one bar for each whole, one segment for each of its parts.

use crate::pictures::plot::{decimals, rgb, COLOURS, GRID, INK, LARGEST, LINE_HEIGHT, MARGIN, SWATCH};
use crate::pictures::plot_canvas::Canvas;
use crate::pictures::text::Font;
use crate::pictures::{Picture, PictureError};
use plotters::drawing::DrawingAreaErrorKind;
use plotters::prelude::{ChartBuilder, Color, IntoDrawingArea, IntoSegmentedCoord, Rectangle, SegmentValue, ShapeStyle, WHITE};
use std::convert::Infallible;

/// Pixels from one bar to the next.
const BAR_HEIGHT: u32 = 26;
/// Room for the axis below the bars.
const AXIS_HEIGHT: u32 = 52;
/// Shortest bar: below, an axis has no steps that a number can hold.
const SMALLEST: f64 = 1e-18;
/// Least width of the bars.
const LEAST_WIDTH: u32 = 200;

/// Horizontal bars that are made of segments, with a legend beside them. Segments of one name have one colour.
#[derive(Debug, Clone)]
pub struct StackedBars {
    title: String,
    unit: String,
    width: u32,
    bars: Vec<(String, Vec<(String, f64)>)>,
}

impl StackedBars {
    /// A picture without bars, 1200 pixels wide and as high as its bars need. The unit stands below the axis.
    pub fn new(title: impl Into<String>, unit: impl Into<String>) -> Self {
        Self { title: title.into(), unit: unit.into(), width: 1200, bars: Vec::new() }
    }

    /// Sets the width in pixels, names and legend included.
    #[must_use]
    pub fn width(mut self, width: u32) -> Self {
        self.width = width;
        self
    }

    /// Adds a bar below the others. Values that are not finite, or below 0, have no length.
    #[must_use]
    pub fn bar<S: Into<String>>(mut self, name: impl Into<String>, segments: impl IntoIterator<Item = (S, f64)>) -> Self {
        let length = |v: f64| if v.is_finite() { v.max(0.0) } else { 0.0 };
        self.bars.push((name.into(), segments.into_iter().map(|(name, v)| (name.into(), length(v))).collect()));
        self
    }

    /// Draws the bars.
    ///
    /// # Errors
    /// [`PictureError::NothingToPlot`] if no bar has a length between 1e-18 and 1e30; [`PictureError::PlotSize`] if the
    /// width leaves no room beside names and legend; [`PictureError::TooLarge`]; [`PictureError::Plot`] if the plotting
    /// library fails.
    pub fn render(&self) -> Result<Picture, PictureError> {
        let longest = self.bars.iter().map(|(_, segments)| segments.iter().map(|s| s.1).sum()).fold(0.0, f64::max);
        if !(SMALLEST..LARGEST).contains(&longest) {
            return Err(PictureError::NothingToPlot(self.title.clone()));
        }
        let names = self.segment_names();
        let widest = |names: &mut dyn Iterator<Item = &str>| names.map(|name| Font::PLOT.width_of(name)).max().unwrap_or(0);
        let labels = widest(&mut self.bars.iter().map(|(name, _)| name.as_str())).saturating_add(MARGIN);
        let legend = widest(&mut names.iter().copied()).saturating_add(SWATCH + 6 + 2 * MARGIN);
        let top = MARGIN + Font::PLOT_TITLE.height() + MARGIN;
        let chart_height = BAR_HEIGHT.saturating_mul(self.bars.len() as u32).saturating_add(AXIS_HEIGHT);
        let height = top.saturating_add(chart_height.max(LINE_HEIGHT.saturating_mul(names.len() as u32))).saturating_add(MARGIN);
        let needed = labels.saturating_add(legend).saturating_add(LEAST_WIDTH);
        if self.width < needed {
            return Err(PictureError::PlotSize { given: [self.width, height], needed: [needed, height] });
        }
        let mut picture = Picture::filled(self.width, height, [255; 3])?;
        let title = Font::PLOT_TITLE.shortened(&self.title, self.width - 2 * MARGIN);
        Font::PLOT_TITLE.draw(&mut picture, &title, [MARGIN as i32, MARGIN as i32], INK);
        let mut chart = Picture::filled(self.width - legend, chart_height, [255; 3])?;
        self.draw_chart(&mut chart, labels, longest, &names)
            .map_err(|error| PictureError::Plot { title: self.title.clone(), message: error.to_string() })?;
        picture.paste(&chart, 0, top);
        draw_legend(&mut picture, [self.width - legend, top], &names);
        Ok(picture)
    }

    /// Names of all segments, each once, in the order in which they first stand.
    fn segment_names(&self) -> Vec<&str> {
        let mut names = Vec::new();
        for (name, _) in self.bars.iter().flat_map(|(_, segments)| segments) {
            if !names.contains(&name.as_str()) {
                names.push(name.as_str());
            }
        }
        names
    }

    fn draw_chart(
        &self,
        chart: &mut Picture,
        labels: u32,
        longest: f64,
        names: &[&str],
    ) -> Result<(), DrawingAreaErrorKind<Infallible>> {
        let area = Canvas(chart).into_drawing_area();
        area.fill(&WHITE)?;
        let count = self.bars.len();
        let decimals = decimals(longest);
        let scientific = decimals > 6 || longest >= 1e7;
        let mut axes = ChartBuilder::on(&area)
            .x_label_area_size(AXIS_HEIGHT - 8)
            .y_label_area_size(labels + MARGIN)
            .margin_right(MARGIN)
            .margin_top(8)
            .build_cartesian_2d(0.0..longest * 1.03, (0..count - 1).into_segmented())?;
        axes.configure_mesh()
            .disable_y_mesh()
            .axis_style(rgb(INK))
            .bold_line_style(rgb(GRID))
            .light_line_style(WHITE)
            .x_desc(self.unit.as_str())
            .x_labels(10)
            .y_labels(count)
            .x_label_formatter(&|x| if scientific { format!("{x:.2e}") } else { format!("{x:.decimals$}") })
            .y_label_formatter(&|y| match y {
                // The axis goes upwards.
                SegmentValue::CenterOf(i) if *i < count => self.bars[count - 1 - i].0.clone(),
                _ => String::new(),
            })
            .draw()?;
        for (row, (_, segments)) in self.bars.iter().enumerate() {
            let mut start = 0.0;
            for (name, length) in segments {
                let index = names.iter().position(|n| n == name).unwrap_or(0);
                let row = count - 1 - row;
                let corners = [(start, SegmentValue::Exact(row)), (start + length, SegmentValue::Exact(row + 1))];
                let mut filled = Rectangle::new(corners.clone(), rgb(colour(index)).filled());
                filled.set_margin(4, 4, 0, 0);
                let mut edge = Rectangle::new(corners, ShapeStyle { color: WHITE.into(), filled: false, stroke_width: 1 });
                edge.set_margin(4, 4, 0, 0);
                axes.draw_series([filled, edge])?;
                start += length;
            }
        }
        area.present()
    }
}

fn draw_legend(picture: &mut Picture, [x, y]: [u32; 2], names: &[&str]) {
    for (i, name) in names.iter().enumerate() {
        let top = y + i as u32 * LINE_HEIGHT;
        for (dx, dy) in (0..SWATCH).flat_map(|dx| (4..14).map(move |dy| (dx, dy))) {
            picture.set((x + dx).into(), (top + dy).into(), colour(i));
        }
        let text = top + LINE_HEIGHT / 2 - Font::PLOT.height() / 2;
        Font::PLOT.draw(picture, name, [(x + SWATCH + 6) as i32, text as i32], INK);
    }
}

/// The palette, then the same lighter, then darker.
fn colour(index: usize) -> [u8; 3] {
    let base = COLOURS[index % COLOURS.len()];
    let mixed = |with: u16, share: u16| base.map(|c| ((u16::from(c) * (100 - share) + with * share) / 100) as u8);
    match index / COLOURS.len() % 3 {
        0 => base,
        1 => mixed(255, 50),
        _ => mixed(0, 45),
    }
}
