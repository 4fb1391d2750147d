//! Graphs that make no sense are refused with an error that names node and port, what was given, what is allowed and what to do.

mod matching;
mod whole;

use super::*;
use crate::config::PostProcess;

/// The message of what is wrong with a graph.
fn refusal(graph: Graph) -> String {
    graph.finish().expect_err("the graph makes no sense").to_string()
}

fn assert_names(message: &str, parts: &[&str]) {
    for part in parts {
        assert!(message.contains(part), "{message}\nlacks `{part}`");
    }
}
