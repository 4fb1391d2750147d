//! Points of one value against another, and the front of them.

use crate::pictures::plot::{decimals, rgb, COLOURS, GRID, INK, MARGIN, SWATCH};
use crate::pictures::plot_canvas::Canvas;
use crate::pictures::text::Font;
use crate::pictures::{Picture, PictureError};
use plotters::drawing::DrawingAreaErrorKind;
use plotters::prelude::{ChartBuilder, Circle, IntoDrawingArea, PathElement, ShapeStyle, WHITE};
use std::convert::Infallible;

const RADIUS: i32 = 4;
/// Least width and height of a plot.
const LEAST: [u32; 2] = [260, 200];

/// A point with its name, which may be empty.
type Point = (String, [f64; 2]);

/// A plot of points in groups, each with a colour of its own, and of a line through some of them. The vertical axis is logarithmic, since
/// errors differ by factors.
#[derive(Debug, Clone)]
pub struct Scatter {
    title: String,
    across: String,
    extent: [u32; 2],
    groups: Vec<(String, Vec<Point>)>,
    front: Vec<[f64; 2]>,
}

/// A box of pixels: left, top, right, bottom.
type Area = [i32; 4];

impl Scatter {
    /// A plot without points, 460x340 pixels. The title says what stands upwards, `across` what stands to the right.
    pub fn new(title: impl Into<String>, across: impl Into<String>) -> Self {
        Self { title: title.into(), across: across.into(), extent: [460, 340], groups: Vec::new(), front: Vec::new() }
    }

    /// Sets width and height in pixels.
    #[must_use]
    pub fn size(mut self, width: u32, height: u32) -> Self {
        self.extent = [width, height];
        self
    }

    /// Adds a group of points with their names, which may be empty. A point whose values are not finite, or whose upward value is not
    /// above 0, is left out.
    #[must_use]
    pub fn group(mut self, name: impl Into<String>, points: impl IntoIterator<Item = Point>) -> Self {
        let shown = points.into_iter().filter(|(_, point)| is_shown(*point));
        self.groups.push((name.into(), shown.collect()));
        self
    }

    /// Sets the points that a line joins, from left to right.
    #[must_use]
    pub fn front(mut self, points: impl IntoIterator<Item = [f64; 2]>) -> Self {
        self.front = points.into_iter().filter(|point| is_shown(*point)).collect();
        self
    }

    /// Draws the plot.
    ///
    /// # Errors
    /// [`PictureError::NothingToPlot`] if no point can be shown; [`PictureError::PlotSize`] if the size leaves no room for axes;
    /// [`PictureError::TooLarge`]; [`PictureError::Plot`] if the plotting library fails.
    pub fn render(&self) -> Result<Picture, PictureError> {
        let [width, height] = self.extent;
        if width < LEAST[0] || height < LEAST[1] {
            return Err(PictureError::PlotSize { given: self.extent, needed: LEAST });
        }
        let mut picture = Picture::filled(width, height, [255; 3])?;
        let title = Font::PLOT_TITLE.shortened(&self.title, width - 2 * MARGIN);
        Font::PLOT_TITLE.draw(&mut picture, &title, [MARGIN as i32; 2], INK);
        let legend = MARGIN + Font::PLOT_TITLE.height() + 4;
        self.draw_legend(&mut picture, legend);
        let top = legend + Font::PLOT.height() + 4;
        let mut chart = Picture::filled(width, height - top, [255; 3])?;
        let places = self
            .draw_chart(&mut chart)
            .map_err(|error| PictureError::Plot { title: self.title.clone(), message: error.to_string() })?
            .ok_or_else(|| PictureError::NothingToPlot(self.title.clone()))?;
        self.draw_names(&mut chart, &places);
        picture.paste(&chart, 0, top);
        Ok(picture)
    }

    fn points(&self) -> impl Iterator<Item = &Point> {
        self.groups.iter().flat_map(|(_, points)| points)
    }

