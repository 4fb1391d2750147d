//! The command line.

use std::path::PathBuf;

use atrous::config::{PostProcess, Preset};
use atrous::{Choice, Tuning};
use atrous_engine::{DenoiserOptions, GlassShown, Noise, Reflections, SampleEye, SceneOptions, TracerOptions, FILTERS};
use atrous_measure::evaluate::EvaluateOptions;
use atrous_options::{size, tunable, ConfigArgs};
use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Parser, Subcommand};

use crate::error::{Error, Result};

/// Renders animated scenes with one path per pixel, denoises them, and writes pictures and tables.
///
/// Without options: 24 frames of `cornell` and `pillars` at 320x180, with references of the last two frames.
#[derive(Parser)]
#[command(version, args_conflicts_with_subcommands = true)]
pub struct Options {
    /// Another thing to do
    #[command(subcommand)]
    pub command: Option<Command>,
    /// Scenes: cornell, pillars, glossy, mirror, mirror_moving, hall, hall_railings, hall_sun, fog, leaves, lamps, tiles, door, chapel, vitrine, or a glTF 2.0 file (.glb, .gltf); may be given several times. Default: cornell and pillars
    #[arg(long = "scene")]
    pub scenes: Vec<String>,
    /// Width and height in pixels; default: 320x180, in a window on a device that is not software 1280x720
    #[arg(long, value_parser = size)]
    pub size: Option<[u32; 2]>,
    /// Jitter the primary rays, and show pictures of this size, 1 to 3 times the other one, such as 640x360: in the window, or in OUT/SCENE/display_FILTER
    #[arg(long, value_parser = size)]
    pub output_size: Option<[u32; 2]>,
    /// Frames of the animation
    #[arg(long, default_value_t = 24, value_parser = clap::value_parser!(u32).range(1..))]
    pub frames: u32,
    /// Filter; default: best, in a window asvgf
    #[arg(long, value_parser = choice(&FILTERS))]
    pub preset: Option<Preset>,
    /// Every filter on the same frames: one strip and one table. A-SVGF has lighting of its own, since it has some samples shaded again
    #[arg(long, conflicts_with = "preset")]
    pub compare: bool,
    #[command(flatten)]
    pub config: ConfigArgs,
    /// A number of the filter, for example alpha=0.1; may be given several times. Unknown names list the known ones
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = tunable)]
    pub numbers: Vec<(String, f32)>,
    /// Folder for pictures and tables
    #[arg(long, default_value = "out")]
    pub out: PathBuf,
    /// Frames to render a reference of, separated by commas; the default is the last two
    #[arg(long, value_delimiter = ',')]
    pub reference_frames: Option<Vec<u32>>,
    /// Paths per pixel of a reference; 0: no references
    #[arg(long, default_value_t = 1024)]
    pub reference_spp: u32,
    /// Write what each filter is given as an EXR sequence, with the references: OUT/SCENE/capture_FILTER, for `atrous-denoise` (feature `capture`)
    #[arg(long)]
    pub capture: bool,
    /// Index or a part of the name of the device
    #[arg(long)]
    pub device: Option<String>,
    /// Print the devices and stop
    #[arg(long)]
    pub list_devices: bool,
    /// Run under the Khronos validation layer; its messages are errors
    #[arg(long)]
    pub validate: bool,
    /// Fog moves as the surfaces behind it, instead of having motion of its own: to compare
    #[arg(long)]
    pub surface_motion: bool,
    /// One shadow ray to each of the first four lamps apart from the path: their visibility is filtered by itself (scenes with a sun or lamps: hall, leaves, chapel)
    #[arg(long)]
    pub visibility: bool,
    /// One ray a pixel for ambient occlusion, which is filtered by itself and is no part of the picture
    #[arg(long)]
    pub ambient: bool,
    /// Light of half of the columns and rows, beside guides of every pixel
    #[arg(long)]
    pub half_light: bool,
    /// How reflections follow what moves in them, with specular light apart
    #[arg(long, value_enum, default_value_t)]
    pub reflections: Reflections,
    /// What guides and signals have where glass is seen
    #[arg(long, value_enum, default_value_t)]
    pub glass: GlassShown,
    /// Lights keep their intensity
    #[arg(long)]
    pub static_light: bool,
    /// The camera stands still
    #[arg(long)]
    pub static_camera: bool,
    /// Objects stand still
    #[arg(long)]
    pub static_objects: bool,
    /// Jitter the primary rays, and resolve them by temporal anti-aliasing
    #[arg(long)]
    pub taa: bool,
    /// Open a window, and render until it is closed: split screen, every number of the filters, magnifier. F1 shows the keys
    #[arg(long)]
    pub window: bool,
    /// Width and height of the window in pixels
    #[arg(long, default_value = "1320x760", value_parser = size, requires = "window")]
    pub window_size: [u32; 2],
    /// File that the window's settings are read from, and saved into
    #[arg(long, requires = "window")]
    pub settings: Option<PathBuf>,
    /// File that the window writes what it does into, line by line, for tests
    #[arg(long, requires = "window")]
    pub window_log: Option<PathBuf>,
    /// Folder that every frame of the window is written into as PNG, from the first one on
    #[arg(long, requires = "window")]
    pub record: Option<PathBuf>,
    /// Another seed gives other noise
    #[arg(long, default_value_t = 0)]
    pub seed: u32,
    /// Noise of the path tracer: white, independent from pixel to pixel, or blue, whose errors cancel in a neighbourhood
    #[arg(long, value_enum, default_value_t)]
    pub noise: Noise,
    /// Eye for which samples are shaded again: that of the frame, or the one that saw the sample first; default: current; kept where specular light is apart and there is no fog
    #[arg(long, value_enum)]
    pub sample_eye: Option<SampleEye>,
}

