//! Comparison with an earlier run.

use super::report::{Case, Report};
use atrous_lab::pictures::{Column, PictureError, TextTable};

/// Reasons for which the two runs are hard to compare.
pub fn warnings(before: &Report, now: &Report) -> Vec<String> {
    let mut warnings = Vec::new();
    if before.device != now.device {
        warnings.push(format!("the earlier run was on {}, this one on {}", before.device, now.device));
    }
    if before.clock != now.clock {
        warnings.push(format!("the earlier run has {}, this one {}", before.clock.title(), now.clock.title()));
    }
    let missing = now.cases.iter().filter(|case| counterpart(before, case).is_none());
    warnings.extend(missing.map(|case| format!("the earlier run has no {}", case.name())));
    warnings
}

/// Table of the ratios of each pass and of each frame; below 1 this run is faster. `ratio, arithmetic` is the ratio of times in
/// units of each run's arithmetic loop, which leaves out how fast the machine was.
pub fn table(before: &Report, now: &Report) -> Result<TextTable, PictureError> {
    let columns = [("before ms", 4), ("now ms", 4), ("ratio", 3), ("ratio, arithmetic", 3)];
    let mut table = TextTable::new("against", columns.map(|(name, decimals)| Column::new(name, decimals)));
    for case in &now.cases {
        let Some(old) = counterpart(before, case) else { continue };
        let machine = old.floor.arithmetic_ms / case.floor.arithmetic_ms;
        let row = |a: f64, b: f64| [a, b, b / a, b / a * machine];
        for pass in &case.passes {
            let earlier = old.passes.iter().find(|p| p.name == pass.name).map_or(f64::NAN, |p| p.time.median);
            table.row(format!("{}: {}", case.name(), pass.name), &row(earlier, pass.time.median))?;
        }
        table.row(format!("{}: all passes", case.name()), &row(old.frame.median, case.frame.median))?;
    }
    Ok(table)
}

fn counterpart<'a>(before: &'a Report, case: &Case) -> Option<&'a Case> {
    before.find(&case.graph, case.size, &case.content)
}
