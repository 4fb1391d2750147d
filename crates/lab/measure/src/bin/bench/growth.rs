//! How cost grows with the size, and whether it depends on the content.

use super::content::Content;
use super::report::{Case, Report};
use atrous_lab::pictures::{Column, PictureError, TextTable};

/// Times that every size is visited, in turn, with images of its own: a slow minute hits all sizes alike, and so does where in memory
/// images come to lie.
pub const VISITS: u32 = 3;

/// Nanoseconds a pixel of the fastest frame at each size, and over those at the smallest: as they are, and in units of the arithmetic
/// loop at each size.
pub fn with_size(report: &Report, sizes: &[[u32; 2]]) -> Result<TextTable, PictureError> {
    let columns = sizes.iter().flat_map(|[w, h]| {
        [Column::new(format!("{w}x{h} ns/pixel"), 2), Column::new("× smallest", 3), Column::new("× smallest, arithmetic", 3)]
    });
    let mut table = TextTable::new("cost of a pixel", columns);
    for content in Content::ALL {
        for graph in graphs(report) {
            let at = |size| report.of_content(graph, size, content);
            let cost =
                |size| at(size).map_or([f64::NAN; 2], |c| [c.least_ns_per_pixel(), c.frame.least / c.floor.least_arithmetic_ms]);
            let smallest = sizes.first().map_or([f64::NAN; 2], |size| cost(*size));
            let values = sizes.iter().flat_map(|size| {
                let [ns, arithmetic] = cost(*size);
                [ns, ns / smallest[0], arithmetic / smallest[1]]
            });
            table.row(format!("{graph} {content}"), &values.collect::<Vec<_>>())?;
        }
    }
    Ok(table)
}

/// Nanoseconds a pixel of the fastest frame of both contents, and their ratio.
pub fn with_content(report: &Report, sizes: &[[u32; 2]]) -> Result<TextTable, PictureError> {
    let columns = [("moving ns/pixel", 2), ("wall ns/pixel", 2), ("moving / wall", 3)];
    let mut table = TextTable::new("content", columns.map(|(name, decimals)| Column::new(name, decimals)));
    for graph in graphs(report) {
        for &size in sizes {
            let of = |content| report.of_content(graph, size, content).map_or(f64::NAN, Case::least_ns_per_pixel);
            let (moving, wall) = (of(Content::Moving), of(Content::Wall));
            table.row(format!("{graph} {}x{}", size[0], size[1]), &[moving, wall, moving / wall])?;
        }
    }
    Ok(table)
}

/// Names of graphs, each once.
fn graphs(report: &Report) -> Vec<&str> {
    let mut names: Vec<&str> = Vec::new();
    for case in &report.cases {
        if !names.contains(&case.graph.as_str()) {
            names.push(&case.graph);
        }
    }
    names
}
