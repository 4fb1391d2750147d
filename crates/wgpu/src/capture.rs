//! Captures of what a denoiser got, for a report.

use crate::texture::Bound;
use crate::{Error, WgpuDenoiser};
use std::path::Path;
use wgpu::TextureUsages;

impl WgpuDenoiser {
    /// Captures the inputs of the next `frames` frames in `folder`: `atrous-denoise FOLDER` replays them. If the first of them drops
    /// the history, the replay has the bits of your frames.
    ///
    /// Inputs need `COPY_SRC` usage, and stay the same set, until [`Self::frames_to_capture`] is 0. A frame is written when its slot
    /// comes round again; the last ones when you go on, in [`Self::finish_capture`], or when the denoiser is dropped.
    ///
    /// # Errors
    /// [`Error::Texture`] for an input without that usage; errors of `Executor::capture`.
    pub fn capture(&mut self, folder: impl AsRef<Path>, frames: u32) -> Result<(), Error> {
        self.bound.iter().try_for_each(|(name, bound)| check(name, bound))?;
        Ok(self.executor.capture(folder, frames)?)
    }

    /// Frames of the capture that are not written yet; 0 without one, and after it failed.
    pub fn frames_to_capture(&self) -> u32 {
        self.executor.frames_to_capture()
    }

    /// Waits for the GPU, writes the frames that are not yet written, and ends the capture, even if frames are missing. Returns the
    /// number of written frames; 0 without a capture.
    ///
    /// # Errors
    /// [`Error::NotSubmitted`]; the error that ended the capture early.
    pub fn finish_capture(&mut self) -> Result<u32, Error> {
        self.wait_for_all()?;
        // SAFETY: no command buffer of any slot is left.
        Ok(unsafe { self.executor.finish_capture()? })
    }
}

/// Refuses an input that cannot be copied from.
pub(crate) fn check(name: &str, bound: &Bound) -> Result<(), Error> {
    if bound.is_output || bound.texture.usage().contains(TextureUsages::COPY_SRC) {
        return Ok(());
    }
    let problem = format!("its usage is {:?}; a capture needs COPY_SRC as well", bound.texture.usage());
    Err(Error::Texture { name: name.to_owned(), problem })
}
