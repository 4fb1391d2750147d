//! Writes denoised frames as the input came: names, metadata, windows, compression.

use crate::error::{Result, ToolError};
use crate::exr_header::{ExrHeader, ELSEWHERE};
use crate::exr_read::{self, Samples};
use crate::layouts::Layout;
use crate::mapping::{split, Mapping};
use crate::panics::caught;
use crate::record::Record;
use crate::roles::Role;
use atrous_files::Existing;
use exr::compression::Compression;
use exr::image::{AnyChannel, AnyChannels, Blocks, Encoding, FlatSamples, Image, Layer};
use exr::meta::attribute::{IntegerBounds, LineOrder, SampleType};
use exr::prelude::{ImageAttributes, LayerAttributes, SmallVec, Text, WritableImage};
use std::io::{Cursor, Write};
use std::path::Path;

/// Names of the channels of the output.
#[derive(Clone, Debug, PartialEq)]
pub struct OutputChannels {
    /// Each set of three gets the colour. Three times one name: its mean.
    pub colours: Vec<[String; 3]>,
    /// Alpha.
    pub alpha: Option<String>,
    /// Half, else float.
    pub half: bool,
    /// A channel of the input's beauty, whose part the result takes the place of.
    pub beauty: Option<String>,
}

/// Makes a file of the result of some bytes.
pub fn publish(path: &Path, existing: Existing, bytes: &[u8]) -> Result<()> {
    atrous_files::publish(path, existing, |file| file.write_all(bytes)).map_err(ToolError::publish(path))
}

/// A frame to be written.
pub struct Content<'a> {
    /// Header of the input, for its metadata.
    pub header: &'a ExrHeader,
    /// Channels.
    pub names: &'a OutputChannels,
    /// Options.
    pub record: &'a Record,
    /// Linear radiance of the whole picture.
    pub radiance: &'a [[f32; 3]],
    /// Alpha of the input.
    pub alpha: Option<&'a [f32]>,
    /// Channels of results beside the radiance, by name.
    pub further: &'a [(String, Vec<f32>)],
    /// The input, where its other channels are kept.
    pub kept: Option<&'a Path>,
}

type Channels = SmallVec<[AnyChannel<FlatSamples>; 4]>;

/// Writes a frame.
pub fn write(path: &Path, existing: Existing, content: &Content<'_>) -> Result<()> {
    let problem = |problem: String| ToolError::Encode { path: path.to_owned(), problem };
    let (header, beauty) = (content.header, content.header.part_of(content.names.beauty.as_deref()));
    let mut shared = header.shared.clone();
    let mut layers: SmallVec<[_; 2]> = SmallVec::new();
    let mut result = result(content, beauty).map_err(problem)?;
    match content.kept {
        None => {
            let mut attributes = header.parts.get(beauty).cloned().unwrap_or_default();
            without_the_rest(&mut shared, &mut attributes);
            attributes.other.extend(content.record.attribute());
            layers.push(layer(header, beauty, attributes, result));
        }
        Some(input) => {
            let planes = exr_read::read(input, |_| true)?;
            for (part, attributes) in header.parts.iter().enumerate() {
                let mut attributes = attributes.clone();
                let mut list = if part == beauty { std::mem::take(&mut result) } else { Channels::new() };
                if part == beauty {
                    attributes.other.extend(content.record.attribute());
                }
                let own = header.channels.iter().filter(|c| c.part == part);
                let others: Vec<_> = own.filter(|c| !list.iter().any(|made| made.name.to_string() == c.own_name)).collect();
                for channel in others {
                    let samples = planes.samples.get(&channel.name).map(|s| kept(s, channel.sample_type, header, part));
                    list.extend(samples.and_then(|s| Some(AnyChannel::new(Text::new_or_none(&channel.own_name)?, s))));
                }
                layers.push(layer(header, part, attributes, list));
            }
        }
    }
    let image = Image::from_layers(shared, layers);
    let mut bytes = Cursor::new(Vec::new());
    let written = caught(|| image.write().non_parallel().to_buffered(&mut bytes)).map_err(problem)?;
    written.map_err(|e| problem(e.to_string()))?;
    publish(path, existing, &bytes.into_inner())
}