/// Things to do besides rendering and denoising.
#[derive(Subcommand)]
pub enum Command {
    Evaluate(EvaluateOptions),
}

/// One of some values by its name.
fn choice<T: Choice>(values: &'static [T]) -> impl TypedValueParser<Value = T> {
    PossibleValuesParser::new(values.iter().map(|value| value.name())).try_map(|name| name.parse::<T>())
}

impl Options {
    /// The scenes whose pictures go to files.
    pub fn scenes(&self) -> Vec<String> {
        match self.scenes.is_empty() {
            true => ["cornell", "pillars"].map(String::from).to_vec(),
            false => self.scenes.clone(),
        }
    }

    /// What the window is asked for.
    #[cfg(feature = "window")]
    pub fn window(&self) -> atrous_window::WindowOptions {
        atrous_window::WindowOptions {
            device: self.device.clone(),
            validation: self.validate,
            size: self.size,
            output_size: self.output_size,
            half_light: self.half_light,
            window_size: self.window_size,
            settings_file: self.settings.clone(),
            scene: self.scenes.first().cloned(),
            shown: self.preset,
            out: self.out.clone(),
            log: self.window_log.clone(),
            record: self.record.clone(),
        }
    }

    /// Width and height of pictures that go to files.
    pub fn picture_size(&self) -> [u32; 2] {
        self.size.unwrap_or([320, 180])
    }

    /// What clap cannot check.
    pub fn check(&self) -> Result<()> {
        self.denoiser(self.presets()[0])?;
        match self.reference_frames().into_iter().find(|&f| f >= self.frames) {
            Some(given) => Err(Error::ReferenceFrame { given, frames: self.frames }),
            None => Ok(()),
        }
    }

    /// Frames that get a reference.
    pub fn reference_frames(&self) -> Vec<u32> {
        if self.reference_spp == 0 {
            return Vec::new();
        }
        let last_two = (self.frames.saturating_sub(2)..self.frames).collect();
        self.reference_frames.clone().unwrap_or(last_two)
    }

    /// What the scene is asked for.
    pub fn scene(&self) -> SceneOptions {
        SceneOptions { static_light: self.static_light, static_camera: self.static_camera, static_objects: self.static_objects }
    }

    /// What the path tracer is asked for.
    pub fn tracer(&self) -> TracerOptions {
        TracerOptions {
            jitter: self.taa || self.output_size.is_some(),
            seed: self.seed,
            lamps_apart: self.visibility,
            ambient: self.ambient,
            half_light: self.half_light,
            glass: self.glass,
            noise: self.noise,
            ..TracerOptions::default()
        }
    }

    /// The filters that run, in the order of strips and tables.
    pub fn presets(&self) -> Vec<Preset> {
        match self.compare {
            true => FILTERS.to_vec(),
            false => vec![self.preset.unwrap_or_default()],
        }
    }

    /// What the denoiser is asked for.
    pub fn denoiser(&self, preset: Preset) -> atrous_engine::Result<DenoiserOptions> {
        let defaults = DenoiserOptions::new(preset);
        let mut tuning = defaults.tuning;
        self.set(&mut tuning)?;
        let mut config = defaults.config;
        self.config.apply(&mut config)?;
        config.output_extent = self.output_size;
        // A strip of several filters has no room for the views of each, and those of less light have its size.
        config.debug_view = !self.compare && !self.half_light;
        if self.taa {
            config.post_process = PostProcess::ToneMapTaa;
        }
        Ok(DenoiserOptions {
            config,
            reflections: self.reflections,
            volume_motion: !self.surface_motion,
            sample_eye: self.sample_eye,
            tuning,
            ..defaults
        })
    }

    fn set(&self, tuning: &mut Tuning) -> atrous_engine::Result<()> {
        for (name, value) in &self.numbers {
            tuning.set(name, *value)?;
        }
        Ok(())
    }
}
