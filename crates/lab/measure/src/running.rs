//! Filters that run on the same frames.

use crate::measure::Frame;
use crate::Result;
use atrous_engine::{DenoiserOptions, FrameDenoiser, Gpu, PathTracer};

use crate::times::Times;

/// A denoiser with its name and the time that it took.
pub struct Running {
    /// Name in tables.
    pub name: &'static str,
    /// The denoiser.
    pub denoiser: FrameDenoiser,
    /// Times of the frames so far.
    pub times: Times,
}

impl Running {
    /// A denoiser for a tracer's images.
    ///
    /// # Errors
    /// A device without what the denoiser needs, or no memory.
    pub fn new(gpu: &Gpu, tracer: &PathTracer, name: &'static str, options: &DenoiserOptions) -> Result<Self> {
        Ok(Self { name, denoiser: FrameDenoiser::new(gpu, tracer, options)?, times: Times::default() })
    }
}

/// Renders a frame and has every filter denoise it.
///
/// # Errors
/// A lost device.
pub fn render(gpu: &Gpu, tracer: &mut PathTracer, filters: &mut [Running], index: u32) -> Result<()> {
    tracer.begin_frame(index)?;
    denoise(gpu, tracer, filters)
}

/// [`render`] of the frame that the tracer was set to.
///
/// # Errors
/// A lost device.
pub fn denoise(gpu: &Gpu, tracer: &mut PathTracer, filters: &mut [Running]) -> Result<()> {
    gpu.submit(|cmd| {
        tracer.record_gbuffer(cmd);
        filters.iter_mut().try_for_each(|f| f.denoiser.record(cmd, tracer))
    })?;
    // The first frames of a device compile shaders.
    if tracer.frame() >= 2 {
        filters.iter_mut().for_each(|f| f.times.add(&f.denoiser));
    }
    Ok(())
}

/// Reads that frame back.
///
/// # Errors
/// No memory, or a lost device.
pub fn read(gpu: &Gpu, tracer: &PathTracer, filters: &mut [Running]) -> Result<Frame> {
    Frame::read(gpu, tracer, filters.iter_mut().map(|f| &mut f.denoiser))
}
