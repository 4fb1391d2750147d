//! The images of a graph: what each holds, how long it lives, and its bytes.

use super::measure;
use super::options::Options;
use super::subject::Subject;
use atrous::{Declaration, Error, Lifetime, ResourceId, Shape};
use std::fmt::Write;

/// Bytes a pixel need no device and hardly depend on the size.
const SIZE: [u32; 2] = [1920, 1080];

/// A table for each graph that was asked for.
pub fn tables(options: &Options) -> Result<String, Error> {
    let size = options.size.first().copied().unwrap_or(SIZE);
    let choices = options.choices();
    options
        .subjects()
        .into_iter()
        .map(|subject: Subject| Ok(table(&subject.label(&choices), &subject.declare(size, &choices)?)))
        .collect()
}

fn table(label: &str, declaration: &Declaration) -> String {
    let memory = declaration.memory();
    let [w, h] = declaration.allocated_extent();
    let per_pixel = |bytes: u64| bytes as f64 / (f64::from(w) * f64::from(h));
    let mut text = format!("### {label} {w}x{h}\n\n| image | format | life | first pass | last pass | bytes a pixel |\n| --- | --- | --- | --- | --- | --- |\n");
    for (index, (resource, bytes)) in declaration.resources().iter().zip(&memory.resources).enumerate() {
        let Shape::Image { format, .. } = resource.shape else { continue };
        if matches!(resource.lifetime, Lifetime::Input { .. }) {
            continue;
        }
        let pass = |index: usize| declaration.passes().get(index).map_or("", |pass| pass.name.as_str());
        let [first, last] = declaration.life(ResourceId(index as u32)).map_or([""; 2], |(first, last)| [first, last].map(pass));
        let (name, format, life) = (&resource.name, format.preferred(), resource.lifetime);
        let _ = writeln!(text, "| {name} | {format:?} | {life:?} | {first} | {last} | {:.2} |", per_pixel(bytes.bytes));
    }
    let [history, transient, unaliased, output] =
        [memory.history, memory.transient, memory.transient_unaliased, memory.output].map(per_pixel);
    let passes = declaration.passes();
    let moved = per_pixel(passes.iter().map(|pass| measure::bytes(declaration, pass)).sum());
    let _ = write!(
        text,
        "\nHistory {history:.2}, transients {transient:.2} ({unaliased:.2} if none shared memory), outputs {output:.2}; "
    );
    let _ = writeln!(text, "{} passes move {moved:.1}.\n", passes.len());
    text
}
