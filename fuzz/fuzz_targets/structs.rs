//! Structs of the C ABI.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    atrous_fuzz::structs::attack(bytes);
});
