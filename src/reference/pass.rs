//! A pass of a declaration as its twin sees it: a stage with parameters and names.

use super::table::Stage;
use crate::config::{Config, Preset};
use crate::contract::{PassDecl, Work};
use crate::shaders::Shader;
use crate::DebugView;

/// A pass that runs a stage.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StagePass {
    /// Name of the stage, see [`Stage::find`].
    pub stage: String,
    /// À-trous level, or the number of the view that is shown.
    pub level: u32,
    /// Specialisation constants by name.
    pub constants: Vec<(String, u32)>,
    /// For every use of the pass the name of its binding; `None` where an image only stands in for one that the graph does not
    /// have.
    pub names: Vec<Option<String>>,
}

impl StagePass {
    /// The stage that a pass runs; `None` where it clears or uploads. `view` is the one that the frame shows.
    pub fn of(pass: &PassDecl, config: &Config, view: Option<DebugView>) -> Option<Self> {
        let (shader, level, available) = match pass.work {
            Work::Dispatch { shader, level, .. } => (shader, level, u32::MAX),
            Work::DebugView { shader, available } => (shader, view.unwrap_or_default() as u32, available),
            Work::StartFrame | Work::Clear => return None,
        };
        let (stage, mut constants) = variant(shader);
        for (name, value) in configured(config) {
            constants.push((name.to_owned(), value));
        }
        let bindings = shader.bindings.iter().enumerate();
        let names = bindings.map(|(i, b)| (available >> i & 1 == 1).then(|| renamed(&stage, b.name).to_owned())).collect();
        Some(Self { stage, level, constants, names })
    }
}

/// The stage of a module, and the constants that its variant stands for.
fn variant(shader: &Shader) -> (String, Vec<(String, u32)>) {
    const SWITCHES: [&str; 4] = ["VOLUME", "BOX", "REPAIR", "FADE"];
    const RULES: [&str; 2] = ["percentile_rule", "change_test"];
    let stages = super::table::STAGES.iter().map(|stage| stage.name).chain(["adaptive_history"]);
    let stage = stages.filter(|name| shader.name.starts_with(name)).max_by_key(|name| name.len()).unwrap_or(shader.name);
    let value_of = |name: &str| {
        let rest = shader.name[stage.len()..].split_once(&format!("_{}_", name.to_lowercase()))?.1;
        rest.split('_').next()?.parse().ok()
    };
    let mut constants: Vec<(String, u32)> = SWITCHES.map(|name| (name.to_owned(), value_of(name).unwrap_or(0))).into();
    constants.extend(value_of("SOURCE").map(|source| ("SOURCE".to_owned(), source)));
    let rule = value_of("RULE").and_then(|rule| RULES.get(rule as usize));
    (rule.map_or(stage, |rule| *rule).to_owned(), constants)
}

/// Constants that the configuration settles for every pass.
fn configured(config: &Config) -> [(&'static str, u32); 5] {
    let is_eaw = config.preset == Preset::Eaw;
    let weights = config.eaw_weights;
    [
        ("STRATUM_SIZE", config.stratum_size),
        ("PAINTING", if is_eaw { config.sampling as u32 } else { 0 }),
        ("RADIANCE", weights.radiance.into()),
        ("NORMAL", weights.normal.into()),
        ("POSITION", weights.position.into()),
    ]
}

fn renamed<'a>(stage: &str, binding: &'a str) -> &'a str {
    match (stage, binding) {
        ("tone_map", "denoised_radiance") => "radiance_0",
        ("tone_map", "denoised_volume") => "radiance_1",
        _ => binding,
    }
}

impl Stage {
    /// The stage that a pass runs.
    pub fn of(pass: &StagePass) -> Option<&'static Self> {
        Self::find(&pass.stage)
    }
}