    /// Gives the pixel of each point; nothing where there is none.
    fn draw_chart(&self, chart: &mut Picture) -> Result<Option<Vec<(i32, i32)>>, DrawingAreaErrorKind<Infallible>> {
        let along = || self.points().map(|(_, point)| point[0]);
        let (left, right) = (along().fold(f64::INFINITY, f64::min), along().fold(f64::NEG_INFINITY, f64::max));
        if left > right {
            return Ok(None);
        }
        let room = (0.08 * (right - left)).max(1e-3 * right.abs()).max(1e-9);
        let horizontal = left - room..right + room;
        let up = || self.points().map(|(_, point)| point[1]);
        // Logarithms on a linear axis: plotters marks powers of ten alone on a logarithmic one.
        let vertical = up().fold(f64::INFINITY, f64::min).log10() - 0.04..up().fold(0.0, f64::max).log10() + 0.04;
        let area = Canvas(chart).into_drawing_area();
        area.fill(&WHITE)?;
        let mut axes = ChartBuilder::on(&area)
            .x_label_area_size(44)
            .y_label_area_size(58)
            .margin_right(MARGIN)
            .margin_top(8)
            .build_cartesian_2d(horizontal.clone(), vertical)?;
        let x_decimals = decimals(horizontal.end - horizontal.start);
        axes.configure_mesh()
            .axis_style(rgb(INK))
            .bold_line_style(rgb(GRID))
            .light_line_style(WHITE)
            .x_desc(self.across.as_str())
            .x_labels(8)
            .y_labels(8)
            .x_label_formatter(&|x| format!("{x:.x_decimals$}"))
            .y_label_formatter(&|y| two_digits(10f64.powf(*y)))
            .draw()?;
        let line = self.front.iter().map(place).collect::<Vec<_>>();
        axes.draw_series([PathElement::new(line, ShapeStyle { color: rgb(INK).into(), filled: false, stroke_width: 1 })])?;
        for ((_, points), colour) in self.groups.iter().zip(COLOURS.iter().cycle()) {
            let style = ShapeStyle { color: rgb(*colour).into(), filled: true, stroke_width: 1 };
            axes.draw_series(points.iter().map(|(_, point)| Circle::new(place(point), RADIUS, style)))?;
        }
        let places = self.points().map(|(_, point)| axes.backend_coord(&place(point))).collect();
        area.present()?;
        Ok(Some(places))
    }

    /// Writes each name beside its point, where it covers neither a point nor another name, if there is such a place.
    fn draw_names(&self, chart: &mut Picture, places: &[(i32, i32)]) {
        let [right_end, bottom] = [chart.width() as i32, chart.height() as i32 - 44];
        let mut taken: Vec<Area> = places.iter().map(|(x, y)| [x - RADIUS, y - RADIUS, x + RADIUS, y + RADIUS]).collect();
        for ((name, _), (x, y)) in self.points().zip(places).filter(|((name, _), _)| !name.is_empty()) {
            let (width, height) = (Font::PLOT.width_of(name) as i32, Font::PLOT.height() as i32);
            let gap = RADIUS + 3;
            let corners = [
                [x + gap, y - height / 2],
                [x - gap - width, y - height / 2],
                [x - width / 2, y - gap - height],
                [x - width / 2, y + gap],
                [x + gap, y - gap - height],
                [x + gap, y + gap],
            ];
            let area = |[left, top]: [i32; 2]| [left, top, left + width, top + height];
            let is_inside = |a: Area| a[0] >= 58 && a[1] >= 0 && a[2] <= right_end && a[3] <= bottom;
            let is_free = |a: Area| taken.iter().all(|b| a[2] < b[0] || b[2] < a[0] || a[3] < b[1] || b[3] < a[1]);
            let inside = || corners.into_iter().filter(|corner| is_inside(area(*corner)));
            let chosen = inside().find(|corner| is_free(area(*corner))).or_else(|| inside().next()).unwrap_or(corners[0]);
            taken.push(area(chosen));
            Font::PLOT.draw(chart, name, chosen, INK);
        }
    }

    fn draw_legend(&self, picture: &mut Picture, top: u32) {
        let mut left = MARGIN;
        for ((name, _), [r, g, b]) in self.groups.iter().zip(COLOURS.iter().cycle()) {
            let square = i64::from(Font::PLOT.height()) - 5;
            for (dx, dy) in (0..square).flat_map(|dx| (0..square).map(move |dy| (dx, dy))) {
                picture.set(i64::from(left) + dx, i64::from(top) + 2 + dy, [*r, *g, *b]);
            }
            Font::PLOT.draw(picture, name, [(left + SWATCH - 4) as i32, top as i32], INK);
            left += SWATCH + Font::PLOT.width_of(name) + 8;
        }
    }
}

/// Where a point stands on the axes.
fn place([x, y]: &[f64; 2]) -> (f64, f64) {
    (*x, y.log10())
}

/// A number above 0 with two digits.
fn two_digits(value: f64) -> String {
    let decimals = 1.0 - value.log10().floor();
    match (0.0..=6.0).contains(&decimals) {
        true => format!("{value:.0$}", decimals as usize),
        false => format!("{value:.1e}"),
    }
}

fn is_shown([x, y]: [f64; 2]) -> bool {
    x.is_finite() && y.is_finite() && y > 0.0
}
