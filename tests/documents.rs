//! What is written twice must say the same.

use super::GpuTest;

pub const TESTS: &[GpuTest] = &[("the_readme_shows_a_part_of_host_ash", the_readme_shows_a_part_of_host_ash)];

/// The lines between the markers, without their common indentation.
fn excerpt(source: &str) -> String {
    let inside = source.lines().skip_while(|l| l.trim() != "// README: begin").skip(1);
    let lines = inside.take_while(|l| l.trim() != "// README: end");
    lines.map(|l| format!("{}\n", l.strip_prefix("    ").unwrap_or(l))).collect()
}

fn the_readme_shows_a_part_of_host_ash() {
    let source = include_str!("../examples/host_ash.rs");
    let excerpt = excerpt(source);
    let lines = excerpt.lines().count();
    assert!((20..=32).contains(&lines), "{lines} lines");
    assert!(include_str!("../README.md").contains(&excerpt), "README.md must have this from examples/host_ash.rs:\n{excerpt}");
    let whole = source.lines().count();
    assert!(whole < 250, "examples/host_ash.rs has {whole} lines; an engine that takes 250 proves nothing");
}
