//! Captures: the inputs of some frames as an EXR sequence, which the tool `atrous-denoise` filters again, on a GPU or on the CPU
//! twin.
//!
//! A wrong picture in your engine becomes a folder that you can inspect, replay, bisect and attach
//! to a report.
//!
//! - **With the built-in executor** it is one call: `Executor::capture(folder, frames)` (features `capture` and `executor`), and
//!   `Executor::finish_capture` to have the last frames, and any error, at once. `Session::capture` does the same.
//! - **With a frame graph of your own**: create a [`SequenceWriter`], and call
//!   [`SequenceWriter::write_frame`] once per frame with the texels of your inputs, copied to the
//!   CPU:
//!   1. Copy every input image that you bind, by the names of [`crate::Declaration::resources`]: for each with [`Lifetime::Input`],
//!      after the last pass that uses it ([`crate::Declaration::life`]), with `vkCmdCopyImageToBuffer`. Only the top left
//!      [`FrameParams::render_extent`]; of a depth-stencil image the depth aspect; rows tightly packed (`bufferRowLength` 0). The
//!      image needs `TRANSFER_SRC` usage.
//!   2. When the frame's fence has signalled, call [`SequenceWriter::write_frame`] with the [`FrameParams`] and [`Tuning`] of that
//!      frame, and the index that it counted as. Where the denoiser forced a reset, set [`FrameParams::reset`] ([`crate::FrameContext::reset`] has it).
//!
//! You can also replay a preset with forward-projected gradients: the noisy radiance contains the
//! re-shaded samples, and their pixels are the same in the replay, since every frame keeps its
//! number.
//!
//! The folder gets `frame_0000.exr`, ... and `sequence.json` with matrices, jitter, resets,
//! tunables and the [`crate::Config`] of a preset, so texels are stored unchanged: depth, normals
//! and motion in your encoding, half as half, 32-bit float and ids bit by bit. Normalised formats
//! become 32-bit float. `docs/specification/exr.md` lists the channels. A replay starts without
//! history. To compare with the engine from the first frame on, call `invalidate` before the first
//! captured frame.
//!
//! The render extent, that of the output and the set of images must hold for the whole capture; tunables and
//! `instance_transforms` may change.

mod channels;
mod exr_file;
mod sequence_json;

use crate::contract::texel::Texel;
use crate::contract::{Declaration, FrameParams, Lifetime, Shape, TexelGrid, Tuning};
use crate::error::Error;
use crate::reference::InstanceTransform;
use ash::vk;
use atrous_files::Existing;
use channels::Layer;
use sequence_json::Head;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Texels of one input image of a frame.
#[derive(Clone, Copy, Debug)]
pub struct InputImage<'a> {
    /// Name of the resource: `depth`, `normal`, `noisy_radiance`, ...
    pub name: &'a str,
    /// Format of the texels.
    pub format: vk::Format,
    /// The render extent, row by row, tightly packed; of an image with one texel per stratum, or per pixel of light, those of the
    /// render extent.
    pub texels: &'a [u8],
}

/// One frame as the denoiser got it.
#[derive(Clone, Copy, Debug)]
pub struct InputFrame<'a> {
    /// The number that the frame counted as: [`crate::FrameContext::index`]. Which pixels are re-shaded depends on it.
    pub index: u64,
    /// The parameters that `begin_frame` got.
    pub params: &'a FrameParams,
    /// The tunables that `begin_frame` got.
    pub tuning: &'a Tuning,
    /// Every input image that was bound.
    pub images: &'a [InputImage<'a>],
    /// The buffer `instance_transforms`, where it was bound.
    pub instance_transforms: Option<&'a [InstanceTransform]>,
}

/// Ending of the name of the file with the transforms of a frame, behind its number. The file has twelve 32-bit floats an instance,
/// little-endian.
const TRANSFORMS_ENDING: &str = "_instance_transforms.f32";

/// The facts that hold for a sequence, known with its first frame.
struct First {
    extent: [u32; 2],
    /// Of the picture that is shown, where it has one of its own.
    output: Option<[u32; 2]>,
    images: Vec<String>,
    tuning: Tuning,
}

