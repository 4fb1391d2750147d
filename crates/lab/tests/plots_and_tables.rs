//! Line plots, points, stacked bars and text tables.

use atrous_lab::pictures::{Column, LinePlot, Picture, PictureError, Scatter, StackedBars, TextTable};

const WHITE: [u8; 3] = [255; 3];
/// First and second colour of the lines.
const BLUE: [u8; 3] = [0, 114, 178];
const RED: [u8; 3] = [213, 94, 0];

fn columns_with(picture: &Picture, colour: [u8; 3]) -> Vec<u32> {
    (0..picture.width()).filter(|&x| (0..picture.height()).any(|y| picture.pixel(x, y) == Some(colour))).collect()
}

#[test]
fn every_series_has_a_line_and_a_legend() {
    let plot = LinePlot::new("RMSE").size(600, 300).series("noisy", vec![0.5, 0.6, 0.4]).series("SVGF", vec![0.1; 3]);
    let picture = plot.render().unwrap();
    assert_eq!([picture.width(), picture.height()], [600, 300]);
    for colour in [BLUE, RED] {
        let columns = columns_with(&picture, colour);
        assert!(columns.len() > 300, "{}", columns.len());
        assert!(*columns.last().unwrap() > 500, "no legend");
    }
    // Nothing reaches the edge.
    assert!((0..300).all(|y| picture.pixel(0, y) == Some(WHITE) && picture.pixel(599, y) == Some(WHITE)));
}

#[test]
fn values_that_are_not_finite_are_gaps() {
    let nan = f64::NAN;
    let plot = |values: Vec<f64>| LinePlot::new("x").size(600, 300).series("s", values).render().unwrap();
    let whole = columns_with(&plot(vec![1.0; 9]), BLUE).len();
    let gaps = columns_with(&plot(vec![1.0, 1.0, nan, nan, nan, nan, f64::INFINITY, 1.0, nan]), BLUE).len();
    assert!(gaps > 50 && gaps < whole / 2, "{gaps} of {whole}");
}

#[test]
fn one_frame_and_constant_values_are_drawn() {
    for values in [
        vec![0.0],
        vec![0.0; 4],
        vec![-3.0; 2],
        vec![1e-30; 3],
        vec![1e30, 2e30],
        vec![f64::MIN, f64::MAX],
        vec![0.0, f64::MIN_POSITIVE],
        vec![0.0, 1e-26],
        vec![1.0, 1.0 + f64::EPSILON],
        vec![1.0, 1.0 + 2e-9],
        vec![-1e-12, 1e30],
    ] {
        let picture = LinePlot::new("x").size(400, 200).series("s", values.clone()).render().unwrap();
        assert!(columns_with(&picture, BLUE).len() > 18, "{values:?}");
    }
}

#[test]
fn a_plot_without_values_or_room_is_an_error() {
    assert!(matches!(LinePlot::new("x").render(), Err(PictureError::NothingToPlot(_))));
    let nan = LinePlot::new("x").series("s", vec![f64::NAN]).render();
    assert!(matches!(nan, Err(PictureError::NothingToPlot(_))));
    let small = LinePlot::new("x").size(100, 100).series("s", vec![1.0]).render();
    assert!(matches!(small, Err(PictureError::PlotSize { .. })));
}

fn point(name: &str, across: f64, up: f64) -> (String, [f64; 2]) {
    (name.to_owned(), [across, up])
}

#[test]
fn points_stand_where_their_values_are() {
    let scatter = Scatter::new("RMSE", "ms").group("a", [point("", 1.0, 0.1)]).group("b", [point("", 2.0, 0.01)]);
    let picture = scatter.render().unwrap();
    // Below the legend.
    let middle = |colour| {
        let places = (60..picture.height()).flat_map(|y| (0..picture.width()).map(move |x| [x, y]));
        let found: Vec<_> = places.filter(|[x, y]| picture.pixel(*x, *y) == Some(colour)).collect();
        assert!(found.len() > 20, "{}", found.len());
        [0, 1].map(|c| found.iter().map(|place| place[c]).sum::<u32>() / found.len() as u32)
    };
    let ([left, high], [right, low]) = (middle(BLUE), middle(RED));
    assert!(left + 100 < right && high + 100 < low, "{left}, {high} and {right}, {low}");
    let ink = |picture: &Picture| picture.pixels().iter().filter(|p| **p != WHITE).count();
    let named = Scatter::new("RMSE", "ms").group("a", [point("name", 1.0, 0.1)]).group("b", [point("", 2.0, 0.01)]);
    assert!(ink(&named.render().unwrap()) > ink(&picture) + 20);
    let joined = scatter.clone().front([[1.0, 0.1], [2.0, 0.01]]);
    assert!(ink(&joined.render().unwrap()) > ink(&picture) + 100);
}

