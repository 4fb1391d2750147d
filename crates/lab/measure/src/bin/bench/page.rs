//! A page about one device, which a user can send.

use super::report::Report;
use super::tables;
use atrous_lab::pictures::PictureError;
use std::fmt::Write;

/// Device, driver and clock, all graphs side by side, then the passes of each.
pub fn of(report: &Report) -> Result<String, PictureError> {
    let Report { device, driver, clock, .. } = report;
    let bandwidth = report.bandwidth.map_or("not known".to_owned(), |gb_per_s| format!("{gb_per_s} GB/s"));
    let mut page = format!("## {device}\n\n");
    let lines = [
        ("Driver", if driver.is_empty() { "not told" } else { driver }),
        ("atrous", env!("CARGO_PKG_VERSION")),
        ("Clock", clock.title()),
        ("Memory bandwidth", &bandwidth),
        ("System", std::env::consts::OS),
    ];
    for (name, value) in lines {
        let _ = writeln!(page, "- {name}: {value}");
    }
    let _ = write!(page, "\n{}", tables::summary(report)?);
    for case in &report.cases {
        let _ = write!(page, "\n### {}\n\n{}", case.name(), tables::passes(report, case)?);
    }
    Ok(page)
}
