//! What the tool reads, refuses and writes.

mod advice_tests;
mod bad_files;
mod capture_tests;
mod check_tests;
mod compression_tests;
mod fuzz;
mod gate;
mod guide_tests;
mod keep_tests;
mod layout_tests;
mod light_tests;
mod lobe_tests;
mod look_tests;
mod module_tests;
mod name_tests;
#[cfg(unix)]
mod odd_files;
mod output_tests;
mod path_tests;
mod reading;
mod resume_tests;
mod runs;
mod sequence_tests;
