//! What a driver's compiler makes of every shader: registers, occupancy, instructions, cycles. Free of noise, and without a GPU
//! where Mesa's RADV opens its null device: see docs/lab/performance.md.

mod compare;
mod device;
mod pipeline;
mod report;
mod shaders;

use crate::options::Options;
use atrous::Declaration;
use device::{OpenError, StatisticsDevice};
use report::IsaReport;
use std::error::Error;
use std::path::Path;
use std::process::ExitCode;
use std::sync::OnceLock;

/// The page with the table of all shaders.
const PAGE: &str = include_str!("../../../../../../../docs/lab/performance.md");
/// Invocations of a wave in the table.
const LANES: u64 = 64;

/// The exit status where no device offers statistics.
const NO_STATISTICS: u8 = 3;

pub fn run(options: &Options) -> Result<ExitCode, Box<dyn Error>> {
    let kept = options.against.as_deref().map(read).transpose()?;
    let declarations = shaders::declarations(options)?;
    let device = match StatisticsDevice::open(options.device.as_deref()) {
        Ok(device) => device,
        Err(OpenError::None(devices)) => {
            eprintln!(
                "error: no device offers VK_KHR_pipeline_executable_properties (devices: {devices}). Mesa's driver for AMD does \
                 without a GPU: set VK_ICD_FILENAMES to its radeon_icd.*.json and RADV_FORCE_FAMILY to navi21"
            );
            return Ok(NO_STATISTICS.into());
        }
        Err(OpenError::Other(error)) => return Err(error),
    };
    let mut report = IsaReport { device: device.name.clone(), driver: device.driver.clone(), shaders: Vec::new() };
    for (name, pipeline) in &shaders::pipelines(&declarations) {
        let shader = pipeline::statistics(&device, name, pipeline).map_err(|e| format!("{name}: {e}"))?;
        report.shaders.push(shader);
    }
    println!("{}", report.to_markdown()?);
    if let Some(path) = &options.json {
        std::fs::write(path, serde_json::to_string_pretty(&report)? + "\n").map_err(|e| format!("{}: {e}", path.display()))?;
    }
    if let Some(path) = &options.update {
        let text = std::fs::read_to_string(path).map_err(|e| format!("{}: {e}", path.display()))?;
        let text = report.written_into(&text).map_err(|e| format!("{}: {e}", path.display()))?;
        std::fs::write(path, text).map_err(|e| format!("{}: {e}", path.display()))?;
    }
    Ok(kept.map_or(ExitCode::SUCCESS, |kept| compared(&kept, &report, options.preset.is_empty())))
}

/// Cycles of one SIMD that a pass keeps busy in a frame of the allocated extent, by the table of the page; `None` where that lacks the
/// shader.
pub fn cycles(declaration: &Declaration, pass: usize) -> Option<f64> {
    static TABLE: OnceLock<Option<IsaReport>> = OnceLock::new();
    let pipeline = match declaration.passes().get(pass)?.pipeline() {
        Some(pipeline) => pipeline,
        // An upload keeps no SIMD busy.
        None => return Some(0.0),
    };
    let table = TABLE.get_or_init(|| IsaReport::from_markdown(PAGE).ok()).as_ref()?;
    let of_wave = table.find(&shaders::name(&pipeline))?.statistics.get(report::INVERSE_THROUGHPUT)?;
    Some(declaration.invocations(pass).div_ceil(LANES) as f64 * of_wave)
}

fn read(path: &Path) -> Result<IsaReport, Box<dyn Error>> {
    let text = std::fs::read_to_string(path).map_err(|e| format!("{}: {e}", path.display()))?;
    Ok(IsaReport::from_markdown(&text).map_err(|e| format!("{}: {e}", path.display()))?)
}

fn compared(kept: &IsaReport, now: &IsaReport, all: bool) -> ExitCode {
    if let Some(reason) = compare::incomparable(kept, now) {
        println!("{reason}");
        return ExitCode::SUCCESS;
    }
    let findings = compare::findings(kept, now, all);
    for finding in &findings {
        eprintln!("{finding}");
    }
    if findings.is_empty() {
        println!("{} shaders are within 10 % of the table", now.shaders.len());
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    }
}
