//! What a sequence has and what it lacks, in lines; and encodings that fit what stands in for it.

use crate::layouts::Layout;
use crate::mapping::Mapping;
use crate::roles::Role;
use atrous::config::{DepthEncoding, MotionDepth, MotionDirection, MotionUnit, NormalEncoding, Signals};
use atrous::Config;

/// The channels of each role, and how they are filtered.
pub fn describe(mapping: &Mapping, config: &Config) -> Vec<String> {
    let mut lines = vec![format!("channels ({}):", mapping.layout.name())];
    for (role, names) in &mapping.roles {
        lines.push(format!("  {:<16} {}", role.name(), short(names)));
    }
    let signals = match config.signals {
        Signals::Apart => "direct and indirect apart",
        Signals::Specular if !mapping.has_specular() && !mapping.has(Role::Albedo) => "together, as specular light",
        Signals::Specular => "diffuse and specular apart",
        Signals::Mixed => "together, as one signal with roughness",
        _ => "together, as one signal",
    };
    lines.push(format!("  {:<16} {signals}, by {}", "filtered", config.preset.title()));
    lines
}

/// `noisy.R, noisy.G, noisy.B` as `noisy.R/G/B`.
fn short(names: &[String]) -> String {
    let split: Vec<_> = names.iter().map(|n| crate::mapping::split(n)).collect();
    match split.iter().all(|s| s.0 == split[0].0) {
        true => format!(
            "{}{}{}",
            split[0].0,
            if split[0].0.is_empty() { "" } else { "." },
            split.iter().map(|s| s.1).collect::<Vec<_>>().join("/")
        ),
        false => names.join(", "),
    }
}

/// Names what is missing and what is lost, and makes the encodings fit what stands in for it.
pub fn without(config: &mut Config, mapping: &Mapping, camera: bool, report: &mut Vec<String>) {
    let mut lost = |what: &str, loss: &str| report.push(format!("  no {what}: {loss}"));
    let c = &mut config.conventions;
    let depth = mapping.has(Role::Depth) || (mapping.has(Role::Position) && (camera || mapping.layout == Layout::Pbrt));
    for role in [Role::Emission, Role::Albedo, Role::Normal, Role::Id] {
        if !mapping.has(role) {
            lost(role.name(), role.loss());
        }
    }
    if !mapping.has_signals_apart() && !mapping.has_specular() {
        lost("direct and indirect light", Role::Indirect.loss());
    }
    if !mapping.has(Role::Normal) {
        c.normal = NormalEncoding::Xyz;
    }
    if !mapping.has(Role::Depth) {
        c.depth = DepthEncoding::Linear;
    }
    if !depth {
        lost("depth", Role::Depth.loss());
    } else if !camera && c.depth != DepthEncoding::Linear {
        lost("camera", "the depth cannot be decoded without a projection and is taken as linear");
        c.depth = DepthEncoding::Linear;
    }
    match (mapping.has(Role::Motion), camera && depth) {
        (true, true) => {}
        (true, false) if c.motion_depth == MotionDepth::Absolute && mapping.has(Role::PreviousDepth) => {}
        (true, false) => {
            lost("camera and depth", "depths are expected to stay as they were; surfaces that come closer by more than depth_tolerance lose their history");
            c.motion_depth = MotionDepth::Difference;
        }
        (false, true) => {
            lost("motion", "it is computed from depth and camera, so objects that move by themselves lose their history");
            c.motion_depth = MotionDepth::None;
        }
        (false, false) => {
            lost(
                "motion and no camera",
                "pixels are taken to stay where they are; with a moving camera the history smears or is lost",
            );
            (c.motion_unit, c.motion_depth) = (MotionUnit::Pixels, MotionDepth::Difference);
            (c.motion_direction, c.motion_y_up) = (MotionDirection::PreviousMinusCurrent, false);
        }
    }
}
