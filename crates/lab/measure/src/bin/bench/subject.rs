//! The graphs that can be measured, by name: every preset, and those of `graphs`.

use super::graphs::{OwnGraph, GRAPHS};
use atrous::config::{PostProcess, Preset, Signals};
use atrous::{Config, Declaration, Error, Tuning};
use atrous_options::ConfigArgs;
use std::str::FromStr;

/// A preset, or a graph of one's own.
#[derive(Clone, Copy)]
pub enum Subject {
    Preset(Preset),
    Own(&'static OwnGraph),
}

/// Size of the noisy images.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Light {
    /// That of the guides.
    #[default]
    Full,
    /// Half of the columns and of the rows of the guides.
    Half,
}

/// The settings of presets; a graph of one's own has its own.
#[derive(Clone)]
pub struct Choices {
    pub config: ConfigArgs,
    /// Reflections apart from diffuse light.
    pub reflections: bool,
    /// Lights whose shadows are apart.
    pub visibility: u32,
    /// Fog apart.
    pub volume: bool,
    /// Sides of the output over those of what is rendered.
    pub output: Option<f64>,
    pub light: Light,
    pub post_process: PostProcess,
}

impl Subject {
    /// Every preset.
    pub fn presets() -> impl Iterator<Item = Self> {
        Preset::ALL.into_iter().map(Self::Preset)
    }

    /// The name, with the settings that are not the defaults.
    pub fn label(self, choices: &Choices) -> String {
        let preset = match self {
            Self::Preset(preset) => preset,
            Self::Own(graph) => return graph.name.to_owned(),
        };
        let mut label = preset.name().to_owned();
        for (field, value) in choices.config.iter() {
            label += &format!(" {field}={value}");
        }
        let parts = [
            (choices.reflections, " + reflections"),
            (choices.visibility == 1, " + visibility"),
            (choices.visibility > 1, &*format!(" + visibility of {} lights", choices.visibility)),
            (choices.volume, " + volume"),
            (choices.light == Light::Half, " + half the light"),
            (choices.post_process != PostProcess::None, " + post-process"),
        ];
        parts.into_iter().filter(|part| part.0).for_each(|part| label += part.1);
        if let Some(ratio) = choices.output {
            label += &format!(" + output x{ratio}");
        }
        label
    }

    pub fn declare(self, size: [u32; 2], choices: &Choices) -> Result<Declaration, Error> {
        match self {
            Self::Preset(preset) => {
                let Choices { visibility, volume, post_process, .. } = *choices;
                let signals = if choices.reflections { Signals::Specular } else { Signals::default() };
                let mut config = Config { preset, signals, visibility, volume, post_process, ..Config::new(size) };
                config.output_extent = choices.output.map(|ratio| size.map(|side| (ratio * f64::from(side)).round() as u32));
                config.light_extent = (choices.light == Light::Half).then(|| size.map(|side| side / 2));
                choices.config.apply(&mut config)?;
                config.declare()
            }
            Self::Own(graph) => (graph.declare)(size),
        }
    }

    pub fn tuning(self) -> Tuning {
        match self {
            Self::Preset(preset) => Tuning::for_preset(preset),
            // They are made of nodes as SVGF has them.
            Self::Own(_) => Tuning::for_preset(Preset::Svgf),
        }
    }
}

impl FromStr for Subject {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        let own = GRAPHS.iter().find(|graph| graph.name == name).map(Self::Own);
        let preset = name.parse().ok().map(Self::Preset);
        own.or(preset).ok_or_else(|| {
            let names = Preset::ALL.iter().map(|preset| preset.name()).chain(GRAPHS.iter().map(|graph| graph.name));
            format!("\"{name}\" is no preset and no graph; there are: {}", names.collect::<Vec<_>>().join(", "))
        })
    }
}
