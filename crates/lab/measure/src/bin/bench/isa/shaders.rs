//! The shaders that graphs run, each with every set of specialisation constants once.

use crate::options::Options;
use atrous::config::{AdaptiveRule, GradientSource, PostProcess, Preset, Sampling, Signals};
use atrous::{Config, Declaration, Error, PipelineDecl};
use std::collections::BTreeMap;

/// Extent of the declarations; no shader depends on it.
const SIZE: [u32; 2] = [64, 64];

/// The declarations whose shaders are shown: of the graphs that were asked for, or of all presets and the choices that change their
/// shaders.
pub fn declarations(options: &Options) -> Result<Vec<Declaration>, Error> {
    if !options.preset.is_empty() {
        let choices = options.choices();
        return options.preset.iter().map(|subject| subject.declare(SIZE, &choices)).collect();
    }
    configurations().iter().map(Config::declare).collect()
}

fn configurations() -> Vec<Config> {
    let base = Config { preset: Preset::Svgf, post_process: PostProcess::ToneMapTaa, ..Config::new(SIZE) };
    let mut all = Vec::new();
    for preset in Preset::ALL {
        all.extend(Signals::ALL.map(|signals| Config { preset, signals, ..base }));
    }
    all.extend(AdaptiveRule::ALL.map(|adaptive_rule| Config { preset: Preset::Percentile, adaptive_rule, ..base }));
    all.extend(GradientSource::ALL.map(|gradient_source| Config { preset: Preset::Asvgf, gradient_source, ..base }));
    all.extend([Signals::Together, Signals::Specular].map(|signals| {
        let gradient_source = GradientSource::ChangeTest;
        Config { preset: Preset::Best, signals, gradient_source, ..base }
    }));
    all.extend(Sampling::ALL.map(|sampling| Config { preset: Preset::Eaw, sampling, ..base }));
    all.extend(Signals::ALL.map(|signals| Config { sampling: Sampling::OneOf2x2, signals, ..base }));
    all.push(Config { debug_view: true, object_normal: true, surface_id: false, ..base });
    all
}

/// The constant that the library sets alike for every pass.
const SET_FOR_ALL: &str = "CONVENTIONS";

/// Every pipeline of the declarations by its name: the module, and the constants that a node sets.
pub fn pipelines(declarations: &[Declaration]) -> BTreeMap<String, PipelineDecl<'_>> {
    let passes = declarations.iter().flat_map(Declaration::passes);
    passes.filter_map(|pass| pass.pipeline()).map(|pipeline| (name(&pipeline), pipeline)).collect()
}

/// As the table names it: the module, and the constants that a node sets.
pub fn name(pipeline: &PipelineDecl<'_>) -> String {
    let mut name = pipeline.module.to_owned();
    for constant in pipeline.constants.iter().filter(|constant| constant.name != SET_FOR_ALL) {
        // A mask of bindings is read by its digits.
        let bits = if constant.name == "WIRED" { format!("{:#x}", constant.bits) } else { constant.bits.to_string() };
        name += &format!(" {}={bits}", constant.name);
    }
    name
}
