//! What a capture says about the configuration of its denoiser, beside the conventions: the key `config` of `sequence.json`.

use atrous::config::{AdaptiveRule, BlockSort, EawWeights, GradientSource, Preset, Sampling};
use atrous::Config;
use serde::{Deserialize, Deserializer};

/// Every key may be left out. Signals and guides are seen by the channels.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CapturedConfig {
    /// Filter.
    #[serde(default, deserialize_with = "preset")]
    pub preset: Option<Preset>,
    levels: Option<u32>,
    stratum_size: Option<u32>,
    #[serde(default, deserialize_with = "gradient_source")]
    gradient_source: Option<GradientSource>,
    firefly_filter: Option<bool>,
    #[serde(default, deserialize_with = "adaptive_rule")]
    adaptive_rule: Option<AdaptiveRule>,
    #[serde(default, deserialize_with = "block_sort")]
    block_sort: Option<BlockSort>,
    eaw_weights: Option<Vec<String>>,
    #[serde(default, deserialize_with = "sampling")]
    sampling: Option<Sampling>,
}

impl CapturedConfig {
    /// Changes what is said.
    pub fn apply(&self, config: &mut Config) {
        fn set<T: Copy>(field: &mut T, value: Option<T>) {
            *field = value.unwrap_or(*field);
        }
        set(&mut config.levels, self.levels);
        set(&mut config.stratum_size, self.stratum_size);
        set(&mut config.gradient_source, self.gradient_source);
        set(&mut config.firefly_filter, self.firefly_filter);
        set(&mut config.adaptive_rule, self.adaptive_rule);
        set(&mut config.block_sort, self.block_sort);
        set(&mut config.sampling, self.sampling);
        if let Some(names) = &self.eaw_weights {
            let has = |name: &str| names.iter().any(|n| n == name);
            config.eaw_weights = EawWeights { radiance: has("radiance"), normal: has("normal"), position: has("position") };
        }
    }
}

fn choice<'de, D: Deserializer<'de>, T: Copy>(from: D, choices: &[(&str, T)]) -> Result<Option<T>, D::Error> {
    let given = String::deserialize(from)?;
    let names = || choices.iter().map(|c| c.0).collect::<Vec<_>>().join(", ");
    let found = choices.iter().find(|c| c.0 == given).map(|c| c.1);
    found.map(Some).ok_or_else(|| serde::de::Error::custom(format!("no choice `{given}`; there are: {}", names())))
}

fn preset<'de, D: Deserializer<'de>>(from: D) -> Result<Option<Preset>, D::Error> {
    let choices = [
        ("svgf", Preset::Svgf),
        ("asvgf", Preset::Asvgf),
        ("stabilize", Preset::Stabilize),
        ("percentile", Preset::Percentile),
        ("eaw", Preset::Eaw),
        ("volume", Preset::Volume),
    ];
    choice(from, &choices)
}

fn gradient_source<'de, D: Deserializer<'de>>(from: D) -> Result<Option<GradientSource>, D::Error> {
    let choices = [
        ("forward_projected", GradientSource::ForwardProjected),
        ("reshaded", GradientSource::Reshaded),
        ("sparse", GradientSource::Sparse),
        ("confidence", GradientSource::Confidence),
    ];
    choice(from, &choices)
}

fn adaptive_rule<'de, D: Deserializer<'de>>(from: D) -> Result<Option<AdaptiveRule>, D::Error> {
    choice(from, &[("change_test", AdaptiveRule::ChangeTest), ("percentiles", AdaptiveRule::Percentiles)])
}

fn block_sort<'de, D: Deserializer<'de>>(from: D) -> Result<Option<BlockSort>, D::Error> {
    choice(from, &[("counting", BlockSort::Counting), ("odd_even", BlockSort::OddEven)])
}

fn sampling<'de, D: Deserializer<'de>>(from: D) -> Result<Option<Sampling>, D::Error> {
    let choices = [("full", Sampling::Full), ("one_of_2x2", Sampling::OneOf2x2), ("one_of_4x4", Sampling::OneOf4x4)];
    choice(from, &choices)
}
