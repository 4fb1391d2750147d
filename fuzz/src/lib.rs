//! Attacks on what takes files, graphs and structs of others. Each body takes bytes: a test makes them from a seed or reads them from
//! `corpus`, a fuzzer (`fuzz_targets`) makes them from what it saw. A body panics where something is wrong, and says what became of
//! the input.

mod choices;
pub mod exr;
pub mod gltf;
pub mod graph;
pub mod sequence;
pub mod structs;

pub use choices::Choices;

/// What became of an input that was taken as it should be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// It made sense, and was used.
    Used,
    /// It made sense, and was too large to be tried.
    Large,
    /// It was refused, with an error that names what was wrong.
    Refused,
}
