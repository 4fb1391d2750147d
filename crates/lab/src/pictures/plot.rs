//! Line plots of a value per frame.

use crate::pictures::plot_canvas::Canvas;
use crate::pictures::text::Font;
use crate::pictures::{Picture, PictureError};
use plotters::drawing::DrawingAreaErrorKind;
use plotters::prelude::{ChartBuilder, IntoDrawingArea, LineSeries, RGBColor, ShapeStyle, WHITE};
use std::convert::Infallible;
use std::ops::Range;

/// The palette of Okabe and Ito, which colour-blind viewers can tell apart, without its yellow, which is faint on white.
pub(crate) const COLOURS: [[u8; 3]; 7] =
    [[0, 114, 178], [213, 94, 0], [0, 158, 115], [204, 121, 167], [86, 180, 233], [230, 159, 0], [90, 90, 90]];
pub(crate) const INK: [u8; 3] = [32, 32, 36];
pub(crate) const GRID: [u8; 3] = [226, 227, 231];
pub(crate) const MARGIN: u32 = 12;
/// Length of the coloured line before each name in the legend.
pub(crate) const SWATCH: u32 = 18;
/// Least width and height of the part with the axes.
const LEAST_CHART: [u32; 2] = [200, 110];
/// Values beyond are drawn here: a line that diverged is seen to do so, and the axis keeps steps that a number can hold.
pub(crate) const LARGEST: f64 = 1e30;
pub(crate) const LINE_HEIGHT: u32 = 18;

/// The values of one line, and its name in the legend.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Name in the legend.
    pub name: String,
    /// One value per frame, from frame 0 on. Where one is not finite the line has a gap.
    pub values: Vec<f64>,
}

/// A plot with one line per series over the frame number; its legend stands beside it and hides nothing.
///
/// The vertical axis is that of [`value_axis`].
#[derive(Debug, Clone)]
pub struct LinePlot {
    title: String,
    extent: [u32; 2],
    series: Vec<Series>,
}

impl LinePlot {
    /// A plot without series, 900x360 pixels. The title says what is plotted, and in which unit.
    pub fn new(title: impl Into<String>) -> Self {
        Self { title: title.into(), extent: [900, 360], series: Vec::new() }
    }

    /// Sets width and height in pixels, legend included.
    #[must_use]
    pub fn size(mut self, width: u32, height: u32) -> Self {
        self.extent = [width, height];
        self
    }

    /// Adds a line: one value per frame, from frame 0 on; values that are not finite are gaps.
    #[must_use]
    pub fn series(mut self, name: impl Into<String>, values: impl Into<Vec<f64>>) -> Self {
        self.series.push(Series { name: name.into(), values: values.into() });
        self
    }

    /// Draws the plot.
    ///
    /// # Errors
    /// [`PictureError::NothingToPlot`] if no value is finite; [`PictureError::PlotSize`] if the size leaves no room for
    /// axes and legend; [`PictureError::TooLarge`]; [`PictureError::Plot`] if the plotting library fails.
    pub fn render(&self) -> Result<Picture, PictureError> {
        let vertical = value_axis(&self.series).ok_or_else(|| PictureError::NothingToPlot(self.title.clone()))?;
        let legend_width = self.legend_width();
        let top = MARGIN + Font::PLOT_TITLE.height() + MARGIN;
        let rows = LINE_HEIGHT.saturating_mul(self.series.len() as u32).max(LEAST_CHART[1]);
        let needed = [LEAST_CHART[0].saturating_add(legend_width), top.saturating_add(rows).saturating_add(MARGIN)];
        if self.extent[0] < needed[0] || self.extent[1] < needed[1] {
            return Err(PictureError::PlotSize { given: self.extent, needed });
        }
        let [width, height] = self.extent;
        let mut picture = Picture::filled(width, height, [255; 3])?;
        let title = Font::PLOT_TITLE.shortened(&self.title, width - 2 * MARGIN);
        Font::PLOT_TITLE.draw(&mut picture, &title, [MARGIN as i32, MARGIN as i32], INK);
        let mut chart = Picture::filled(width - legend_width, height - top, [255; 3])?;
        self.draw_chart(&mut chart, vertical)
            .map_err(|error| PictureError::Plot { title: self.title.clone(), message: error.to_string() })?;
        picture.paste(&chart, 0, top);
        self.draw_legend(&mut picture, [width - legend_width, top]);
        Ok(picture)
    }

    fn frames(&self) -> usize {
        self.series.iter().map(|s| s.values.len()).max().unwrap_or(0)
    }

