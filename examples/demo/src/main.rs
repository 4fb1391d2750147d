//! The standalone demo.
fn main() {}
