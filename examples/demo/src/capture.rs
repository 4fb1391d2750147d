//! What each filter is given, as an EXR sequence with references, which `atrous-denoise` filters again and scores.

#[cfg(feature = "capture")]
pub use with_feature::{finish, start};
#[cfg(not(feature = "capture"))]
pub use without_feature::{finish, start};

#[cfg(feature = "capture")]
mod with_feature {
    use crate::error::Result;
    use atrous_engine::{Error, FrameDenoiser};
    use atrous_measure::measure::Frame;
    use exr::prelude::write_rgb_file;
    use std::path::Path;

    /// Captures the next `frames` frames.
    pub fn start(denoiser: &mut FrameDenoiser, folder: &Path, frames: u32) -> Result<()> {
        Ok(denoiser.capture(folder, frames)?)
    }

    /// Writes what is left, and the references beside the frames that have one.
    pub fn finish(denoiser: &mut FrameDenoiser, folder: &Path, measured: &[Frame]) -> Result<()> {
        denoiser.finish_capture()?;
        for frame in measured {
            let Some(reference) = &frame.reference else { continue };
            let path = folder.join(format!("frame_{:04}_ref.exr", frame.index));
            let [width, height] = frame.extent.map(|side| side as usize);
            let pixel = |x: usize, y: usize| <(f32, f32, f32)>::from(reference[y * width + x]);
            write_rgb_file(&path, width, height, pixel).map_err(|e| Error::Folder { path, problem: e.to_string() })?;
        }
        Ok(())
    }
}

#[cfg(not(feature = "capture"))]
mod without_feature {
    use crate::error::{Error, Result};
    use atrous_engine::FrameDenoiser;
    use atrous_measure::measure::Frame;
    use std::path::Path;

    pub fn start(_: &mut FrameDenoiser, _: &Path, _: u32) -> Result<()> {
        Err(Error::NoCapture)
    }

    pub fn finish(_: &mut FrameDenoiser, _: &Path, _: &[Frame]) -> Result<()> {
        Err(Error::NoCapture)
    }
}
