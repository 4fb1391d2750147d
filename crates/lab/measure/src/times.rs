//! GPU time of each pass, over frames.

use atrous_engine::FrameDenoiser;

/// Times of the frames so far.
#[derive(Default)]
pub struct Times {
    passes: Vec<String>,
    frames: Vec<Vec<f64>>,
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
        let (passes, milliseconds) = times.into_iter().map(|time| (time.name, time.milliseconds)).unzip();
        self.passes = passes;
        self.frames.push(milliseconds);
    }

    /// Milliseconds of each pass; nothing where the device has no timestamps.
    pub fn means(&self) -> Option<Vec<(String, f64)>> {
        let mean = |pass: usize| self.frames.iter().map(|frame| frame[pass]).sum::<f64>() / self.frames.len() as f64;
        let passes = self.passes.iter().enumerate().map(|(pass, name)| (name.clone(), mean(pass)));
        (!self.frames.is_empty()).then(|| passes.collect())
    }

    /// Milliseconds of a frame; NaN where the device has no timestamps.
    pub fn of_a_frame(&self) -> f64 {
        self.means().map_or(f64::NAN, |passes| passes.iter().map(|p| p.1).sum())
    }

    /// Milliseconds of each stage in each frame: of all its levels and steps. Nothing where the device has no timestamps.
    pub fn stages(&self) -> Vec<(String, Vec<f64>)> {
        let mut stages: Vec<(String, Vec<f64>)> = Vec::new();
        for (pass, name) in self.passes.iter().enumerate() {
            let of_pass = self.frames.iter().map(|frame| frame[pass]);
            match stages.iter_mut().find(|(stage, _)| stage == stage_of(name)) {
                Some((_, sums)) => sums.iter_mut().zip(of_pass).for_each(|(sum, time)| *sum += time),
                None => stages.push((stage_of(name).to_owned(), of_pass.collect())),
            }
        }
        stages
    }
}

/// The stage that a pass is a level or a step of.
fn stage_of(pass: &str) -> &str {
    let is_part = |part: &str| matches!(part, "clear" | "claim" | "resolve") || part.parse::<u32>().is_ok();
    match pass.rsplit_once('_') {
        Some((stage, part)) if is_part(part) => stage,
        _ => pass,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_and_steps_are_parts_of_their_stage() {
        let passes = ["forward_project_clear", "forward_project_claim", "atrous_0", "atrous_1", "atrous_volume_0", "tone_map"];
        let frames = vec![vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0], vec![2.0; 6]];
        let times = Times { passes: passes.map(str::to_owned).to_vec(), frames };
        let expected =
            [("forward_project", [3.0, 4.0]), ("atrous", [7.0, 4.0]), ("atrous_volume", [5.0, 2.0]), ("tone_map", [6.0, 2.0])];
        assert_eq!(times.stages(), expected.map(|(name, times)| (name.to_owned(), times.to_vec())));
        assert_eq!(times.means().expect("frames")[2], ("atrous_0".to_owned(), 2.5));
        assert!(Times::default().means().is_none() && Times::default().stages().is_empty());
    }
}
