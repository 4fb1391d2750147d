//! The table of nodes against the methods of `Graph`, and graphs that go wrong.

use super::NODES;
use std::collections::BTreeSet;
use std::path::Path;

/// The public methods of `Graph` in a file, but for those that make no node.
fn methods(text: &str) -> Vec<String> {
    const OTHERS: [&str; 5] = ["new", "of", "share_outputs", "scope", "finish"];
    const BY_A_FUNCTION: [&str; 3] = ["output", "output_samples", "stage"];
    let inside = text.split("\nimpl Graph {").skip(1).map(|rest| rest.split("\n}\n").next().unwrap_or_default());
    let names = inside
        .flat_map(|body| body.split("\n    pub fn ").skip(1))
        .map(|rest| rest.split(['(', '<']).next().unwrap_or_default().to_owned());
    names.filter(|name| !OTHERS.contains(&name.as_str()) && !BY_A_FUNCTION.contains(&name.as_str())).collect()
}

#[test]
fn the_table_has_every_node_of_rust() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../src");
    let mut files = vec![root.join("graph/mod.rs"), root.join("graph/resources.rs"), root.join("graph/stage.rs")];
    for entry in std::fs::read_dir(root.join("nodes")).expect("src/nodes") {
        files.push(entry.expect("an entry").path().join("mod.rs"));
    }
    let texts = files.iter().filter(|file| file.is_file()).map(|file| std::fs::read_to_string(file).expect("a file"));
    let of_rust: BTreeSet<String> = texts.flat_map(|text| methods(&text)).collect();
    let of_c: BTreeSet<String> = NODES.iter().map(|node| node.name.to_owned()).collect();
    assert_eq!(of_c.len(), NODES.len(), "each stands once");
    assert_eq!(of_c, of_rust);
}
