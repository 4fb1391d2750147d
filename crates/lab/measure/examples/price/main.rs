//! Quality for the price: presets and kernels as points, CPU time against error, on sequences with references. Writes `price.png`, the
//! mean over the sequences, `price_sequences.png`, `price.md` and `price.json`:
//! `cargo run --release -p atrous-measure --example price -- SEQUENCE... --out FOLDER`. docs/lab/performance.md shows the last run.

mod filters;
mod front;
mod measure;
mod report;

use atrous::executor::{HeadlessDevice, HeadlessOptions};
use clap::Parser;
use measure::Sequence;
use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;

/// Filters every frame of each sequence by every point, in turn, and draws time against error with the front.
#[derive(Parser)]
struct Options {
    /// Folders of frames with references, as `atrous-denoise` reads them; a capture of the demo is one. None: those in `price.json` are
    /// drawn again
    sequences: Vec<PathBuf>,
    /// Folder for the pictures, `price.md` and `price.json`; sequences that are in the last one stay, unless they are measured again
    #[arg(long, default_value = "out/price")]
    out: PathBuf,
    /// Frames of each sequence that are run, from the first on. Default: all
    #[arg(long, value_parser = clap::value_parser!(u32).range(4..))]
    frames: Option<u32>,
    /// Frames at the end of those that are scored
    #[arg(long, default_value_t = 10, value_parser = clap::value_parser!(u32).range(2..))]
    scored: u32,
    /// Points whose name has this in it; may be given several times. Default: all
    #[arg(long = "filter")]
    filters: Vec<String>,
    /// Index or a part of the name of the device
    #[arg(long)]
    device: Option<String>,
}

fn main() -> ExitCode {
    match run(&Options::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(options: &Options) -> Result<(), Box<dyn Error>> {
    let is_wanted = |name: &str| options.filters.is_empty() || options.filters.iter().any(|part| name.contains(part.as_str()));
    let filters: Vec<_> = filters::all().into_iter().filter(|filter| is_wanted(&filter.name)).collect();
    if filters.is_empty() {
        let names: Vec<_> = filters::all().into_iter().map(|filter| filter.name).collect();
        return Err(format!("--filter {:?} leaves none of: {}", options.filters, names.join("; ")).into());
    }
    std::fs::create_dir_all(&options.out)?;
    let json = options.out.join("price.json");
    let mut sequences: Vec<Sequence> = if json.exists() { serde_json::from_slice(&std::fs::read(&json)?)? } else { Vec::new() };
    let open = || HeadlessDevice::new(&HeadlessOptions { device: options.device.clone(), ..Default::default() }).map(Arc::new);
    // What was measured before is drawn without a device.
    let gpu = (!options.sequences.is_empty()).then(open).transpose()?;
    for (path, gpu) in options.sequences.iter().zip(gpu.iter().cycle()) {
        let measured = measure::Frames { path, run: options.frames, scored: options.scored }.measure(gpu, &filters)?;
        sequences.retain(|sequence| sequence.name != measured.name);
        sequences.push(measured);
        // What is done is kept, whatever happens to the rest.
        std::fs::write(&json, serde_json::to_vec_pretty(&sequences)?)?;
    }
    if sequences.is_empty() {
        return Err(format!("no sequence was given, and {} has none", json.display()).into());
    }
    let text = report::markdown(&sequences);
    std::fs::write(options.out.join("price.md"), &text)?;
    report::picture(&sequences)?.write_png(options.out.join("price.png"))?;
    report::picture_of_each(&sequences)?.write_png(options.out.join("price_sequences.png"))?;
    print!("{text}");
    Ok(())
}
