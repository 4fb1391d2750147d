//! A value per frame, one line for each series.

use crate::pages::axis::Ticks;
use crate::pages::PageError;
use crate::pictures::{value_axis, Series};
use maud::{html, Markup, Render};
use std::fmt::Write;
use std::ops::Range;

/// Colours that the style has; lines beyond have them again, dashed.
const COLOURS: usize = 7;
/// Width and height of the drawing in its own units. It is stretched to the room that a screen has.
const EXTENT: f64 = 1000.0;

/// Curves over the frames of a run. The legend hides and shows a line, and says its value at the frame under the pointer.
#[derive(Debug, Clone)]
pub struct Curves {
    title: String,
    unit: String,
    first_frame: u32,
    series: Vec<Series>,
}

impl Curves {
    /// Curves without series; the first value of each is of frame 0.
    pub fn new(title: impl Into<String>) -> Self {
        Self { title: title.into(), unit: String::new(), first_frame: 0, series: Vec::new() }
    }

    /// Sets the unit of the values, which stands above their axis.
    #[must_use]
    pub fn unit(mut self, unit: impl Into<String>) -> Self {
        self.unit = unit.into();
        self
    }

    /// Sets the number of the frame that the first value of each series belongs to.
    #[must_use]
    pub fn first_frame(mut self, frame: u32) -> Self {
        self.first_frame = frame;
        self
    }

    /// Adds a line: one value per frame; where one is not finite the line has a gap.
    #[must_use]
    pub fn series(mut self, name: impl Into<String>, values: impl Into<Vec<f64>>) -> Self {
        self.series.push(Series { name: name.into(), values: values.into() });
        self
    }

    pub(crate) fn check(&self) -> Result<(), PageError> {
        value_axis(&self.series).map(drop).ok_or_else(|| PageError::NothingToPlot(self.title.clone()))
    }

    pub(crate) fn markup(&self) -> Markup {
        let vertical = value_axis(&self.series).unwrap_or(0.0..1.0);
        let count = self.series.iter().map(|s| s.values.len()).max().unwrap_or(0);
        let first = f64::from(self.first_frame);
        let horizontal = first..first + count.saturating_sub(1) as f64;
        let (rows, columns) = (Ticks::new(&vertical, 6), Ticks::whole(&horizontal, 12));
        let up = |value: f64| place(value, &vertical);
        let along = |frame: f64| place(frame, &horizontal);
        html! {
            figure.curves data-first=(self.first_frame) data-count=(count) {
                figcaption { (self.title) }
                div.legend { @for (i, series) in self.series.iter().enumerate() {
                    button type="button" aria-pressed="true" class=(class(i)) data-values=(Values(&series.values)) {
                        span.swatch {} span.name { (series.name) } span.value {}
                    }
                } }
                div.unit { (self.unit) }
                div.chart {
                    div.rows aria-hidden="true" { @for value in &rows.values {
                        span style=(format!("bottom:{:.2}%", 100.0 * up(*value))) { (rows.label(*value)) }
                    } }
                    div.plot tabindex="0" role="img" aria-label=(format!("{}: one line for each series; arrow keys choose a frame", self.title)) {
                        svg viewBox=(format!("0 0 {EXTENT} {EXTENT}")) preserveAspectRatio="none" aria-hidden="true" {
                            path.grid d=(Grid(rows.values.iter().map(|v| up(*v)).collect())) {}
                            @for (i, series) in self.series.iter().enumerate() {
                                g class=(class(i)) {
                                    @for part in Part::ALL {
                                        path class=(part.class()) d=(Path { series, part, horizontal: &horizontal, vertical: &vertical, first }) {}
                                    }
                                }
                            }
                        }
                        div.cursor hidden {}
                    }
                    div.columns aria-hidden="true" { @for frame in &columns.values {
                        span style=(format!("left:{:.2}%", 100.0 * along(*frame))) { (columns.label(*frame)) }
                    } }
                    div.across { "frame" }
                }
            }
        }
    }
}

fn class(index: usize) -> String {
    let again = if index < COLOURS { "" } else { " again" };
    format!("series series-{}{again}", index % COLOURS)
}

/// Where a value stands on an axis, from 0 to 1; one frame alone stands in the middle.
fn place(value: f64, range: &Range<f64>) -> f64 {
    let length = range.end - range.start;
    if length > 0.0 {
        ((value - range.start) / length).clamp(0.0, 1.0)
    } else {
        0.5
    }
}

/// Values for the script, which shows four digits of them; a gap is empty.
struct Values<'a>(&'a [f64]);

impl Render for Values<'_> {
    fn render_to(&self, text: &mut String) {
        for (i, value) in self.0.iter().enumerate() {
            if i > 0 {
                text.push(',');
            }
            if value.is_finite() {
                let _ = write!(text, "{value:.4e}");
            }
        }
    }
}

struct Grid(Vec<f64>);

impl Render for Grid {
    fn render_to(&self, path: &mut String) {
        for up in &self.0 {
            let _ = write!(path, "M0 {:.1}H{EXTENT}", EXTENT * (1.0 - up));
        }
    }
}

/// What is drawn of a series: values with a neighbour are a line, and one without is a dot, which a line would not show.
#[derive(Clone, Copy, PartialEq)]
enum Part {
    Line,
    Dots,
}

impl Part {
    const ALL: [Self; 2] = [Self::Line, Self::Dots];

    fn class(self) -> &'static str {
        match self {
            Self::Line => "line",
            Self::Dots => "dots",
        }
    }
}

struct Path<'a> {
    series: &'a Series,
    part: Part,
    horizontal: &'a Range<f64>,
    vertical: &'a Range<f64>,
    first: f64,
}

impl Render for Path<'_> {
    fn render_to(&self, path: &mut String) {
        let points: Vec<_> = self.series.values.iter().enumerate().collect();
        for run in points.split(|(_, value)| !value.is_finite()).filter(|run| !run.is_empty()) {
            if (run.len() == 1) != (self.part == Part::Dots) {
                continue;
            }
            for (i, &(frame, &value)) in run.iter().enumerate() {
                let x = EXTENT * place(self.first + frame as f64, self.horizontal);
                let y = EXTENT * (1.0 - place(value, self.vertical));
                let _ = write!(path, "{}{x:.1} {y:.1}", if i == 0 { 'M' } else { 'L' });
            }
            if self.part == Part::Dots {
                path.push_str("h0");
            }
        }
    }
}
