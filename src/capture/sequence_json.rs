//! The text of `sequence.json`: see docs/denoise.md for its keys.

use crate::config::{
    Config, Conventions, DepthEncoding, MotionDepth, MotionDirection, MotionUnit, NormalEncoding, NormalSpace, ViewForward,
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

/// One entry of `frames`.
pub(super) fn frame(number_of_frame: u64, params: &FrameParams) -> String {
    let reset = params.reset.map_or("false".to_owned(), |reason| format!("\"{}\"", reset_name(reason)));
    let [width, height] = params.render_extent;
    format!(
        "{{ \"i\": {number_of_frame}, \"extent\": [{width}, {height}], \"jitter\": {}, \"exposure_ratio\": {}, \"reset\": {reset},\n    \
         \"view\": {},\n    \"proj\": {} }}",
        list(params.jitter),
        number(params.exposure_ratio),
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

fn object(pairs: impl IntoIterator<Item = (&'static str, String)>) -> String {
    let pairs: Vec<_> = pairs.into_iter().map(|(key, value)| format!("\"{key}\": {value}")).collect();
    format!("{{ {} }}", pairs.join(", "))
}

/// The whole file.
pub(super) fn sequence<'a>(config: &Config, tuning: &Tuning, frames: impl IntoIterator<Item = &'a String>) -> String {
    let tunables = Tuning::FIELDS.iter().map(|f| (f.name, number(tuning.get(f.name).unwrap_or(f.default))));
    let frames: Vec<_> = frames.into_iter().map(|f| format!("  {f}")).collect();
    format!(
        "{{ \"verbatim\": true,\n  \"levels\": {},\n  \"conventions\": {},\n  \"tuning\": {},\n  \"frames\": [\n{}\n  ] }}\n",
        config.levels,
        object(conventions(&config.conventions)),
        object(tunables),
        frames.join(",\n"),
    )
}
