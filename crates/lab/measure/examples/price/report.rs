//! The table and the picture.

use super::front;
use super::measure::{Point, Sequence, COLUMNS, UNIT};
use atrous_lab::pictures::{Picture, PictureError, Scatter};
use std::fmt::Write;

/// What the price is.
const PRICE: &str = "time, svgf = 1";
/// Width and height of one plot.
const PLOT: [u32; 2] = [620, 400];
/// What is on the front is named where it is better by this factor than what was named before.
const WORTH_A_NAME: f64 = 0.95;

/// What several sequences have in common.
struct Mean<'s> {
    /// Name of the point whose errors are 1.
    unit: &'s str,
    points: Vec<Point>,
    noisy: [f64; 4],
}

/// The geometric mean over sequences, of the points that all have; errors as multiples of those of [`UNIT`], or of the first point where
/// that is not run. `None`: fewer than two sequences, or one without that point.
fn mean(sequences: &[Sequence]) -> Option<Mean<'_>> {
    let [first, _, ..] = sequences else { return None };
    let in_all = |name: &str| {
        sequences.iter().map(|sequence| sequence.points.iter().find(|point| point.name == name)).collect::<Option<Vec<_>>>()
    };
    let unit = first.points.iter().find(|point| point.name == UNIT).or(first.points.first())?;
    let units = in_all(&unit.name)?;
    let multiples = |errors: &[[f64; 4]]| {
        [0, 1, 2, 3].map(|i| geometric(errors.iter().zip(&units).map(|(errors, unit)| errors[i] / unit.errors[i])))
    };
    let point = |point: &Point| {
        let same = in_all(&point.name)?;
        Some(Point {
            ms: geometric(same.iter().map(|point| point.ms)),
            price: geometric(same.iter().map(|point| point.price)),
            errors: multiples(&same.iter().map(|point| point.errors).collect::<Vec<_>>()),
            ..point.clone()
        })
    };
    Some(Mean {
        unit: &unit.name,
        points: first.points.iter().filter_map(point).collect(),
        noisy: multiples(&sequences.iter().map(|sequence| sequence.noisy).collect::<Vec<_>>()),
    })
}

fn geometric(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len() as f64;
    (values.map(f64::ln).sum::<f64>() / count).exp()
}

/// Whether each point is on the front of a metric.
fn front_of(points: &[Point], metric: usize) -> Vec<bool> {
    let points: Vec<_> = points.iter().map(|point| (point.price, point.errors[metric])).collect();
    front::of(&points)
}

/// A table of the mean, where there are several sequences, and one for each. Cheapest first; bold: on the front.
pub fn markdown(sequences: &[Sequence]) -> String {
    let mut text = String::new();
    if let Some(mean) = mean(sequences) {
        let (count, unit) = (sequences.len(), mean.unit);
        let _ = writeln!(text, "Geometric mean over {count} sequences, errors as multiples of those of `{unit}`:\n");
        table(&mut text, &mean.points, mean.noisy, [3; 4]);
    }
    for sequence in sequences {
        let Sequence { name, device, points, extent: [width, height], frames, scored, noisy } = sequence;
        let _ = writeln!(text, "`{name}`, {width}x{height}, {frames} frames, the last {scored} scored, {device}:\n");
        table(&mut text, points, *noisy, COLUMNS.map(|(_, decimals)| decimals));
    }
    text
}

fn table(text: &mut String, points: &[Point], noisy: [f64; 4], decimals: [usize; 4]) {
    let fronts = [0, 1, 2, 3].map(|metric| front_of(points, metric));
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|a, b| points[*a].price.total_cmp(&points[*b].price));
    let _ = writeln!(text, "| filter | {PRICE} | CPU ms | {} |", COLUMNS.map(|(name, _)| name).join(" | "));
    let _ = writeln!(text, "| --- | --- | --- | --- | --- | --- | --- |");
    let cell = |metric: usize, value: f64, is_on: bool| {
        let mark = if is_on { "**" } else { "" };
        format!("{mark}{value:.0$}{mark}", decimals[metric])
    };
    for i in order {
        let point = &points[i];
        let cells: Vec<_> = (0..4).map(|metric| cell(metric, point.errors[metric], fronts[metric][i])).collect();
        let _ = writeln!(text, "| {} | {:.2} | {:.1} | {} |", point.name, point.price, point.ms, cells.join(" | "));
    }
    let cells: Vec<_> = (0..4).map(|metric| cell(metric, noisy[metric], false)).collect();
    let _ = writeln!(text, "| noisy | | | {} |\n", cells.join(" | "));
}

/// A plot for each metric: of the mean, or of the first sequence where there is none.
///
/// # Errors
/// No point that is finite.
pub fn picture(sequences: &[Sequence]) -> Result<Picture, PictureError> {
    match mean(sequences) {
        Some(mean) => plots(&[(format!("{} sequences", sequences.len()), mean.points.as_slice())], 2),
        None => plots(&named_points(&sequences[..sequences.len().min(1)]), 2),
    }
}

