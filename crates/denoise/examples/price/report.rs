//! The table and the picture.

use super::front;
use super::measure::{Point, Sequence, COLUMNS};
use atrous_picture::{Picture, PictureError, Scatter};
use std::fmt::Write;

/// What the price is.
const PRICE: &str = "time, svgf = 1";
/// Width and height of one plot.
const PLOT: [u32; 2] = [620, 400];
/// Plots side by side.
const COLUMNS_OF_PLOTS: u32 = 2;
/// What is on the front is named where it is better by this factor than what was named before.
const WORTH_A_NAME: f64 = 0.95;

/// Whether each point is on the front of a metric.
fn front_of(sequence: &Sequence, metric: usize) -> Vec<bool> {
    let points: Vec<_> = sequence.points.iter().map(|point| (point.price, point.errors[metric])).collect();
    front::of(&points)
}

/// A table for each sequence, cheapest first. Bold: on the front.
pub fn markdown(sequences: &[Sequence]) -> String {
    let mut text = String::new();
    for sequence in sequences {
        let Sequence { name, device, points, extent: [width, height], frames, scored, noisy } = sequence;
        let fronts = [0, 1, 2, 3].map(|metric| front_of(sequence, metric));
        let mut order: Vec<usize> = (0..points.len()).collect();
        order.sort_by(|a, b| points[*a].price.total_cmp(&points[*b].price));
        let _ = writeln!(text, "`{name}`, {width}x{height}, {frames} frames, the last {scored} scored, {device}:\n");
        let _ = writeln!(text, "| filter | {PRICE} | CPU ms | {} |", COLUMNS.map(|(name, _)| name).join(" | "));
        let _ = writeln!(text, "| --- | --- | --- | --- | --- | --- | --- |");
        let cell = |metric: usize, value: f64, is_on: bool| {
            let mark = if is_on { "**" } else { "" };
            format!("{mark}{value:.0$}{mark}", COLUMNS[metric].1)
        };
        for i in order {
            let point = &points[i];
            let cells: Vec<_> = (0..4).map(|metric| cell(metric, point.errors[metric], fronts[metric][i])).collect();
            let _ = writeln!(text, "| {} | {:.2} | {:.1} | {} |", point.name, point.price, point.ms, cells.join(" | "));
        }
        let cells: Vec<_> = (0..4).map(|metric| cell(metric, noisy[metric], false)).collect();
        let _ = writeln!(text, "| noisy | | | {} |\n", cells.join(" | "));
    }
    text
}

/// A plot for each metric of each sequence.
///
/// # Errors
/// No point that is finite, or more plots than a picture has room for.
pub fn picture(sequences: &[Sequence]) -> Result<Picture, PictureError> {
    let [width, height] = PLOT;
    let rows = (COLUMNS.len() as u32).div_ceil(COLUMNS_OF_PLOTS);
    let mut whole = Picture::filled(width * COLUMNS_OF_PLOTS, height * rows * sequences.len() as u32, [255; 3])?;
    for (first_row, sequence) in (0..).step_by(rows as usize).zip(sequences) {
        for (i, (metric, _)) in (0..).zip(COLUMNS) {
            let plot = plot(sequence, i as usize, metric).render()?;
            whole.paste(&plot, i % COLUMNS_OF_PLOTS * width, (first_row + i / COLUMNS_OF_PLOTS) * height);
        }
    }
    Ok(whole)
}

fn plot(sequence: &Sequence, metric: usize, name: &str) -> Scatter {
    let on_front = front_of(sequence, metric);
    let mut scatter = Scatter::new(format!("{}: {name}", sequence.name), PRICE).size(PLOT[0], PLOT[1]);
    let mut front: Vec<_> = sequence.points.iter().zip(on_front).filter_map(|(point, is_on)| is_on.then_some(point)).collect();
    front.sort_by(|a, b| a.price.total_cmp(&b.price));
    let mut named: Vec<&Point> = Vec::new();
    for point in &front {
        if named.last().is_none_or(|before| point.errors[metric] < WORTH_A_NAME * before.errors[metric]) {
            named.push(point);
        }
    }
    let mut groups: Vec<&str> = sequence.points.iter().map(|point| point.group.as_str()).collect();
    groups.sort_unstable();
    groups.dedup();
    let place = |point: &Point| [point.price, point.errors[metric]];
    for group in groups {
        let of_group = sequence.points.iter().filter(|point| point.group == group);
        let mark = |point: &Point| {
            let is_named = point.name == point.group || named.iter().any(|other| other.name == point.name);
            (if is_named { point.name.clone() } else { String::new() }, place(point))
        };
        scatter = scatter.group(group, of_group.map(mark));
    }
    scatter.front(front.into_iter().map(place))
}
