//! The configuration of a capture's denoiser, beside the conventions: the key `config` of `sequence.json`.

use atrous::config::Preset;
use atrous::Config;
use serde::de::Error;
use serde::{Deserialize, Deserializer};
use serde_json::{Map, Value};

/// Fields of older captures that choose nothing any more: the picture is the same without.
const WITHOUT_EFFECT: [&str; 1] = ["block_sort"];

/// Sizes, and signals, that the files do not tell themselves.
const UNTOLD: [&str; 3] = ["light_extent", "output_extent", "signals"];

/// Fields of the configuration that choose the filter. Every one may be left out. Guides and most signals are seen by the channels.
#[derive(Clone, Debug, Default)]
pub struct CapturedConfig {
    /// Filter.
    pub preset: Option<Preset>,
    others: Map<String, Value>,
}

impl CapturedConfig {
    /// What the first captures were made with: there was no other preset, and they have nothing but its levels, beside the frames.
    pub fn of_the_first(levels: u32) -> Self {
        Self { preset: Some(Preset::Svgf), others: [("levels".to_owned(), levels.into())].into_iter().collect() }
    }

    /// Changes the fields that the capture has, but for the preset.
    pub fn apply(&self, config: &mut Config) {
        // Read once already: it fits.
        *config = changed(config, &self.others).unwrap_or(*config);
    }
}

fn changed(config: &Config, fields: &Map<String, Value>) -> serde_json::Result<Config> {
    let mut all: Map<String, Value> = serde_json::from_value(serde_json::to_value(config)?)?;
    all.extend(fields.clone());
    serde_json::from_value(Value::Object(all))
}

impl<'de> Deserialize<'de> for CapturedConfig {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let mut others = Map::deserialize(deserializer)?;
        others.retain(|name, value| !value.is_null() && !WITHOUT_EFFECT.contains(&name.as_str()));
        let fields = || Config::FIELDS.iter().filter(|field| field.is_of_filter).map(|field| field.name);
        let known = || fields().chain(UNTOLD);
        if let Some(name) = others.keys().find(|name| known().all(|known| known != name.as_str())) {
            let known: Vec<_> = known().map(|name| format!("`{name}`")).collect();
            return Err(D::Error::custom(format!("unknown field `{name}`, expected one of {}", known.join(", "))));
        }
        let config = changed(&Config::new([1, 1]), &others).map_err(D::Error::custom)?;
        let preset = others.remove("preset").map(|_| config.preset);
        Ok(Self { preset, others })
    }
}
