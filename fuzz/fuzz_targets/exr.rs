//! EXR files, under the memory that a run is said to take.
#![no_main]

use libfuzzer_sys::fuzz_target;
use peak_alloc::PeakAlloc;
use std::sync::LazyLock;
use tempfile::TempDir;

#[global_allocator]
static ALLOCATOR: PeakAlloc = PeakAlloc;

static FOLDER: LazyLock<TempDir> = LazyLock::new(|| {
    // The decoder's panics are errors of the tool, which catches them: the hook of the fuzzer would end the program at the first.
    // One that nobody catches ends it still.
    std::panic::set_hook(Box::new(|info| eprintln!("{info}")));
    tempfile::tempdir().expect("a folder")
});

fn peak(work: &mut dyn FnMut()) -> u64 {
    let before = ALLOCATOR.current_usage();
    ALLOCATOR.reset_peak_usage();
    work();
    ALLOCATOR.peak_usage().saturating_sub(before) as u64
}

fuzz_target!(|bytes: &[u8]| {
    atrous_fuzz::exr::attack(FOLDER.path(), bytes, peak);
});