/// Writes a sequence frame by frame. After each, the folder holds a sequence that can be replayed.
pub struct SequenceWriter {
    folder: PathBuf,
    declaration: Declaration,
    first: Option<First>,
    frames: BTreeMap<u64, String>,
}

impl SequenceWriter {
    /// Makes the folder where there is none, and proves that files can be made in it.
    ///
    /// # Errors
    /// [`Error::Capture`] for a folder that cannot be written or that holds a sequence already.
    pub fn new(folder: impl AsRef<Path>, declaration: &Declaration) -> Result<Self, Error> {
        let folder = folder.as_ref().to_owned();
        exr_file::prepare(&folder)?;
        Ok(Self { folder, declaration: declaration.clone(), first: None, frames: BTreeMap::new() })
    }

    /// The folder of the sequence.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Frames that were written.
    #[cfg(feature = "executor")]
    pub(crate) fn frames_written(&self) -> u32 {
        self.frames.len() as u32
    }

    /// Writes the next frame, and `sequence.json` anew. A refused frame leaves nothing behind.
    ///
    /// # Errors
    /// Errors of [`crate::FrameState::begin`] for parameters and tunables;
    /// [`Error::UnknownResource`], [`Error::NotBound`] for a required image that is missing,
    /// [`Error::Format`], [`Error::Size`]; [`Error::Capture`] for a file that cannot be written,
    /// and for a frame whose render extent or images differ from the first.
    pub fn write_frame(&mut self, frame: &InputFrame<'_>) -> Result<(), Error> {
        let number = self.frames.last_key_value().map_or(0, |(last, _)| last + 1);
        self.write_numbered(number, frame)
    }

    pub(crate) fn write_numbered(&mut self, number: u64, frame: &InputFrame<'_>) -> Result<(), Error> {
        let &InputFrame { index, params, tuning, images, instance_transforms } = frame;
        params.validate(self.declaration.setup())?;
        tuning.validate()?;
        let names = self.check_names(images)?;
        self.check_like_first(number, params, &names)?;
        let named = |name: &String| images.iter().find(|i| i.name == *name).map(|image| (name.clone(), image));
        let layers = names.iter().filter_map(named).map(|(name, image)| self.layer(&name, image, params.render_extent));
        let mut layers = layers.collect::<Result<Vec<_>, _>>()?;
        channels::add_total(&mut layers);
        let file = |ending: &str| self.folder.join(format!("frame_{number:04}{ending}"));
        if let Some(transforms) = instance_transforms {
            // Little-endian, as every device of Vulkan has it.
            let bytes: Vec<u8> = transforms.iter().flatten().flatten().flat_map(|v| v.to_le_bytes()).collect();
            exr_file::write_whole(&file(TRANSFORMS_ENDING), Existing::Kept, &bytes)?;
        }
        exr_file::write(&file(".exr"), params.render_extent, layers)?;
        let setup = self.declaration.setup();
        let (light, output) = (setup.light_of(params.render_extent), params.output_extent.or(setup.output_extent));
        let light = (setup.light_ratio() != [1; 2]).then_some(light);
        let extents = [("light_extent", light), ("output_extent", output)];
        let first = self.first.get_or_insert(First { extent: params.render_extent, output, images: names, tuning: *tuning });
        let text =
            |error: serde_json::Error| Error::Capture { path: file(".exr"), problem: format!("cannot be described: {error}") };
        let head = Head::new(self.declaration.config(), extents, &self.declaration.setup().conventions, &first.tuning);
        let head = head.map_err(text)?;
        let entry = sequence_json::frame([number, index], params, tuning, &first.tuning).map_err(text)?;
        self.frames.insert(number, entry);
        let text = head.with_frames(self.frames.values());
        exr_file::write_whole(&self.folder.join("sequence.json"), Existing::Replaced, text.as_bytes())
    }

