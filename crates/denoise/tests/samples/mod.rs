//! Small EXR files and sequences, made from numbers.

pub mod scene;

use exr::compression::Compression;
use exr::image::{AnyChannel, AnyChannels, Blocks, Encoding, FlatSamples, Image, Layer};
use exr::meta::attribute::{IntegerBounds, LineOrder};
use exr::prelude::{ImageAttributes, LayerAttributes, SmallVec, Text, Vec2, WritableImage};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Type of the samples of a channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Type {
    Half,
    Float,
    Uint,
}

/// A value for every pixel.
pub type Value = Box<dyn Fn(i32, i32) -> f32>;

/// An EXR file to be written.
pub struct Sample {
    pub compression: Compression,
    pub tile: Option<usize>,
    pub display: IntegerBounds,
    /// Data window.
    pub data: IntegerBounds,
    /// Name, type, value at a pixel of the display window's coordinates.
    pub channels: Vec<(String, Type, Value)>,
}

pub fn bounds(x: i32, y: i32, width: usize, height: usize) -> IntegerBounds {
    IntegerBounds::new(Vec2(x, y), Vec2(width, height))
}

impl Sample {
    /// ZIP scan lines.
    pub fn new(width: usize, height: usize) -> Self {
        let window = bounds(0, 0, width, height);
        Self { compression: Compression::ZIP16, tile: None, display: window, data: window, channels: Vec::new() }
    }

    pub fn channel(mut self, name: &str, kind: Type, value: impl Fn(i32, i32) -> f32 + 'static) -> Self {
        self.channels.push((name.into(), kind, Box::new(value)));
        self
    }

    /// Channels with one value each.
    pub fn flat(self, names: &str, kind: Type, value: f32) -> Self {
        names.split_whitespace().fold(self, |sample, name| sample.channel(name, kind, move |_, _| value))
    }

    pub fn layer(&self, name: Option<&str>) -> Layer<AnyChannels<FlatSamples>> {
        let at = self.data.position;
        let pixels =
            || (0..self.data.size.1 as i32).flat_map(move |y| (0..self.data.size.0 as i32).map(move |x| (x + at.0, y + at.1)));
        let mut list: SmallVec<[AnyChannel<FlatSamples>; 4]> = SmallVec::new();
        for (name, kind, value) in &self.channels {
            let values = pixels().map(|(x, y)| value(x, y));
            let samples = match kind {
                Type::Half => FlatSamples::F16(values.map(half::f16::from_f32).collect()),
                Type::Float => FlatSamples::F32(values.collect()),
                Type::Uint => FlatSamples::U32(values.map(|v| v as u32).collect()),
            };
            list.push(AnyChannel::new(Text::new_or_panic(name), samples));
        }
        let mut attributes = LayerAttributes { layer_position: at, ..LayerAttributes::default() };
        attributes.layer_name = name.map(Text::new_or_panic);
        attributes.owner = Some(Text::new_or_panic("the owner"));
        let blocks = self.tile.map_or(Blocks::ScanLines, |side| Blocks::Tiles(Vec2(side, side)));
        let encoding = Encoding { compression: self.compression, blocks, line_order: LineOrder::Increasing };
        Layer::new(self.data.size, attributes, encoding, AnyChannels::sort(list))
    }

    pub fn write(&self, path: &Path) {
        let image = Image::new(ImageAttributes::new(self.display), self.layer(None));
        image.write().non_parallel().to_file(path).expect("a sample file");
    }

    /// Two parts in one file, each with the channels of one sample.
    pub fn write_parts(parts: [(&str, &Self); 2], path: &Path) {
        let attributes = ImageAttributes::new(parts[0].1.display);
        let layers: SmallVec<[_; 2]> = parts.iter().map(|(name, sample)| sample.layer(Some(name))).collect();
        Image::from_layers(attributes, layers).write().non_parallel().to_file(path).expect("a sample file");
    }
}

/// Deterministic noise in 0..1.
pub fn noise(x: i32, y: i32, seed: u32) -> f32 {
    let mut v = (x as u32).wrapping_mul(0x9e37_79b9) ^ (y as u32).wrapping_mul(0x85eb_ca6b) ^ seed.wrapping_mul(0xc2b2_ae35);
    v ^= v >> 16;
    v = v.wrapping_mul(0x7feb_352d);
    v ^= v >> 15;
    (v >> 8) as f32 / (1 << 24) as f32
}

pub const WIDTH: usize = 30;
pub const HEIGHT: usize = 18;

/// A frame in the layout of the project's data sets: a plane at depth 2 with noise around radiance 0.5.
pub fn frame(number: u32) -> Sample {
    let noisy = move |offset: u32| move |x, y| 2.0 * noise(x, y, number * 8 + offset) * 0.25;
    let mut sample = Sample::new(WIDTH, HEIGHT);
    for (i, c) in ["R", "G", "B"].into_iter().enumerate() {
        let (direct, indirect) = (noisy(i as u32), noisy(i as u32 + 3));
        let (d, n) = (direct, indirect);
        sample = sample
            .channel(&format!("noisy.{c}"), Type::Half, move |x, y| d(x, y) + n(x, y))
            .channel(&format!("direct.{c}"), Type::Half, direct)
            .channel(&format!("indirect.{c}"), Type::Half, indirect)
            .flat(&format!("emission.{c}"), Type::Half, 0.0)
            .flat(&format!("albedo.{c}"), Type::Half, 0.5)
            .flat(&format!("ref.{c}"), Type::Half, 0.5);
    }
    sample
        .flat("normal.X normal.Y mv.X mv.Y", Type::Float, 0.0)
        .flat("normal.Z", Type::Half, 1.0)
        .flat("depth.Z prevz.Z", Type::Float, 2.0)
        .flat("id.I", Type::Uint, 1.0)
}

/// A folder with frames 0 to `count` − 1.
pub fn sequence(count: u32) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for number in 0..count {
        frame(number).write(&frame_path(folder.path(), number));
    }
    folder
}

pub fn frame_path(folder: &Path, number: u32) -> PathBuf {
    folder.join(format!("frame_{number:04}.exr"))
}

/// The program itself with these arguments.
pub fn program(input: &Path, output: &Path, more: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_atrous-denoise"));
    command.arg(input).arg("-o").arg(output).args(more).stdout(Stdio::null()).stderr(Stdio::piped());
    command
}

/// The same behind a command of the shell: `ulimit`, ...
pub fn limited(program: &Command, limit: &str) -> Command {
    let mut shell = Command::new("sh");
    shell.arg("-c").arg(format!("{limit}; exec \"$0\" \"$@\"")).arg(program.get_program()).args(program.get_args());
    shell.stdout(Stdio::null()).stderr(Stdio::piped());
    shell
}

/// Runs the tool on the CPU with these arguments.
pub fn denoise(input: &Path, output: &Path, more: &[&str]) -> atrous_denoise::error::Result<()> {
    use clap::Parser;
    let mut arguments = vec!["atrous-denoise", "--quiet", "--device", "reference"];
    let (input, output) = (input.to_str().expect("UTF-8"), output.to_str().expect("UTF-8"));
    arguments.extend([input, "-o", output]);
    arguments.extend(more);
    atrous_denoise::tool::run(&atrous_denoise::cli::Cli::parse_from(arguments))
}