#[test]
fn points_that_cannot_be_shown_are_left_out() {
    let bad = [point("x", f64::NAN, 1.0), point("y", 1.0, 0.0), point("z", 1.0, f64::INFINITY)];
    let none = Scatter::new("x", "ms").group("a", bad.clone()).render();
    assert!(matches!(none, Err(PictureError::NothingToPlot(_))));
    let one = |points: Vec<_>| Scatter::new("x", "ms").group("a", points).render().unwrap();
    let plain = one(vec![point("", 1.0, 1.0)]);
    assert!(one([&bad[..], &[point("", 1.0, 1.0)]].concat()).pixels() == plain.pixels());
    let small = Scatter::new("x", "ms").size(100, 100).group("a", [point("", 1.0, 1.0)]).render();
    assert!(matches!(small, Err(PictureError::PlotSize { .. })));
    for up in [1e-300, 1e-12, 1e12, 1e300] {
        Scatter::new("x", "ms").group("a", [point("far", 1e-9, up), point("", 1e9, up)]).render().unwrap();
    }
}

#[test]
fn tables_are_aligned() {
    let mut table = TextTable::new("denoiser", [Column::new("RMSE", 4), Column::new("ms", 1)]);
    table.row("noisy", &[0.0576, f64::NAN]).unwrap();
    table.row("percentile", &[0.02341, 120.0]).unwrap();
    let expected = "\
| denoiser   |   RMSE |    ms |
|------------|--------|-------|
| noisy      | 0.0576 |     - |
| percentile | 0.0234 | 120.0 |
";
    assert_eq!(table.to_string(), expected);
    assert_eq!(table.rows().last(), Some(("percentile", &[0.02341, 120.0][..])));
    let shown: Vec<_> = table.columns().iter().map(|c| c.show(0.05)).collect();
    assert_eq!((table.corner(), shown), ("denoiser", vec!["0.0500".into(), "0.1".to_owned()]));
    let error = table.row("svgf", &[1.0]).unwrap_err();
    assert_eq!(error.to_string(), "row \"svgf\" has 1 values, but the table has 2 columns of values");
}

#[test]
fn a_bar_is_as_long_as_its_segments() {
    let bars = StackedBars::new("time", "ms").bar("svgf", [("import", 1.0), ("atrous", 3.0)]).bar("eaw", [("atrous", 2.0)]);
    let picture = bars.render().unwrap();
    let plot = 0..picture.width() - 120;
    let row = |y: u32, colour| plot.clone().filter(|&x| picture.pixel(x, y) == Some(colour)).count();
    let longest = |colour| (0..picture.height()).map(|y| row(y, colour)).max().unwrap();
    let (import, atrous) = (longest(BLUE), longest(RED));
    assert!(import > 100 && atrous.abs_diff(3 * import) < 8, "{import}, {atrous}");
    // Each name once in the legend, and the bar of `eaw` two thirds of the other's segment.
    let rows: Vec<usize> = (0..picture.height()).map(|y| row(y, RED)).filter(|n| *n > 50).collect();
    assert!(rows.iter().any(|n| n.abs_diff(2 * import) < 8), "{rows:?}");
}

#[test]
fn bars_without_length_or_room_are_an_error() {
    let nan = StackedBars::new("x", "ms").bar("a", [("b", f64::NAN), ("c", -1.0)]).render();
    assert!(matches!(nan, Err(PictureError::NothingToPlot(_))));
    assert!(matches!(StackedBars::new("x", "ms").render(), Err(PictureError::NothingToPlot(_))));
    let narrow = StackedBars::new("x", "ms").width(100).bar("a", [("b", 1.0)]).render();
    assert!(matches!(narrow, Err(PictureError::PlotSize { .. })));
    let huge = StackedBars::new("x", "ms").bar("a", [("b", 1e200)]).render();
    assert!(matches!(huge, Err(PictureError::NothingToPlot(_))));
    for value in [1e-17, 1e-9, 1e12, 1e29] {
        StackedBars::new("x", "ms").bar("a", [("b", value)]).render().unwrap();
    }
}
