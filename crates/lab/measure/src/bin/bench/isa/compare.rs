//! Comparison of statistics with a table that is kept: a shader that grew is a finding.

use super::report::{IsaReport, Shader, INVERSE_THROUGHPUT, VGPRS};

/// Growth that is let pass.
const SLACK: f64 = 1.1;

/// The reason why two reports have nothing to compare: another compiler gives other figures.
pub fn incomparable(kept: &IsaReport, now: &IsaReport) -> Option<String> {
    let same = kept.driver == now.driver && kept.device == now.device;
    let message = || {
        let (kept, now) = (format!("{}, {}", kept.device, kept.driver), format!("{}, {}", now.device, now.driver));
        format!("the table was made with {kept}; here is {now}: nothing was compared")
    };
    (!same).then(message)
}

/// Shaders that grew by more than 10 % in registers, or, without loops, in cycles; and those that the table lacks, or has in vain
/// where those of all presets are compared.
pub fn findings(kept: &IsaReport, now: &IsaReport, all: bool) -> Vec<String> {
    let mut findings = Vec::new();
    for shader in &now.shaders {
        match kept.find(&shader.name) {
            Some(before) => findings.extend(growth(before, shader)),
            None => findings.push(format!("{} is not in the table", shader.name)),
        }
    }
    let gone = kept.shaders.iter().filter(|shader| all && now.find(&shader.name).is_none());
    findings.extend(gone.map(|shader| format!("{} is in the table, and no graph has it", shader.name)));
    findings
}

fn growth(before: &Shader, now: &Shader) -> Vec<String> {
    let unrolled = before.loops == 0 && now.loops == 0;
    let compared = [(VGPRS, true), (INVERSE_THROUGHPUT, unrolled)].into_iter().filter(|(_, compared)| *compared);
    compared
        .filter_map(|(name, _)| {
            let (a, b) = (before.statistics.get(name)?, now.statistics.get(name)?);
            let percent = 100.0 * (b / a - 1.0);
            (*b > SLACK * a).then(|| format!("{}: {name} grew from {a} to {b}, by {percent:.0} %", now.name))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn report(vgprs: f64, cycles: f64, loops: u32) -> IsaReport {
        let statistics = [(VGPRS.to_owned(), vgprs), (INVERSE_THROUGHPUT.to_owned(), cycles)].into();
        let shader = Shader { name: "atrous WIRED=0x1f".into(), loops, statistics };
        IsaReport { device: "NAVI21".into(), driver: "radv Mesa 22.3.6".into(), shaders: vec![shader] }
    }

    #[test]
    fn growth_within_the_slack_passes() {
        assert!(findings(&report(40.0, 1000.0, 0), &report(44.0, 1100.0, 0), true).is_empty());
        assert!(findings(&report(40.0, 1000.0, 0), &report(20.0, 10.0, 0), true).is_empty());
    }

    #[test]
    fn growth_beyond_it_is_found() {
        let found = findings(&report(40.0, 1000.0, 0), &report(48.0, 1200.0, 0), true);
        assert_eq!(
            found,
            [
                "atrous WIRED=0x1f: VGPRs grew from 40 to 48, by 20 %",
                "atrous WIRED=0x1f: Inverse Throughput grew from 1000 to 1200, by 20 %"
            ]
        );
    }

    #[test]
    fn cycles_of_loops_are_not_compared() {
        assert!(findings(&report(40.0, 1000.0, 1), &report(40.0, 2000.0, 1), true).is_empty());
        assert_eq!(findings(&report(40.0, 1000.0, 1), &report(48.0, 2000.0, 1), true).len(), 1);
    }

    #[test]
    fn shaders_of_one_side_alone_are_found() {
        let none = IsaReport { shaders: Vec::new(), ..report(1.0, 1.0, 0) };
        assert_eq!(findings(&none, &report(1.0, 1.0, 0), true), ["atrous WIRED=0x1f is not in the table"]);
        assert_eq!(findings(&report(1.0, 1.0, 0), &none, true), ["atrous WIRED=0x1f is in the table, and no graph has it"]);
        assert!(findings(&report(1.0, 1.0, 0), &none, false).is_empty());
    }

    #[test]
    fn another_driver_is_not_compared() {
        let kept = report(1.0, 1.0, 0);
        assert!(incomparable(&kept, &kept).is_none());
        let other = IsaReport { driver: "radv Mesa 25.0.7".into(), ..kept.clone() };
        let message = incomparable(&kept, &other).unwrap();
        assert!(message.contains("22.3.6") && message.contains("25.0.7") && message.contains("nothing was compared"), "{message}");
    }

    #[test]
    fn a_table_is_read_as_it_was_written() {
        let kept = report(40.0, 1234.0, 2);
        let page = "# A page\n\n<!-- bench --isa: begin -->\nold\n<!-- bench --isa: end -->\n\nmore\n";
        let written = kept.written_into(page).unwrap();
        assert!(written.starts_with("# A page\n") && written.ends_with("\n\nmore\n") && !written.contains("old"), "{written}");
        assert_eq!(IsaReport::from_markdown(&written).unwrap(), kept);
        assert_eq!(kept.written_into(&written).unwrap(), written);
        let error = IsaReport::from_markdown("# A page").unwrap_err();
        assert!(error.contains("are missing"), "{error}");
    }
}
