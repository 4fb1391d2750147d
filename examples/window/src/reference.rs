//! The reference that grows while everything rests: surfaces, and the medium where the scene has one.

use std::time::Duration;

use super::panes::Source;
use atrous_engine::tracer::ReferenceSums;
use atrous_engine::Result;
use atrous_engine::{Outputs, PathTracer};

/// Sums of both. They grow by themselves: their samples take different time.
pub struct GrowingReference {
    surfaces: ReferenceSums<2>,
    medium: Option<ReferenceSums<1>>,
}

impl GrowingReference {
    /// Without a sample, for the images of a tracer.
    ///
    /// # Errors
    /// No memory.
    pub fn new(tracer: &PathTracer) -> Result<Self> {
        Ok(Self { surfaces: tracer.reference_sums()?, medium: tracer.volume_sums()? })
    }

    /// The next samples are the first ones.
    pub fn restart(&mut self) {
        self.surfaces.restart();
        if let Some(medium) = &mut self.medium {
            medium.restart();
        }
    }

    /// Adds samples of the tracer's frame, whose G-buffer was drawn: as many as take about `time`, at most `limit` in all.
    ///
    /// # Errors
    /// A lost device.
    pub fn add(&mut self, tracer: &PathTracer, time: Duration, limit: u32) -> Result<()> {
        let Some(medium) = &mut self.medium else { return self.surfaces.add(tracer, time, limit) };
        self.surfaces.add(tracer, time / 2, limit)?;
        medium.add(tracer, time / 2, limit)
    }

    /// Takes other code, if it is of one of the two shaders; whether it is. No work of theirs is pending.
    ///
    /// # Errors
    /// No memory, or a lost device.
    #[cfg(feature = "hot-reload")]
    pub fn replace_shader(&mut self, shader: &atrous_engine::hot_reload::Compiled) -> Result<bool> {
        let medium = self.medium.as_mut().map_or(Ok(false), |medium| medium.replace_shader(shader))?;
        Ok(self.surfaces.replace_shader(shader)? || medium)
    }

    /// Samples for each pixel so far, of that which has fewer.
    pub fn samples(&self) -> u32 {
        let surfaces = self.surfaces.samples();
        self.medium.as_ref().map_or(surfaces, |medium| surfaces.min(medium.samples()))
    }

    /// The picture, with what is seen directly in the tracer's frame.
    pub fn source<'a>(&'a self, outputs: &'a Outputs) -> Source<'a> {
        let weight = |samples: u32| 1.0 / samples.max(1) as f32;
        let [direct, indirect] = &self.surfaces.sums;
        let surfaces = weight(self.surfaces.samples());
        let medium = self.medium.as_ref().map(|medium| (&medium.sums[0], weight(medium.samples())));
        Source::sum((direct, surfaces), [(indirect, surfaces), (&outputs.emission, 1.0)].into_iter().chain(medium))
    }
}
