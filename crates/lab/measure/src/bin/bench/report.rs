//! The figures of a run, as they are written to a file and read from it.

use super::chip;
use super::clock::Clock;
use super::content::Content;
use super::statistics::Spread;
use atrous::executor::HeadlessDevice;
use serde::{Deserialize, Serialize};
use std::error::Error;
use std::path::Path;

/// Format that the files of this version name.
const FORMAT: &str = "atrous-bench 1";

#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Report {
    pub format: String,
    pub device: String,
    /// Name and version; empty where the driver does not say, and in figures of a version that did not write it.
    #[serde(default)]
    pub driver: String,
    /// Of the memory, GB/s: as given, or of the data sheet.
    #[serde(default)]
    pub bandwidth: Option<f64>,
    /// Of all SIMDs together, where the table of shaders is of this chip.
    #[serde(default)]
    pub cycles_per_ms: Option<f64>,
    pub clock: Clock,
    /// Fused multiply-adds a pixel of the arithmetic loop.
    pub multiply_adds: u32,
    pub cases: Vec<Case>,
}

/// One graph at one size with one content.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Case {
    pub graph: String,
    pub size: [u32; 2],
    pub content: String,
    pub passes: Vec<Pass>,
    /// Milliseconds of all passes of a frame together.
    pub frame: Spread,
    pub memory: Memory,
    pub host: HostCost,
    /// The same run's yardsticks at this size.
    pub floor: Floor,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Pass {
    pub name: String,
    /// The stage that it runs; of a pass without a shader its name.
    pub stage: String,
    /// Milliseconds.
    pub time: Spread,
    /// Texels of all images that it touches, each read or written once.
    pub bytes: u64,
    /// Cycles of one SIMD, by the table of shaders; `None` where that has no such shader.
    #[serde(default)]
    pub cycles: Option<f64>,
}

/// Bytes of a graph.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Memory {
    pub history: u64,
    /// Aliased by lifetime.
    pub transient: u64,
    /// Histories and transients as the device counts them, with its alignment.
    pub allocated: u64,
}

/// Cost on the CPU of a host.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct HostCost {
    /// All pipelines, on the wall clock.
    pub start_up_ms: f64,
    /// All pipelines, CPU time of all threads.
    pub start_up_cpu_ms: f64,
    /// CPU time of recording a frame.
    pub recording_us: f64,
}

/// Speed that the device reached with the yardsticks.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Floor {
    /// `None` where the copy takes no longer than a submission without work.
    pub copy_gb_per_s: Option<f64>,
    pub arithmetic_ms: f64,
    /// The least of the arithmetic loop; 0 in figures of a version that did not write it.
    #[serde(default)]
    pub least_arithmetic_ms: f64,
    /// CPU time of a submission without work, which is taken off; 0 where timestamps are used.
    pub empty_submission_ms: Spread,
}

impl Report {
    /// `chip`: the one that counts in place of the device; `bandwidth`: in place of that of the data sheet.
    pub fn new(gpu: &HeadlessDevice, clock: Clock, chip: Option<&str>, bandwidth: Option<f64>) -> Self {
        let chip = chip.unwrap_or(gpu.name());
        Self {
            format: FORMAT.to_owned(),
            device: gpu.name().to_owned(),
            driver: chip::driver(gpu),
            bandwidth: bandwidth.or_else(|| chip::bandwidth(chip)),
            cycles_per_ms: chip::cycles_per_ms(chip),
            clock,
            multiply_adds: super::yardsticks::MULTIPLY_ADDS,
            cases: Vec::new(),
        }
    }

    /// Milliseconds that the memory needs for so many bytes; NaN where its bandwidth is not known.
    pub fn floor_ms(&self, bytes: u64) -> f64 {
        self.bandwidth.filter(|_| bytes > 0).map_or(f64::NAN, |gb_per_s| bytes as f64 / gb_per_s * 1e-6)
    }

    /// Milliseconds that the SIMDs need for so many cycles; NaN where they or the cycles are not known.
    pub fn cycles_ms(&self, cycles: Option<f64>) -> f64 {
        cycles.zip(self.cycles_per_ms).map_or(f64::NAN, |(cycles, per_ms)| cycles / per_ms)
    }

    pub fn read(path: &Path) -> Result<Self, Box<dyn Error>> {
        let text = std::fs::read_to_string(path).map_err(|e| format!("{}: {e}", path.display()))?;
        let report: Self = serde_json::from_str(&text)
            .map_err(|e| format!("{} holds no figures of this benchmark; give a file that --json wrote ({e})", path.display()))?;
        if report.format != FORMAT {
            return Err(
                format!("{} has the format \"{}\"; this benchmark reads \"{FORMAT}\"", path.display(), report.format).into()
            );
        }
        Ok(report)
    }

    pub fn write(&self, path: &Path) -> Result<(), Box<dyn Error>> {
        let text = serde_json::to_string_pretty(self)? + "\n";
        Ok(std::fs::write(path, text).map_err(|e| format!("{}: {e}", path.display()))?)
    }

    pub fn find(&self, graph: &str, size: [u32; 2], content: &str) -> Option<&Case> {
        self.cases.iter().find(|c| c.graph == graph && c.size == size && c.content == content)
    }

    /// Lowers the least times of a case to those of another visit.
    pub fn lower_least(&mut self, visit: &Case) {
        if let Some(case) = self.cases.iter_mut().find(|case| case.name() == visit.name()) {
            case.frame.least = case.frame.least.min(visit.frame.least);
            case.floor.least_arithmetic_ms = case.floor.least_arithmetic_ms.min(visit.floor.least_arithmetic_ms);
        }
    }

    pub fn of_content(&self, graph: &str, size: [u32; 2], content: Content) -> Option<&Case> {
        self.find(graph, size, content.name())
    }
}

impl Case {
    pub fn pixels(&self) -> f64 {
        f64::from(self.size[0]) * f64::from(self.size[1])
    }

    pub fn name(&self) -> String {
        format!("{} {}x{} {}", self.graph, self.size[0], self.size[1], self.content)
    }

    /// Nanoseconds that a frame takes for each pixel.
    pub fn ns_per_pixel(&self) -> f64 {
        self.frame.median * 1e6 / self.pixels()
    }

    /// Nanoseconds that the fastest frame took for each pixel.
    pub fn least_ns_per_pixel(&self) -> f64 {
        self.frame.least * 1e6 / self.pixels()
    }
}

impl Floor {
    /// A time over what a copy of as many bytes takes; NaN where that is not known, or there are none.
    pub fn over_copy(&self, ms: f64, bytes: u64) -> f64 {
        self.copy_gb_per_s.filter(|_| bytes > 0).map_or(f64::NAN, |gb_per_s| ms / (bytes as f64 / gb_per_s * 1e-6))
    }
}
