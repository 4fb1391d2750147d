//! Images of a host in its own formats, with two frames in flight.
use super::GpuTest;
pub const TESTS: &[GpuTest] = &[];