    fn legend_width(&self) -> u32 {
        let widest = self.series.iter().map(|s| Font::PLOT.width_of(&s.name)).max().unwrap_or(0);
        widest.saturating_add(SWATCH + 6 + 2 * MARGIN)
    }

    fn draw_chart(&self, chart: &mut Picture, vertical: Range<f64>) -> Result<(), DrawingAreaErrorKind<Infallible>> {
        let area = Canvas(chart).into_drawing_area();
        area.fill(&WHITE)?;
        let last = self.frames().saturating_sub(1).max(1) as f64;
        let decimals = decimals(vertical.end - vertical.start);
        let scientific = decimals > 6 || vertical.end.abs().max(vertical.start.abs()) >= 1e6;
        let mut axes = ChartBuilder::on(&area)
            .x_label_area_size(44)
            .y_label_area_size(72)
            .margin_right(MARGIN)
            .margin_top(8)
            .build_cartesian_2d(0.0..last, vertical)?;
        axes.configure_mesh()
            .axis_style(rgb(INK))
            .bold_line_style(rgb(GRID))
            .light_line_style(WHITE)
            .x_desc("frame")
            .x_labels(12)
            .y_labels(8)
            .x_label_formatter(&|x| {
                if x.fract() == 0.0 {
                    format!("{x}")
                } else {
                    String::new()
                }
            })
            .y_label_formatter(&|y| {
                if scientific {
                    format!("{y:.2e}")
                } else {
                    format!("{y:.decimals$}")
                }
            })
            .draw()?;
        for (series, colour) in self.series.iter().zip(COLOURS.iter().cycle()) {
            let style = ShapeStyle { color: rgb(*colour).into(), filled: false, stroke_width: 2 };
            for run in runs(&series.values) {
                // A single value has no line: it is drawn as a dot.
                let dot = if run.len() == 1 { 3 } else { 0 };
                let line = LineSeries::new(run, style).point_size(dot);
                axes.draw_series(line)?;
            }
        }
        area.present()
    }

    fn draw_legend(&self, picture: &mut Picture, [x, y]: [u32; 2]) {
        for (i, (series, colour)) in self.series.iter().zip(COLOURS.iter().cycle()).enumerate() {
            let middle = y + 8 + i as u32 * LINE_HEIGHT + LINE_HEIGHT / 2;
            for (dx, dy) in (0..SWATCH).flat_map(|dx| [(dx, 0), (dx, 1), (dx, 2)]) {
                picture.set((x + dx).into(), (middle + dy).into(), *colour);
            }
            let left = (x + SWATCH + 6) as i32;
            let top = (middle - Font::PLOT.height() / 2) as i32;
            Font::PLOT.draw(picture, &series.name, [left, top], INK);
        }
    }
}

/// The range of an axis on which all values of some lines have room; `None` if none is finite.
///
/// It starts at 0, unless all values lie in the upper half between 0 and the largest, or one is negative: then below the
/// smallest value. Values beyond 1e30 count as 1e30.
pub fn value_axis(series: &[Series]) -> Option<Range<f64>> {
    let finite = || series.iter().flat_map(|s| &s.values).filter(|v| v.is_finite()).map(|v| bounded(*v));
    let (low, high) = (finite().fold(f64::INFINITY, f64::min), finite().fold(f64::NEG_INFINITY, f64::max));
    if low > high {
        return None;
    }
    let start = if low > 0.5 * high || low < 0.0 { low } else { 0.0 };
    // A constant line still needs an axis around it; and ticks closer than the digits of a number never end.
    let spread = high - start;
    let room = if spread > 1e-9 * high.abs().max(1e-18) { 0.06 * spread } else { 0.5 * high.abs().max(1e-6) };
    let start = if start == 0.0 { 0.0 } else { start - room };
    Some(start..high + room)
}

/// Stretches of values without a gap, with their frame numbers.
fn runs(values: &[f64]) -> Vec<Vec<(f64, f64)>> {
    let points: Vec<_> = values.iter().enumerate().map(|(x, &y)| (x as f64, bounded(y))).collect();
    points.split(|(_, y)| !y.is_finite()).filter(|run| !run.is_empty()).map(<[_]>::to_vec).collect()
}

/// NaN and infinities stay what they are: gaps.
fn bounded(value: f64) -> f64 {
    if value.is_finite() {
        value.clamp(-LARGEST, LARGEST)
    } else {
        value
    }
}

pub(crate) fn rgb([r, g, b]: [u8; 3]) -> RGBColor {
    RGBColor(r, g, b)
}

/// Digits after the point that tell about ten steps of a range apart.
pub(crate) fn decimals(range: f64) -> usize {
    (1.0 - range.log10().floor()).clamp(0.0, 9.0) as usize
}
