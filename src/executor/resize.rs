//! A new extent for an executor or a session: memory is allocated anew, pipelines stay.

use super::{Executor, Session};
use crate::error::Error;

impl Executor {
    /// Runs the same passes for a new extent. Pipelines stay. Histories, transients and outputs are
    /// allocated anew, before the old ones are freed. The first frame drops all history: see
    /// [`Denoiser::resize`](crate::Denoiser::resize).
    ///
    /// Your buffers stay bound. Your images do not: [`Self::begin_frame`] names each one that you
    /// neither bound again nor unbound. A capture ends here, since its frames have one extent:
    /// `finish_capture` reports missing frames.
    ///
    /// # Errors
    /// Errors of [`Denoiser::resize`](crate::Denoiser::resize); [`Error::OutOfMemory`]. Nothing is changed then.
    ///
    /// # Safety
    /// All GPU work recorded with this executor is complete, in every frame slot, and no recorded
    /// work is left to submit.
    pub unsafe fn resize(&mut self, allocated_extent: [u32; 2]) -> Result<(), Error> {
        let declaration = self.denoiser.resized(allocated_extent)?;
        // SAFETY: no GPU work uses the memory that is replaced, and the device has the formats and is large enough for the extent.
        unsafe { self.memory.reallocate(&declaration, &self.options)? };
        self.denoiser.adopt(declaration);
        self.counters.resize();
        #[cfg(feature = "capture")]
        // SAFETY: all GPU work is complete, so that nothing writes to the buffers of the capture.
        unsafe {
            self.capture.end_before_resize()
        };
        Ok(())
    }
}

impl Session {
    /// Runs the same passes for a new extent, without history and without input images: upload each
    /// again, or unbind it. Buffers and pipelines stay: see [`Executor::resize`].
    ///
    /// # Errors
    /// Errors of [`Executor::resize`]. Nothing is changed then.
    pub fn resize(&mut self, allocated_extent: [u32; 2]) -> Result<(), Error> {
        self.settle()?;
        // SAFETY: every frame was waited for.
        unsafe { self.executor.resize(allocated_extent)? };
        self.inputs.clear();
        self.frame = None;
        Ok(())
    }
}
