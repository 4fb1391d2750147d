//! The configuration of a capture's denoiser, beside the conventions: the key `config` of `sequence.json`.

use atrous::config::{AdaptiveRule, BlockSort, EawWeights, GradientSource, Preset, Sampling};
use atrous::Config;
use serde::Deserialize;

/// Every key may be left out. Signals and guides are seen by the channels.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CapturedConfig {
    /// Filter.
    pub preset: Option<Preset>,
    levels: Option<u32>,
    stratum_size: Option<u32>,
    gradient_source: Option<GradientSource>,
    firefly_filter: Option<bool>,
    adaptive_rule: Option<AdaptiveRule>,
    block_sort: Option<BlockSort>,
    eaw_weights: Option<EawWeights>,
    sampling: Option<Sampling>,
}

impl CapturedConfig {
    /// Changes the fields that the capture has.
    pub fn apply(&self, config: &mut Config) {
        fn set<T: Copy>(field: &mut T, value: Option<T>) {
            *field = value.unwrap_or(*field);
        }
        config.levels = self.levels.or(config.levels);
        set(&mut config.stratum_size, self.stratum_size);
        set(&mut config.gradient_source, self.gradient_source);
        set(&mut config.firefly_filter, self.firefly_filter);
        set(&mut config.adaptive_rule, self.adaptive_rule);
        set(&mut config.block_sort, self.block_sort);
        set(&mut config.sampling, self.sampling);
        set(&mut config.eaw_weights, self.eaw_weights);
    }
}
