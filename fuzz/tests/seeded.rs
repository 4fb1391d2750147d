//! Every body over bytes from seeds, and over the corpus of the fuzzers. `ATROUS_FUZZ=1000000` runs longer than the default.

mod corpus;
mod edits;

use atrous_fuzz::{gltf, graph, sequence, structs, Outcome};
use corpus::{rounds, Tally};
use fastrand::Rng;

/// Bytes of a seed.
fn random(seed: u64, most: usize) -> Vec<u8> {
    let mut rng = Rng::with_seed(seed);
    let count = rng.usize(..most);
    (0..count).map(|_| rng.u8(..)).collect()
}

#[test]
fn random_scenes_are_scenes_or_errors() {
    let folder = tempfile::tempdir().expect("a folder");
    gltf::prepare(folder.path());
    let body = |bytes: &[u8]| gltf::attack(folder.path(), bytes);
    corpus::replay("gltf", body);
    let mut tally = Tally::default();
    for round in 0..rounds(4000) {
        tally.count(&format!("round {round}"), || body(&random(round, 400)));
    }
    tally.assert_has(&[Outcome::Used, Outcome::Refused], 20);
}

#[test]
fn random_graphs_are_run_or_refused() {
    corpus::replay("graph", graph::attack);
    let mut tally = Tally::default();
    for round in 0..rounds(800) {
        tally.count(&format!("round {round}"), || graph::attack(&random(round, 300)));
    }
    tally.assert_has(&[Outcome::Used, Outcome::Refused], 20);
    tally.assert_has(&[Outcome::Large], 500);
}

#[test]
fn random_structs_are_used_or_refused() {
    corpus::replay("structs", structs::attack);
    let mut tally = Tally::default();
    for round in 0..rounds(20_000) {
        tally.count(&format!("round {round}"), || structs::attack(&random(round, 600)));
    }
    tally.assert_has(&[Outcome::Used, Outcome::Refused], 20);
}

#[test]
fn mutated_descriptions_are_errors_or_frames() {
    let folder = tempfile::tempdir().expect("a folder");
    sequence::prepare(folder.path());
    let body = |bytes: &[u8]| sequence::attack(folder.path(), bytes);
    let seeds: Vec<serde_json::Value> =
        corpus::of("sequence").into_iter().filter_map(|(_, bytes)| serde_json::from_slice(&bytes).ok()).collect();
    corpus::replay("sequence", body);
    let mut tally = Tally::default();
    for round in 0..rounds(400) {
        let bytes = edits::description(&seeds, &mut Rng::with_seed(round));
        tally.count(&format!("round {round}"), || body(&bytes));
    }
    tally.assert_has(&[Outcome::Used, Outcome::Refused], 1000);
}