    /// The names as the declaration has them, in its order.
    fn check_names(&self, images: &[InputImage<'_>]) -> Result<Vec<String>, Error> {
        let inputs = || {
            self.declaration.resources().iter().filter_map(|r| match (r.lifetime, r.shape) {
                (Lifetime::Input { optional }, Shape::Image { .. }) => Some((r.name.as_str(), optional)),
                _ => None,
            })
        };
        if let Some(unknown) = images.iter().find(|i| !inputs().any(|r| r.0 == i.name)) {
            let known = inputs().map(|r| r.0).collect::<Vec<_>>().join(", ");
            return Err(Error::UnknownResource { given: unknown.name.to_owned(), known });
        }
        let given = |name: &str| images.iter().any(|i| i.name == name);
        if let Some((missing, _)) = inputs().find(|(name, optional)| !optional && !given(name)) {
            return Err(Error::NotBound(missing.to_owned()));
        }
        Ok(inputs().map(|r| r.0.to_owned()).filter(|name| given(name)).collect())
    }

    fn check_like_first(&self, number: u64, params: &FrameParams, names: &[String]) -> Result<(), Error> {
        let Some(first) = &self.first else { return Ok(()) };
        let given = params.render_extent;
        if given != first.extent {
            let problem = format!(
                "frame {number} has a render extent of {given:?}, the first had {:?}; a sequence has one: hold the resolution while capturing",
                first.extent
            );
            return Err(self.error(problem));
        }
        let output = params.output_extent.or(self.declaration.setup().output_extent);
        if output != first.output {
            let problem = format!(
                "frame {number} has an output of {output:?} pixels, the first had {:?}; a sequence has one: hold the size while capturing",
                first.output
            );
            return Err(self.error(problem));
        }
        if names != first.images {
            let problem = format!(
                "frame {number} has the images {}, the first had {}; bind the same inputs in every captured frame",
                names.join(", "),
                first.images.join(", ")
            );
            return Err(self.error(problem));
        }
        Ok(())
    }

    fn layer(&self, name: &str, image: &InputImage<'_>, extent: [u32; 2]) -> Result<Layer, Error> {
        let rule = self.declaration.find(name).map(|id| self.declaration.resource(id).shape);
        let (Some(texel), Some(Shape::Image { format, texels })) = (Texel::of(image.format), rule) else {
            return Err(refused_format(name, image.format));
        };
        if !format.accepts(image.format) {
            return Err(refused_format(name, image.format));
        }
        let bytes = texel.bytes();
        let [width, height] = texels.extent(self.declaration.setup(), extent);
        let needed = width as usize * height as usize * bytes;
        if image.texels.len() != needed {
            let needed = format!("{needed} ({width}x{height} texels of {bytes} bytes)");
            return Err(Error::Size { resource: name.to_owned(), given: format!("{} bytes", image.texels.len()), needed });
        }
        // All channels of a file have one size: what has a texel per stratum stands in the top left corner, and a pixel of light in
        // each rendered pixel of its cell.
        let ratio = match texels {
            TexelGrid::Light(1) => self.declaration.setup().light_ratio(),
            _ => [1; 2],
        };
        let texels = in_cells(image.texels, [width, height], bytes, extent, ratio);
        let planes = texel.planes(&texels);
        let coloured = self.declaration.find("visibility_history_colours").is_some();
        let conventions = &self.declaration.setup().conventions;
        Ok(Layer::of_input(name, conventions, coloured, planes, extent[0] as usize * extent[1] as usize))
    }

    pub(crate) fn error(&self, problem: String) -> Error {
        Error::Capture { path: self.folder.clone(), problem }
    }
}

/// Texels of an image of a size in the top left of a larger one, each as often as its cell is wide and high.
fn in_cells(texels: &[u8], [width, height]: [u32; 2], bytes: usize, extent: [u32; 2], ratio: [u32; 2]) -> Vec<u8> {
    let mut all = vec![0; extent[0] as usize * extent[1] as usize * bytes];
    for (y, row) in all.chunks_exact_mut(extent[0] as usize * bytes).enumerate() {
        for (x, to) in row.chunks_exact_mut(bytes).enumerate() {
            let from = [x as u32 / ratio[0], y as u32 / ratio[1]];
            if from[0] < width && from[1] < height {
                let at = (from[1] as usize * width as usize + from[0] as usize) * bytes;
                to.copy_from_slice(&texels[at..at + bytes]);
            }
        }
    }
    all
}

fn refused_format(name: &str, given: vk::Format) -> Error {
    Error::Format { resource: name.to_owned(), given, allowed: format!("for a capture {}", crate::contract::texel::ACCEPTED) }
}

#[cfg(test)]
mod tests;
