//! Time, traffic and memory of every pass, and what a driver's compiler makes of the shaders: `cargo run --release -p
//! atrous-measure --bin bench -- --help`. docs/lab/performance.md says how to read it.

mod against;
mod chip;
mod clock;
mod content;
mod graphs;
mod growth;
mod host_cost;
mod images;
mod inputs;
mod isa;
mod measure;
mod options;
mod page;
mod report;
mod runner;
mod statistics;
mod subject;
mod tables;
mod yardsticks;

use atrous::executor::{HeadlessDevice, HeadlessOptions};
use clap::Parser;
use clock::Clock;
use measure::{Graph, Measurement};
use options::Options;
use report::{Case, Report};
use std::error::Error;
use std::process::ExitCode;
use std::sync::Arc;

fn main() -> ExitCode {
    let options = Options::parse();
    let done = match &options {
        options if options.isa => isa::run(options),
        options if options.images => print_images(options),
        options => bench(options).map(|()| ExitCode::SUCCESS),
    };
    done.unwrap_or_else(|error| {
        eprintln!("error: {error}");
        ExitCode::FAILURE
    })
}

fn print_images(options: &Options) -> Result<ExitCode, Box<dyn Error>> {
    print!("{}", images::tables(options)?);
    Ok(ExitCode::SUCCESS)
}

fn bench(options: &Options) -> Result<(), Box<dyn Error>> {
    let before = options.against.as_deref().map(Report::read).transpose()?;
    let gpu = Arc::new(HeadlessDevice::new(&HeadlessOptions { device: options.device.clone(), ..Default::default() })?);
    let cpu_device = clock::is_cpu(&gpu);
    let clock = if cpu_device && !options.timestamps { Clock::ProcessCpuTime } else { Clock::timestamps(&gpu)? };
    let sizes = options.sizes(cpu_device);
    println!("{}; {}; {} rounds of {} frames\n", gpu.name(), clock.title(), options.rounds, options.frames);
    let mut report = Report::new(&gpu, clock, options.chip.as_deref(), options.bandwidth);
    let measured = |size| -> Result<Vec<Case>, Box<dyn Error>> {
        let (contents, frames, rounds) = (&options.contents(), options.frames, options.rounds);
        Measurement { gpu: &gpu, clock, contents, size, frames, rounds }.run(&graphs(options, size)?)
    };
    for &size in &sizes {
        let cases = measured(size)?;
        for case in &cases {
            println!("{}", tables::passes(&report, case)?);
        }
        if let Some(case) = cases.first() {
            print_floor(&case.floor, clock);
        }
        if options.choices().visibility > 1 {
            print_lights(&cases);
        }
        report.cases.extend(cases);
    }
    println!("{}", tables::summary(&report)?);
    if options.growth {
        for _ in 1..growth::VISITS {
            for &size in &sizes {
                measured(size)?.iter().for_each(|case| report.lower_least(case));
            }
        }
        println!("{}\n{}", growth::with_size(&report, &sizes)?, growth::with_content(&report, &sizes)?);
    }
    if let Some(before) = &before {
        against::warnings(before, &report).iter().for_each(|warning| println!("note: {warning}"));
        println!("{}", against::table(before, &report)?);
    }
    if let Some(path) = &options.report {
        std::fs::write(path, page::of(&report)?).map_err(|e| format!("{}: {e}", path.display()))?;
    }
    if let Some(path) = &options.json {
        report.write(path)?;
    }
    if let Some(path) = &options.picture {
        tables::bars(&report).render()?.write_png(path)?;
    }
    Ok(())
}

fn graphs(options: &Options, size: [u32; 2]) -> Result<Vec<Graph>, atrous::Error> {
    let choices = options.choices();
    // Beside several lights one, of which theirs is a multiple.
    let one = (choices.visibility > 1).then(|| subject::Choices { visibility: 1, ..choices.clone() });
    let graph = |subject: subject::Subject, choices: &subject::Choices| {
        Ok(Graph { label: subject.label(choices), declaration: subject.declare(size, choices)?, tuning: subject.tuning() })
    };
    let subjects = options.subjects();
    subjects.iter().flat_map(|subject| one.iter().chain([&choices]).map(|choices| graph(*subject, choices))).collect()
}

/// The time that the visibility of several lights takes, in times of one: pairs of graphs stand side by side.
fn print_lights(cases: &[report::Case]) {
    let time = |case: &report::Case| {
        let of_lights = case.passes.iter().filter(|pass| pass.stage.starts_with("visibility") || pass.stage == "shadowed_light");
        of_lights.map(|pass| pass.time.median).sum::<f64>()
    };
    for pair in cases.chunks_exact(2) {
        let [one, several] = [&pair[0], &pair[1]].map(time);
        println!("{}: {several:.3} ms for its lights, {:.2} times those of one", pair[1].graph, several / one);
    }
}

fn print_floor(floor: &report::Floor, clock: Clock) {
    let copy = floor.copy_gb_per_s.map_or("too short to measure".to_owned(), |gb_per_s| format!("{gb_per_s:.2} GB/s"));
    print!("copy: {copy}; {} multiply-adds a pixel: {:.4} ms", yardsticks::MULTIPLY_ADDS, floor.arithmetic_ms);
    if clock == Clock::ProcessCpuTime {
        let empty = floor.empty_submission_ms;
        print!("; a submission without work: {:.4} ms (95 %: {:.4}), taken off every pass", empty.median, empty.p95);
    }
    println!("\n");
}
