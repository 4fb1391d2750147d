//! Filters of frames: the GPU, or the CPU engine. Frames come in order, since both keep a history.

use crate::error::{Result, ToolError};
use crate::frame::FrameInputs;
use atrous::ash::vk;
use atrous::executor::{HeadlessDevice, HeadlessOptions, Session, SessionOptions};
use atrous::reference::Engine;
use atrous::{
    Config, DebugView, Declaration, Error, Finding, FrameParams, ImageFormat, Input, Lifetime, ResourceDecl, Shape, Statistics,
    StatisticsWatch, Tuning,
};
use atrous_lab::pictures::Picture;
use std::borrow::Cow;
use std::sync::Arc;

/// Result of a frame.
#[derive(Clone, Debug, Default)]
pub struct FrameOutputs {
    /// Denoised radiance, with albedo and emission.
    pub radiance: Vec<[f32; 3]>,
    /// Channels of results that are no part of the radiance: visibility of lights, ambient occlusion.
    pub further: Vec<(String, Vec<f32>)>,
    /// Debug views of the preset, where they were asked for.
    pub views: Vec<(DebugView, Picture)>,
    /// What the counters of frames in a row tell, once in a run: nearly every surface loses its history, or noise repeats.
    pub finding: Option<Finding>,
}

/// Filters frames in order.
pub trait Backend {
    /// The device that it runs on.
    fn name(&self) -> String;
    /// Filters the next frame. Views need [`Config::debug_view`].
    fn denoise(&mut self, frame: &FrameInputs, views: bool) -> Result<FrameOutputs>;
}

/// The result of a call of the library.
type Outcome<T> = std::result::Result<T, Error>;

/// Runs a declaration from slices to slices: the methods that a session on a GPU and the CPU engine have in common.
trait Runner {
    fn declaration(&self) -> &Declaration;
    fn upload(&mut self, name: &str, texels: &[[f32; 4]]) -> Outcome<()>;
    fn upload_ids(&mut self, name: &str, texels: &[u32]) -> Outcome<()>;
    fn upload_buffer(&mut self, name: &str, bytes: &[u8]) -> Outcome<()>;
    fn unbind(&mut self, name: &str) -> Outcome<()>;
    fn restart_at(&mut self, index: u64);
    fn run(&mut self, params: &FrameParams, tuning: &Tuning) -> Outcome<()>;
    fn download(&mut self, name: &str) -> Outcome<Vec<[f32; 4]>>;
    fn statistics(&mut self) -> Outcome<Statistics>;
    fn debug_view(&mut self, view: DebugView) -> Outcome<Vec<[f32; 4]>>;
}

macro_rules! runner {
    ($type:ty, |$runner:ident| $declaration:expr) => {
        impl Runner for $type {
            fn declaration(&self) -> &Declaration {
                let $runner = self;
                $declaration
            }
            fn upload(&mut self, name: &str, texels: &[[f32; 4]]) -> Outcome<()> {
                <$type>::upload(self, name, texels)
            }
            fn upload_ids(&mut self, name: &str, texels: &[u32]) -> Outcome<()> {
                <$type>::upload_ids(self, name, texels)
            }
            fn upload_buffer(&mut self, name: &str, bytes: &[u8]) -> Outcome<()> {
                <$type>::upload_buffer(self, name, bytes)
            }
            fn unbind(&mut self, name: &str) -> Outcome<()> {
                <$type>::unbind(self, name)
            }
            fn restart_at(&mut self, index: u64) {
                <$type>::restart_at(self, index);
            }
            fn run(&mut self, params: &FrameParams, tuning: &Tuning) -> Outcome<()> {
                <$type>::run(self, params, tuning).map(|_| ())
            }
            fn download(&mut self, name: &str) -> Outcome<Vec<[f32; 4]>> {
                <$type>::download(self, name)
            }
            fn statistics(&mut self) -> Outcome<Statistics> {
                <$type>::statistics(self)
            }
            fn debug_view(&mut self, view: DebugView) -> Outcome<Vec<[f32; 4]>> {
                <$type>::debug_view(self, view)
            }
        }
    };
}

runner!(Session, |session| session.executor().denoiser().declaration());
runner!(Engine, |engine| Engine::declaration(engine));

/// The passes of a configuration.
pub struct Passes {
    runner: Box<dyn Runner>,
    name: String,
    /// What the next frame counts as, unless it says otherwise.
    next: Option<u64>,
    watch: StatisticsWatch,
}

