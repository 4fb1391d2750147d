//! The text of `sequence.json`: see docs/denoise.md for its keys.

use crate::config::{
    AdaptiveRule, BlockSort, Config, Conventions, DepthEncoding, GradientSource, MotionDepth, MotionDirection, MotionUnit,
    NormalEncoding, NormalSpace, Preset, Sampling, ViewForward,
};
use crate::contract::{FrameParams, ResetReason, Tuning};

/// A number with all its bits: as the decimal of a double it survives readers that go through doubles.
fn number(v: f32) -> String {
    f64::from(v).to_string()
}

fn list(values: impl IntoIterator<Item = f32>) -> String {
    format!("[{}]", values.into_iter().map(number).collect::<Vec<_>>().join(", "))
}

/// Columns, as the library has them, to rows.
fn rows(columns: &[[f32; 4]; 4]) -> String {
    let row = |r: usize| list(columns.map(|c| c[r]));
    format!("[{}]", (0..4).map(row).collect::<Vec<_>>().join(", "))
}

fn reset_name(reason: ResetReason) -> &'static str {
    match reason {
        ResetReason::Created => "created",
        ResetReason::CameraCut => "camera_cut",
        ResetReason::Resize => "resize",
        ResetReason::SceneLoad => "scene_load",
        ResetReason::OriginShift => "origin_shift",
        ResetReason::ExposureJump => "exposure_jump",
    }
}

fn tunables<'a>(tuning: &'a Tuning) -> impl Iterator<Item = (&'static str, f32)> + 'a {
    Tuning::FIELDS.iter().map(|f| (f.name, tuning.get(f.name).unwrap_or(f.default)))
}

/// One entry of `frames`, with the tunables that are not those of the first.
pub(super) fn frame(number_of_frame: u64, params: &FrameParams, tuning: &Tuning, first: &Tuning) -> String {
    let changed = tunables(tuning).zip(tunables(first)).filter(|(now, before)| now.1 != before.1);
    let changed = object(changed.map(|((name, value), _)| (name, number(value))));
    let reset = params.reset.map_or("false".to_owned(), |reason| format!("\"{}\"", reset_name(reason)));
    let [width, height] = params.render_extent;
    format!(
        "{{ \"i\": {number_of_frame}, \"extent\": [{width}, {height}], \"jitter\": {}, \"exposure_ratio\": {}, \"reset\": {reset}, \
         \"reshaded\": {}, \"tuning\": {changed},\n    \
         \"view\": {},\n    \"proj\": {} }}",
        list(params.jitter),
        number(params.exposure_ratio),
        params.reshaded,
        rows(&params.view_from_world),
        rows(&params.clip_from_view),
    )
}

fn conventions(c: &Conventions) -> Vec<(&'static str, String)> {
    let text = |v: &str| format!("\"{v}\"");
    let depth = match c.depth {
        DepthEncoding::Linear => "linear",
        DepthEncoding::Device => "device",
        DepthEncoding::RayLength => "ray_length",
    };
    let normal = match c.normal {
        NormalEncoding::Xyz => "xyz",
        NormalEncoding::XyzUnorm => "xyz_unorm",
        NormalEncoding::Octahedral => "octahedral",
        NormalEncoding::OctahedralUnorm => "octahedral_unorm",
    };
    let unit = match c.motion_unit {
        MotionUnit::Pixels => "pixels",
        MotionUnit::Uv => "uv",
        MotionUnit::Ndc => "ndc",
    };
    let motion_depth = match c.motion_depth {
        MotionDepth::None => "none",
        MotionDepth::Difference => "difference",
        MotionDepth::Absolute => "absolute",
    };
    let negated = c.motion_direction == MotionDirection::CurrentMinusPrevious;
    vec![
        ("depth", text(depth)),
        // JSON has no infinity.
        ("background_depth", if c.background_depth.is_finite() { number(c.background_depth) } else { text("inf") }),
        ("normal", text(normal)),
        ("normal_space", text(if c.normal_space == NormalSpace::View { "view" } else { "world" })),
        ("motion_unit", text(unit)),
        ("motion_direction", text(if negated { "current_minus_previous" } else { "previous_minus_current" })),
        ("motion_y", text(if c.motion_y_up { "up" } else { "down" })),
        ("motion_jittered", c.motion_jittered.to_string()),
        ("motion_depth", text(motion_depth)),
        ("view_forward", text(if c.view_forward == ViewForward::PositiveZ { "positive_z" } else { "negative_z" })),
    ]
}

/// What the replay needs of the configuration besides the conventions; signals and guides it sees by the channels.
fn config(c: &Config) -> Vec<(&'static str, String)> {
    let text = |v: &str| format!("\"{v}\"");
    let preset = match c.preset {
        Preset::Svgf => "svgf",
        Preset::Asvgf => "asvgf",
        Preset::Stabilize => "stabilize",
        Preset::Percentile => "percentile",
        Preset::Eaw => "eaw",
        Preset::Volume => "volume",
    };
    let source = match c.gradient_source {
        GradientSource::ForwardProjected => "forward_projected",
        GradientSource::Reshaded => "reshaded",
        GradientSource::Sparse => "sparse",
        GradientSource::Confidence => "confidence",
    };
    let sampling = match c.sampling {
        Sampling::Full => "full",
        Sampling::OneOf2x2 => "one_of_2x2",
        Sampling::OneOf4x4 => "one_of_4x4",
    };
    let weights = [("radiance", c.eaw_weights.radiance), ("normal", c.eaw_weights.normal), ("position", c.eaw_weights.position)];
    let weights: Vec<_> = weights.into_iter().filter(|w| w.1).map(|w| text(w.0)).collect();
    vec![
        ("preset", text(preset)),
        ("levels", c.levels.to_string()),
        ("stratum_size", c.stratum_size.to_string()),
        ("gradient_source", text(source)),
        ("firefly_filter", c.firefly_filter.to_string()),
        ("adaptive_rule", text(if c.adaptive_rule == AdaptiveRule::Percentiles { "percentiles" } else { "change_test" })),
        ("block_sort", text(if c.block_sort == BlockSort::OddEven { "odd_even" } else { "counting" })),
        ("eaw_weights", format!("[{}]", weights.join(", "))),
        ("sampling", text(sampling)),
    ]
}

fn object(pairs: impl IntoIterator<Item = (&'static str, String)>) -> String {
    let pairs: Vec<_> = pairs.into_iter().map(|(key, value)| format!("\"{key}\": {value}")).collect();
    format!("{{ {} }}", pairs.join(", "))
}

/// The whole file.
pub(super) fn sequence<'a>(of: &Config, tuning: &Tuning, frames: impl IntoIterator<Item = &'a String>) -> String {
    let tunables = tunables(tuning).map(|(name, value)| (name, number(value)));
    let frames: Vec<_> = frames.into_iter().map(|f| format!("  {f}")).collect();
    format!(
        "{{ \"verbatim\": true,\n  \"config\": {},\n  \"conventions\": {},\n  \"tuning\": {},\n  \"frames\": [\n{}\n  ] }}\n",
        object(config(of)),
        object(conventions(&of.conventions)),
        object(tunables),
        frames.join(",\n"),
    )
}