/// A row of plots, one for each metric, of each sequence.
///
/// # Errors
/// No point that is finite, or more plots than a picture has room for.
pub fn picture_of_each(sequences: &[Sequence]) -> Result<Picture, PictureError> {
    plots(&named_points(sequences), COLUMNS.len() as u32)
}

fn named_points(sequences: &[Sequence]) -> Vec<(String, &[Point])> {
    sequences.iter().map(|sequence| (sequence.name.clone(), sequence.points.as_slice())).collect()
}

fn plots(sequences: &[(String, &[Point])], columns: u32) -> Result<Picture, PictureError> {
    let [width, height] = PLOT;
    let rows = (COLUMNS.len() as u32).div_ceil(columns);
    let mut whole = Picture::filled(width * columns, height * rows * sequences.len() as u32, [255; 3])?;
    for (first_row, (name, points)) in (0..).step_by(rows as usize).zip(sequences) {
        for (i, (metric, _)) in (0..).zip(COLUMNS) {
            let plot = plot(format!("{name}: {metric}"), points, i as usize).render()?;
            whole.paste(&plot, i % columns * width, (first_row + i / columns) * height);
        }
    }
    Ok(whole)
}

fn plot(title: String, points: &[Point], metric: usize) -> Scatter {
    let on_front = front_of(points, metric);
    let mut scatter = Scatter::new(title, PRICE).size(PLOT[0], PLOT[1]);
    let mut front: Vec<_> = points.iter().zip(on_front).filter_map(|(point, is_on)| is_on.then_some(point)).collect();
    front.sort_by(|a, b| a.price.total_cmp(&b.price));
    let mut named: Vec<&Point> = Vec::new();
    for point in &front {
        if named.last().is_none_or(|before| point.errors[metric] < WORTH_A_NAME * before.errors[metric]) {
            named.push(point);
        }
    }
    let mut groups: Vec<&str> = points.iter().map(|point| point.group.as_str()).collect();
    groups.sort_unstable();
    groups.dedup();
    let place = |point: &Point| [point.price, point.errors[metric]];
    for group in groups {
        let of_group = points.iter().filter(|point| point.group == group);
        let mark = |point: &Point| {
            let is_named = point.name == point.group || named.iter().any(|other| other.name == point.name);
            (if is_named { point.name.clone() } else { String::new() }, place(point))
        };
        scatter = scatter.group(group, of_group.map(mark));
    }
    scatter.front(front.into_iter().map(place))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sequence(name: &str, points: &[(&str, f64, f64)]) -> Sequence {
        let point = |(name, price, error): &(&str, f64, f64)| Point {
            name: (*name).to_owned(),
            group: (*name).to_owned(),
            ms: 10.0 * price,
            price: *price,
            errors: [*error; 4],
        };
        Sequence {
            name: name.to_owned(),
            device: "a device".to_owned(),
            points: points.iter().map(point).collect(),
            noisy: [8.0; 4],
            extent: [320, 180],
            frames: 18,
            scored: 6,
        }
    }

    #[test]
    fn the_mean_is_of_multiples_of_svgf() {
        let dark = sequence("dark", &[(UNIT, 1.0, 0.01), ("fast", 0.5, 0.02), ("best", 2.0, 0.005)]);
        let bright = sequence("bright", &[(UNIT, 1.0, 4.0), ("fast", 0.125, 2.0)]);
        let both = [dark, bright];
        let mean = mean(&both).expect("a mean");
        // best is not in both.
        let points: Vec<_> = mean.points.iter().map(|point| (point.name.as_str(), point.price, point.errors[3])).collect();
        assert_eq!(points.len(), 2);
        for ((name, price, error), expected) in points.into_iter().zip([(UNIT, 1.0, 1.0), ("fast", 0.25, 1.0)]) {
            assert_eq!(name, expected.0);
            assert!((price - expected.1).abs() < 1e-12 && (error - expected.2).abs() < 1e-12, "{name}: {price}, {error}");
        }
        assert!((mean.noisy[0] - 40.0).abs() < 1e-9, "{:?}", mean.noisy);
    }

    #[test]
    fn without_svgf_the_first_point_is_the_unit() {
        let both = [sequence("dark", &[("fast", 0.5, 0.02)]), sequence("bright", &[("fast", 0.5, 2.0)])];
        let mean = mean(&both).expect("a mean");
        assert_eq!((mean.unit, mean.points[0].errors), ("fast", [1.0; 4]));
    }

    #[test]
    fn one_sequence_has_no_mean() {
        assert!(mean(&[sequence("alone", &[(UNIT, 1.0, 1.0)])]).is_none());
    }
}