const TRANSFORMS: &str = "instance_transforms";
const UPSCALED: &str = "upscaled_radiance";

impl Passes {
    /// The passes on a Vulkan device, by index or part of its name.
    pub fn gpu(device: Option<String>, config: &Config) -> Result<Self> {
        let options = HeadlessOptions { device, ..HeadlessOptions::default() };
        let device = HeadlessDevice::new(&options).map_err(|error| match error {
            Error::NoDevice(_) => ToolError::NoDevice(error),
            other => other.into(),
        })?;
        Self::on(Arc::new(device), config)
    }

    /// The passes on a device that is open.
    pub fn on(gpu: Arc<HeadlessDevice>, config: &Config) -> Result<Self> {
        Self::of(gpu, config.declare()?)
    }

    /// The passes of any graph on a device that is open.
    pub fn of(gpu: Arc<HeadlessDevice>, declaration: Declaration) -> Result<Self> {
        let name = gpu.name().to_owned();
        let session = Session::new(gpu, declaration, SessionOptions::default())?;
        Ok(Self { runner: Box::new(session), name, next: None, watch: StatisticsWatch::default() })
    }

    /// The passes on the CPU: slow, and the measure of what a GPU should give.
    pub fn reference(config: &Config) -> Result<Self> {
        let engine = Engine::new(config.declare()?)?;
        // Views are drawn behind the frame, from what would be freed by then.
        let engine = if config.debug_view { engine.keep_transients() } else { engine };
        Ok(Self { runner: Box::new(engine), name: "the CPU reference".into(), next: None, watch: StatisticsWatch::default() })
    }

    /// Gives the next frame's inputs, as far as the graph has them.
    pub fn upload(&mut self, frame: &FrameInputs) -> Result<()> {
        for (name, shape, optional) in inputs(self.runner.declaration()) {
            let is_image = matches!(shape, Shape::Image { .. });
            let transforms = frame.instance_transforms.as_ref().filter(|_| name == TRANSFORMS);
            let ids = match name.as_str() {
                "surface_id" => frame.surface_id.as_ref(),
                "material_class" => frame.material_class.as_ref(),
                "specular_hit_id" => frame.hit_id.as_ref(),
                name => {
                    let light = Input::OCCLUDER_ID.iter().position(|input| input.name == name);
                    light.and_then(|light| frame.occluder_ids[light].as_ref())
                }
            };
            let ids = ids.map(|ids| traced(self.runner.declaration(), &name, ids, frame.params.light_offset));
            let texels = frame.images.get(name.as_str()).filter(|_| is_image);
            let texels = texels.map(|texels| traced(self.runner.declaration(), &name, texels, frame.params.light_offset));
            match (ids, texels, transforms) {
                (Some(ids), ..) => self.runner.upload_ids(&name, &ids)?,
                (_, Some(texels), _) => self.runner.upload(&name, &texels)?,
                (.., Some(transforms)) => self.runner.upload_buffer(&name, bytemuck::cast_slice(transforms))?,
                // A required one that is absent is named when the frame runs.
                _ if optional => self.runner.unbind(&name)?,
                _ => {}
            }
        }
        Ok(())
    }

    /// Runs the frame that was uploaded, and waits for it.
    pub fn run(&mut self, frame: &FrameInputs) -> Result<()> {
        if self.next != Some(frame.index) {
            self.runner.restart_at(frame.index);
        }
        self.next = Some(frame.index.wrapping_add(1));
        Ok(self.runner.run(&frame.params, &frame.tuning)?)
    }

    /// Denoised radiance of the frame that ran, at the size of the output: surfaces and volume are the picture together.
    pub fn radiance(&mut self, frame: &FrameInputs) -> Result<Vec<[f32; 3]>> {
        if self.runner.declaration().find(UPSCALED).is_some() {
            return Ok(self.runner.download(UPSCALED)?.iter().map(|[r, g, b, _]| [*r, *g, *b]).collect());
        }
        let mut radiance = vec![[0.0; 3]; frame.noisy.len()];
        for name in ["denoised_radiance", "denoised_volume"] {
            if self.runner.declaration().find(name).is_some() {
                add(&mut radiance, &self.runner.download(name)?);
            }
        }
        Ok(radiance)
    }

