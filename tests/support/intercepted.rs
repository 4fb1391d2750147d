//! The device of the tests with functions of a test between it and the caller.

use super::gpu;
use atrous::executor::HeadlessDevice;
use atrous::Device;
use std::ffi::{c_void, CStr};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// The device. One of a kind at a time: functions of C know of no test.
pub struct Intercepted {
    device: ash::Device,
    gpu: Arc<HeadlessDevice>,
    _alone: MutexGuard<'static, ()>,
}

impl Intercepted {
    /// Calls what `replacement` gives for a name in the place of the device's function. `alone` is held as long as this lives; `start`
    /// runs behind it, and is given the device whose functions pass calls on: the library makes pipelines on threads of its own, which
    /// have no [`gpu`].
    ///
    /// # Safety
    /// Each function has the signature of the Vulkan function of that name.
    pub unsafe fn new(
        alone: &'static Mutex<()>,
        start: impl FnOnce(Arc<HeadlessDevice>),
        replacement: fn(&CStr) -> Option<*const c_void>,
    ) -> Self {
        let alone = alone.lock().unwrap_or_else(PoisonError::into_inner);
        let gpu = gpu();
        start(gpu.clone());
        // SAFETY: the functions have the signatures of those that they stand for.
        let device = unsafe { gpu.device_with(replacement) };
        Self { device, gpu, _alone: alone }
    }

    /// The handles for a denoiser or an executor, which shares no pipeline with those whose calls are not seen.
    pub fn host(&self) -> Device<'_> {
        Device { device: &self.device, pipelines: None, ..self.gpu.host() }
    }
}
