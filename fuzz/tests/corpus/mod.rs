//! The corpus of the fuzzers, and what became of each input.

use atrous_fuzz::Outcome;
use std::panic::{catch_unwind, AssertUnwindSafe};
use std::path::Path;

/// Rounds of a loop: so many, or as `ATROUS_FUZZ` says.
pub fn rounds(usual: u64) -> u64 {
    let Ok(text) = std::env::var("ATROUS_FUZZ") else { return usual };
    text.parse().expect("ATROUS_FUZZ is a whole number")
}

/// The files of a target by name.
pub fn of(target: &str) -> Vec<(String, Vec<u8>)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus").join(target);
    let entries = std::fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut files: Vec<_> = entries
        .map(|entry| {
            let path = entry.expect("an entry").path();
            (path.display().to_string(), std::fs::read(&path).expect("a file of the corpus"))
        })
        .collect();
    files.sort();
    assert!(!files.is_empty(), "{} is empty", folder.display());
    files
}

/// Gives every file of a target to its body.
pub fn replay(target: &str, mut body: impl FnMut(&[u8]) -> Outcome) {
    for (name, bytes) in of(target) {
        Tally::default().count(&name, || body(&bytes));
    }
}

/// What became of many inputs.
#[derive(Default)]
pub struct Tally(Vec<Outcome>);

impl Tally {
    /// Notes what becomes of an input, and names the one that panics.
    pub fn count(&mut self, name: &str, body: impl FnOnce() -> Outcome) {
        let outcome = catch_unwind(AssertUnwindSafe(body));
        self.0.push(outcome.unwrap_or_else(|_| panic!("{name} panicked")));
    }

    /// Each of these is at least one in `share`.
    pub fn assert_has(&self, outcomes: &[Outcome], share: usize) {
        let count = |outcome| self.0.iter().filter(|o| **o == outcome).count();
        let [used, large, refused] = [Outcome::Used, Outcome::Large, Outcome::Refused].map(count);
        println!("{used} used, {large} too large, {refused} refused");
        assert!(outcomes.iter().all(|o| count(*o) > self.0.len() / share), "{used} used, {large} too large, {refused} refused");
    }
}