/// Takes out what speaks of channels that are not written: cryptomattes without their channels are
/// read as wrong ones, and a second eye as missing.
fn without_the_rest(shared: &mut ImageAttributes, own: &mut LayerAttributes) {
    for attributes in [&mut shared.other, &mut own.other] {
        attributes.retain(|name, _| !name.to_string().starts_with("cryptomatte/"));
    }
    own.multi_view_names = None;
}

fn result(content: &Content<'_>, part: usize) -> std::result::Result<Channels, String> {
    let &Content { header, names, radiance, alpha, further, .. } = content;
    let mut list = Channels::new();
    let mut add = |name: &str, values: &mut dyn Iterator<Item = f32>| {
        let name = Text::new_or_none(name).ok_or_else(|| format!("`{name}` is no name for a channel"))?;
        let values = of_part(values, header, part);
        let samples = match names.half {
            true => FlatSamples::F16(values.into_iter().map(to_half).collect()),
            false => FlatSamples::F32(values),
        };
        list.push(AnyChannel::new(name, samples));
        Ok::<(), String>(())
    };
    for set in &names.colours {
        if set[0] == set[1] {
            add(&set[0], &mut radiance.iter().map(|p| p.iter().sum::<f32>() / 3.0))?;
            continue;
        }
        for (component, name) in set.iter().enumerate() {
            add(name, &mut radiance.iter().map(|p| p[component]))?;
        }
    }
    if let (Some(name), Some(alpha)) = (&names.alpha, alpha) {
        add(name, &mut alpha.iter().copied())?;
    }
    for (name, values) in further {
        add(name, &mut values.iter().copied())?;
    }
    Ok(list)
}

/// Half floats end at 65504; beyond it a bright light would become an infinite one.
fn to_half(v: f32) -> half::f16 {
    half::f16::from_f32(v.clamp(-65504.0, 65504.0))
}

fn kept(samples: &Samples, kind: SampleType, header: &ExrHeader, part: usize) -> FlatSamples {
    match (samples, kind) {
        (Samples::Uint(values), _) => FlatSamples::U32(of_part(&mut values.iter().copied(), header, part)),
        (Samples::Float(values), SampleType::F16) => {
            let values = of_part(&mut values.iter().copied(), header, part);
            FlatSamples::F16(values.into_iter().map(half::f16::from_f32).collect())
        }
        (Samples::Float(values), _) => FlatSamples::F32(of_part(&mut values.iter().copied(), header, part)),
    }
}

/// The pixels of a part's data window, of those of the whole picture.
fn of_part<T: Copy + Default>(picture: &mut dyn Iterator<Item = T>, header: &ExrHeader, part: usize) -> Vec<T> {
    let picture: Vec<T> = picture.collect();
    let window = window(header, part);
    if window == header.window {
        return picture;
    }
    let [width, height] = header.extent.map(i64::from);
    let [x0, y0] = [
        i64::from(window.position.0) - i64::from(header.window.position.0),
        i64::from(window.position.1) - i64::from(header.window.position.1),
    ];
    let at = |x: i64, y: i64| match (0..width).contains(&x) && (0..height).contains(&y) {
        true => picture.get((y * width + x) as usize).copied().unwrap_or_default(),
        false => T::default(),
    };
    let columns = window.size.0 as i64;
    (0..window.size.1 as i64).flat_map(|y| (0..columns).map(move |x| (x, y))).map(|(x, y)| at(x + x0, y + y0)).collect()
}

fn window(header: &ExrHeader, part: usize) -> IntegerBounds {
    header.part_windows.get(part).copied().unwrap_or(header.window)
}

