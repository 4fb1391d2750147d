//! A device under validation, for the tests of this package.

use std::io::Write;
use std::ops::Deref;

use crate::{Gpu, GpuOptions};

/// A device under synchronisation validation; the test fails when it goes with messages.
pub struct Validated(pub Gpu);

impl Validated {
    /// `None`, said on the terminal, where there is no device or no validation layer: the test is skipped then. An error with
    /// `ATROUS_REQUIRE_DEVICE=1`.
    pub fn new() -> Option<Self> {
        match Gpu::new(&GpuOptions { validation: true, ..GpuOptions::default() }) {
            Ok(gpu) => Some(Self(gpu)),
            Err(error) => {
                assert!(std::env::var_os("ATROUS_REQUIRE_DEVICE").is_none(), "ATROUS_REQUIRE_DEVICE is set, but: {error}");
                let thread = std::thread::current();
                // Not by a macro: the test harness would swallow it.
                let _ = writeln!(std::io::stderr(), "SKIPPED {}: {error}", thread.name().unwrap_or("a test"));
                None
            }
        }
    }
}

impl Deref for Validated {
    type Target = Gpu;

    fn deref(&self) -> &Gpu {
        &self.0
    }
}

impl Drop for Validated {
    fn drop(&mut self) {
        let messages = self.0.validation_messages();
        if !std::thread::panicking() {
            assert!(messages.is_empty(), "validation: {messages:#?}");
        }
    }
}
