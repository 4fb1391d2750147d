//! GPU time of each pass, over frames.

use atrous_demo::FrameDenoiser;

/// Sums over frames.
#[derive(Default)]
pub struct Times {
    passes: Vec<(String, f64)>,
    frames: u32,
}

impl Times {
    /// Adds what the denoiser measured last, if anything.
    pub fn add(&mut self, denoiser: &FrameDenoiser) {
        let mut times = denoiser.times();
        // No part of a frame here: views are recorded behind it, for the pictures.
        times.retain(|time| time.name != "debug_view");
        if times.is_empty() {
            return;
        }
        self.passes.resize(times.len(), (String::new(), 0.0));
        for (sum, time) in self.passes.iter_mut().zip(times) {
            *sum = (time.name, sum.1 + time.milliseconds);
        }
        self.frames += 1;
    }

    /// Milliseconds of each pass; nothing where the device has no timestamps.
    pub fn means(&self) -> Option<Vec<(String, f64)>> {
        let mean = |(name, sum): &(String, f64)| (name.clone(), sum / f64::from(self.frames));
        (self.frames > 0).then(|| self.passes.iter().map(mean).collect())
    }

    /// Milliseconds of a frame; NaN where the device has no timestamps.
    pub fn of_a_frame(&self) -> f64 {
        self.means().map_or(f64::NAN, |passes| passes.iter().map(|p| p.1).sum())
    }
}