fn layer(header: &ExrHeader, part: usize, mut attributes: LayerAttributes, list: Channels) -> Layer<AnyChannels<FlatSamples>> {
    let window = window(header, part);
    attributes.layer_position = window.position;
    let encoding = Encoding {
        compression: compression(header.compressions.get(part).copied()),
        blocks: Blocks::ScanLines,
        line_order: LineOrder::Increasing,
    };
    Layer::new(window.size, attributes, encoding, AnyChannels::sort(list))
}

/// The compression of the input, unless it loses precision or is one that cannot be written.
fn compression(input: Option<Compression>) -> Compression {
    match input {
        Some(c @ (Compression::Uncompressed | Compression::RLE | Compression::ZIP1 | Compression::ZIP16 | Compression::PIZ)) => c,
        _ => Compression::ZIP16,
    }
}

/// Reads back what [`write()`] wrote.
pub fn read_back(path: &Path, names: &OutputChannels) -> Result<Vec<[f32; 3]>> {
    let Some(set) = names.colours.first() else { return Err(ToolError::exr(path, "it has no colour")) };
    let header = exr_read::read_header(path)?;
    let part = Record::part(&header);
    let missing =
        |own: &String| ToolError::NoChannel { path: path.to_owned(), channel: own.clone(), known: crate::mapping::list(&header) };
    let full = |own: &String| {
        let channel = header.channels.iter().find(|c| c.part == part && c.own_name == *own);
        channel.map(|c| c.name.clone()).ok_or_else(|| missing(own))
    };
    let set = [full(&set[0])?, full(&set[1])?, full(&set[2])?];
    let planes = exr_read::read(path, |c| set.contains(&c.name))?;
    let plane = |name: &String| match planes.samples.get(name) {
        Some(Samples::Float(values)) => Ok(values),
        _ => Err(missing(name)),
    };
    let [r, g, b] = [plane(&set[0])?, plane(&set[1])?, plane(&set[2])?];
    Ok(r.iter().zip(g).zip(b).map(|((r, g), b)| [*r, *g, *b]).collect())
}

/// The names of the input's beauty, in its part; `R`, `G`, `B` where it has none, and besides where the
/// layout is this project's own, whose tools read these.
pub fn output_channels(mapping: &Mapping, header: &ExrHeader, half: bool) -> OutputChannels {
    let plain = ["R", "G", "B"].map(str::to_owned);
    let own = |name: &String| {
        let channel = header.channels.iter().find(|c| c.name == *name);
        finished(channel.map_or(name, |c| &c.own_name))
    };
    let mut colours = Vec::new();
    let beauty = mapping.roles.get(&Role::Noisy).map(Vec::as_slice);
    if let Some([r, g, b]) = beauty {
        colours.push([own(r), own(g), own(b)]);
    }
    if colours.is_empty() || (mapping.layout == Layout::Atrous && colours[0] != plain) {
        colours.push(plain);
    }
    let is_here = |name: &&String| header.channels.iter().any(|c| c.name == **name && c.part != ELSEWHERE);
    let alpha = mapping.roles.get(&Role::Alpha).and_then(|a| a.first()).filter(is_here).map(own);
    let beauty = beauty.and_then(|names| names.first()).cloned();
    OutputChannels { colours, alpha, half, beauty }
}

/// Where a compositor looks for the result: Blender renders into `Noisy Image`, and denoises into `Combined`.
fn finished(name: &str) -> String {
    let (layer, component) = split(name);
    let (view, last) = layer.rsplit_once('.').map_or(("", layer), |(view, last)| (view, last));
    match last.eq_ignore_ascii_case("noisy image") {
        true if view.is_empty() => format!("Combined.{component}"),
        true => format!("{view}.Combined.{component}"),
        false => name.to_owned(),
    }
}

/// Makes the folder for the output and proves that files can be made in it, before minutes are spent on frames.
pub fn prepare_folder(folder: &Path) -> Result<()> {
    std::fs::create_dir_all(folder).map_err(ToolError::write(folder))?;
    atrous_files::check_writable(folder).map_err(ToolError::write(folder))
}
