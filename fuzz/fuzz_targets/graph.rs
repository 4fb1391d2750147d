//! Configurations, and graphs whose nodes are given any image that there is.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    atrous_fuzz::graph::attack(bytes);
});