    /// Results beside the radiance, channel by channel; none where the picture is larger than what was rendered.
    fn further(&mut self) -> Result<Vec<(String, Vec<f32>)>> {
        let declaration = self.runner.declaration();
        if declaration.find(UPSCALED).is_some() {
            return Ok(Vec::new());
        }
        let is_further = |r: &&ResourceDecl| r.lifetime == Lifetime::Output && FURTHER.iter().any(|name| r.name.starts_with(name));
        let channels: Vec<_> =
            declaration.resources().iter().filter(is_further).map(|r| (r.name.clone(), components(r.shape))).collect();
        let mut further = Vec::new();
        for (name, components) in channels {
            let texels = self.runner.download(&name)?;
            further
                .extend(components.iter().enumerate().map(|(i, c)| (format!("{name}.{c}"), texels.iter().map(|t| t[i]).collect())));
        }
        Ok(further)
    }
}

/// Names of outputs beside the radiance begin so.
const FURTHER: [&str; 2] = ["denoised_visibility", "denoised_ambient"];

/// Components of a result, which has a colour or is one number.
fn components(shape: Shape) -> &'static [&'static str] {
    match shape {
        Shape::Image { format: ImageFormat::Exactly(vk::Format::R32_SFLOAT), .. } => &["Z"],
        _ => &["R", "G", "B"],
    }
}

impl Backend for Passes {
    fn name(&self) -> String {
        self.name.clone()
    }

    fn denoise(&mut self, frame: &FrameInputs, views: bool) -> Result<FrameOutputs> {
        self.upload(frame)?;
        self.run(frame)?;
        let radiance = self.radiance(frame)?;
        let finding = self.watch.look(&self.runner.statistics()?);
        let mut outputs = FrameOutputs { radiance, further: self.further()?, views: Vec::new(), finding };
        if views {
            let extent = view_extent(self.runner.declaration());
            for view in self.runner.declaration().debug_views() {
                outputs.views.push((view, view_picture(extent, &self.runner.debug_view(view)?)?));
            }
        }
        Ok(outputs)
    }
}

/// Texels of an input: of light that has fewer pixels, those that were traced.
fn traced<'a, T: Copy>(declaration: &Declaration, name: &str, texels: &'a [T], offset: [u32; 2]) -> Cow<'a, [T]> {
    let [width, height] = declaration.allocated_extent();
    let extent = declaration.find(name).and_then(|id| declaration.resource(id).extent(declaration.setup()));
    let Some([columns, rows]) = extent.filter(|_| texels.len() == width as usize * height as usize) else { return texels.into() };
    if [columns, rows] == [width, height] || columns * 2 < width || rows * 2 < height {
        return texels.into();
    }
    // An offset beyond a cell is refused when the frame runs.
    let ratio = [width / columns, height / rows];
    let at = |x: u32, y: u32| (y * ratio[1] + offset[1] % ratio[1]) * width + x * ratio[0] + offset[0] % ratio[0];
    let picked = (0..rows).flat_map(|y| (0..columns).map(move |x| at(x, y)));
    picked.filter_map(|pixel| texels.get(pixel as usize).copied()).collect()
}

/// Name, shape and whether it is optional, of every input.
fn inputs(declaration: &Declaration) -> Vec<(String, Shape, bool)> {
    let input = |r: &ResourceDecl| match r.lifetime {
        Lifetime::Input { optional } => Some((r.name.clone(), r.shape, optional)),
        _ => None,
    };
    declaration.resources().iter().filter_map(input).collect()
}

/// Adds a part of the picture.
fn add(radiance: &mut [[f32; 3]], part: &[[f32; 4]]) {
    for (sum, texel) in radiance.iter_mut().zip(part) {
        *sum = std::array::from_fn(|c| sum[c] + texel[c]);
    }
}

/// Pixels of a view: those that have light.
fn view_extent(declaration: &Declaration) -> [u32; 2] {
    let view = declaration.find("debug_view").and_then(|id| declaration.resource(id).extent(declaration.setup()));
    view.unwrap_or(declaration.allocated_extent())
}

/// A view as a picture: the alpha channel holds the numbers behind the colours.
fn view_picture([width, height]: [u32; 2], texels: &[[f32; 4]]) -> Result<Picture> {
    let colours: Vec<_> = texels.iter().map(|&[r, g, b, _]| [r, g, b]).collect();
    Picture::from_display(width, height, &colours).map_err(|e| ToolError::Usage(e.to_string()))
}
