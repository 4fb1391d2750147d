//! Tables of a run: the passes of each graph, and all graphs side by side.

use super::report::{Case, Report};
use super::statistics::Spread;
use atrous_lab::pictures::{Column, PictureError, StackedBars, TextTable};

/// Table of the passes of one graph.
pub fn passes(report: &Report, case: &Case) -> Result<TextTable, PictureError> {
    let columns = [
        ("ms", 4),
        ("95 % ms", 4),
        ("%", 1),
        ("ns/pixel", 2),
        ("MB", 2),
        ("GB/s", 2),
        ("floor ms", 4),
        ("× floor", 2),
        ("cycles ms", 4),
        ("× cycles", 2),
        ("× copy", 2),
        ("× arithmetic", 3),
    ];
    let mut table = TextTable::new(case.name(), columns.map(|(name, decimals)| Column::new(name, decimals)));
    let total: f64 = case.passes.iter().map(|p| p.time.median).sum();
    let row = |time: Spread, share: f64, bytes: u64, cycles: Option<f64>| {
        let (ms, megabytes) = (time.median, bytes as f64 * 1e-6);
        // A pass that touches buffers alone has no bytes to compare.
        let gb_per_s = if bytes == 0 || ms == 0.0 { f64::NAN } else { megabytes / ms };
        let per_pixel = ms * 1e6 / case.pixels();
        let floor = report.floor_ms(bytes);
        let (cycles, copy) = (report.cycles_ms(cycles), case.floor.over_copy(ms, bytes));
        let over_arithmetic = ms / case.floor.arithmetic_ms;
        [ms, time.p95, share, per_pixel, megabytes, gb_per_s, floor, ms / floor, cycles, ms / cycles, copy, over_arithmetic]
    };
    for pass in &case.passes {
        table.row(&pass.name, &row(pass.time, 100.0 * pass.time.median / total, pass.bytes, pass.cycles))?;
    }
    let bytes = case.passes.iter().map(|p| p.bytes).sum();
    // Without those of one pass the sum would be no floor of all.
    let cycles = case.passes.iter().map(|p| p.cycles).sum();
    table.row("all passes", &row(case.frame, 100.0, bytes, cycles))?;
    Ok(table)
}

/// Table of all graphs.
pub fn summary(report: &Report) -> Result<TextTable, PictureError> {
    let columns = [
        ("ms", 3),
        ("95 % ms", 3),
        ("ns/pixel", 2),
        ("× arithmetic", 2),
        ("passes", 0),
        ("moved B/pixel", 1),
        ("history B/pixel", 1),
        ("transient B/pixel", 1),
        ("allocated MB", 1),
        ("recording µs", 1),
        ("start-up ms", 1),
        ("start-up CPU ms", 1),
    ];
    let mut table = TextTable::new("graph", columns.map(|(name, decimals)| Column::new(name, decimals)));
    for case in &report.cases {
        let pixels = case.pixels();
        let values = [
            case.frame.median,
            case.frame.p95,
            case.ns_per_pixel(),
            case.frame.median / case.floor.arithmetic_ms,
            case.passes.len() as f64,
            case.passes.iter().map(|p| p.bytes).sum::<u64>() as f64 / pixels,
            case.memory.history as f64 / pixels,
            case.memory.transient as f64 / pixels,
            case.memory.allocated as f64 * 1e-6,
            case.host.recording_us,
            case.host.start_up_ms,
            case.host.start_up_cpu_ms,
        ];
        table.row(case.name(), &values)?;
    }
    Ok(table)
}

/// Picture with a bar for each case, with a segment for each pass in the colour of its stage.
pub fn bars(report: &Report) -> StackedBars {
    let title = format!("Time of a pixel by pass: {}, {}", report.device, report.clock.title());
    let mut bars = StackedBars::new(title, "ns a pixel");
    for case in &report.cases {
        let segments = case.passes.iter().map(|p| (p.stage.as_str(), p.time.median * 1e6 / case.pixels()));
        let sum: f64 = segments.clone().map(|(_, ns)| ns).sum();
        bars = bars.bar(format!("{} {sum:.1}", case.name()), segments);
    }
    bars
}
