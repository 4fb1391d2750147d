//! Graphs to measure besides the presets. Add a function and a line of [`GRAPHS`]; `--preset` takes the name.

use atrous::graph::{Feedback, Graph};
use atrous::nodes::{Accumulation, Atrous, Demodulate, Import, Modulate, Variance};
use atrous::{Declaration, Error};

/// A graph by name.
pub struct OwnGraph {
    pub name: &'static str,
    pub declare: fn([u32; 2]) -> Result<Declaration, Error>,
}

pub const GRAPHS: &[OwnGraph] = &[OwnGraph { name: "custom", declare: custom }];

/// The graph of docs/graphs.md: SVGF with three levels.
fn custom(size: [u32; 2]) -> Result<Declaration, Error> {
    let mut g = Graph::new(size);
    let guides = g.import(Import::default());
    let noisy = g.radiance("noisy_radiance");
    let irradiance = g.demodulate(&guides, &noisy, Demodulate::default());
    let history = g.history(&irradiance, Feedback::Filtered);
    let accumulated = g.temporal_accumulation(&guides, &irradiance, &history, Accumulation::default());
    let estimate = g.variance(&guides, &accumulated, &history, Variance::default());
    let filtered = g.atrous(&guides, &estimate, Atrous { levels: 3, feedback: Some(history), ..Atrous::default() });
    let denoised = g.modulate(&guides, &filtered.into(), Modulate::default());
    g.output("denoised_radiance", &denoised);
    g.finish()
}
