//! EXR files under the memory that a run is said to take. A program of its own, with one test: nothing else allocates beside it.

mod corpus;
mod edits;

use atrous_fuzz::{exr, Outcome};
use corpus::{rounds, Tally};
use fastrand::Rng;
use peak_alloc::PeakAlloc;

#[global_allocator]
static ALLOCATOR: PeakAlloc = PeakAlloc;

fn peak(work: &mut dyn FnMut()) -> u64 {
    let before = ALLOCATOR.current_usage();
    ALLOCATOR.reset_peak_usage();
    work();
    ALLOCATOR.peak_usage().saturating_sub(before) as u64
}

#[test]
fn edited_files_are_frames_or_errors_and_take_what_is_said() {
    let folder = tempfile::tempdir().expect("a folder");
    let body = |bytes: &[u8]| exr::attack(folder.path(), bytes, peak);
    let seeds = corpus::of("exr");
    corpus::replay("exr", body);
    for (name, edit) in [("bytes", edits::bytes as fn(&[u8], &mut Rng) -> Vec<u8>), ("windows", edits::windows)] {
        let mut tally = Tally::default();
        for round in 0..rounds(2500) {
            let mut rng = Rng::with_seed(round);
            let seed = &seeds[rng.usize(..seeds.len())].1;
            let bytes = edit(seed, &mut rng);
            tally.count(&format!("{name}, round {round}"), || body(&bytes));
        }
        tally.assert_has(&[Outcome::Used, Outcome::Refused], 50);
    }
}
