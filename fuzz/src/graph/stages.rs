//! Stages of a host: they can be given any image, read it before it is written, write it again, and go in a circle.

use atrous::graph::Stage;
use atrous::reference::{Bindings, Image};
use atrous::Error;
use atrous_glsl::{Compiler, Detail, Glsl};
use std::path::Path;
use std::sync::LazyLock;

/// Copies the image `from` to `to`.
pub static COPY: LazyLock<Stage> = LazyLock::new(|| stage("copy").with_twin(copy));
/// Puts the mean of `from` and `to` into `to`.
pub static MIX: LazyLock<Stage> = LazyLock::new(|| stage("mix").with_twin(mix));

fn stage(name: &str) -> Stage {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/graph").join(name).with_extension("comp");
    let glsl = Glsl::read(&file, &[]).expect("a shader");
    let compiler = Compiler::new().expect("a compiler");
    let spirv = glsl.compile(&compiler, &glsl.variants()[0], Detail::Everything).expect("it compiles");
    Stage::new(name, &spirv).expect("a stage")
}

fn copy(b: &mut Bindings) -> Result<(), Error> {
    let (from, extent) = (floats(b, "from")?, b.extent_of("to")?);
    b.write("to", Image::from_texels(extent, texels(&from, extent))?)
}

fn mix(b: &mut Bindings) -> Result<(), Error> {
    let (from, to) = (floats(b, "from")?, floats(b, "to")?);
    let extent = to.extent();
    let mean = |(a, b): ([f32; 4], [f32; 4])| std::array::from_fn(|c| 0.5 * (a[c] + b[c]));
    let mixed = texels(&from, extent).into_iter().zip(texels(&to, extent)).map(mean).collect();
    b.write("to", Image::from_texels(extent, mixed)?)
}

/// An image of one float or of four.
fn floats(b: &Bindings, name: &str) -> Result<Image<[f32; 4]>, Error> {
    b.scalar(name).map(|image| image.map(|v| [*v, 0.0, 0.0, 1.0])).or_else(|_| b.colour(name).cloned())
}

/// An image in another extent, with its edges repeated.
fn texels(image: &Image<[f32; 4]>, [width, height]: [u32; 2]) -> Vec<[f32; 4]> {
    let last = image.extent().map(|side| side as i32 - 1);
    let places = (0..height as i32).flat_map(|y| (0..width as i32).map(move |x| (x, y)));
    places.map(|(x, y)| image.get(x.min(last[0]), y.min(last[1])).copied().unwrap_or_default()).collect()
}
