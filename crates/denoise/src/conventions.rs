//! How a sequence encodes its guides: the defaults of each layout, changed by `sequence.json` and `--convention KEY=VALUE`.

use crate::layouts::Layout;
use crate::mapping::Mapping;
use crate::roles::Role;
use atrous::config::{
    Conventions, DepthEncoding, MotionDepth, MotionDirection, MotionUnit, NormalEncoding, NormalSpace, ViewForward,
};

/// Depths from here on are background in the data sets of this project, and in Blender, whose sky is at 1e10.
const ATROUS_BACKGROUND: f32 = 1e4;
const BLENDER_BACKGROUND: f32 = 1e9;

/// What a layout means by its channels.
pub fn of_layout(mapping: &Mapping) -> Conventions {
    let mut c = Conventions { motion_unit: MotionUnit::Pixels, ..Conventions::default() };
    match mapping.layout {
        Layout::Atrous => {
            c.background_depth = ATROUS_BACKGROUND;
            if mapping.has(Role::PreviousDepth) {
                c.motion_depth = MotionDepth::Absolute;
            }
        }
        Layout::Blender => {
            c.background_depth = BLENDER_BACKGROUND;
            c.motion_y_up = true;
        }
        Layout::Mitsuba => c.depth = DepthEncoding::RayLength,
        // The film stores camera space unless told otherwise, and that looks along +z.
        Layout::Pbrt => {
            c.normal_space = NormalSpace::View;
            c.view_forward = ViewForward::PositiveZ;
        }
        Layout::Plain => {}
    }
    c
}

/// Keys and values, for the help and for errors.
pub const KEYS: &str = "depth=linear|device|ray_length, background_depth=NUMBER, normal=xyz|xyz_unorm|octahedral|octahedral_unorm, \
     normal_space=world|view, motion_unit=pixels|uv|ndc, motion_direction=previous_minus_current|current_minus_previous, motion_y=down|up, \
     motion_jittered=true|false, motion_depth=none|difference|absolute, view_forward=negative_z|positive_z";

fn pick<T: Copy>(value: &str, choices: &[(&str, T)]) -> Option<T> {
    choices.iter().find(|c| c.0 == value).map(|c| c.1)
}

/// Changes one convention. `None`: no such key or value.
pub fn set(c: &mut Conventions, key: &str, value: &str) -> Option<()> {
    use {DepthEncoding as D, MotionDepth as M, MotionDirection as S, MotionUnit as U, NormalEncoding as N};
    match key {
        "depth" => c.depth = pick(value, &[("linear", D::Linear), ("device", D::Device), ("ray_length", D::RayLength)])?,
        "background_depth" => c.background_depth = value.parse().ok().filter(|d: &f32| *d > 0.0)?,
        "normal" => {
            let named = [
                ("xyz", N::Xyz),
                ("xyz_unorm", N::XyzUnorm),
                ("octahedral", N::Octahedral),
                ("octahedral_unorm", N::OctahedralUnorm),
            ];
            c.normal = pick(value, &named)?;
        }
        "normal_space" => c.normal_space = pick(value, &[("world", NormalSpace::World), ("view", NormalSpace::View)])?,
        "motion_unit" => c.motion_unit = pick(value, &[("pixels", U::Pixels), ("uv", U::Uv), ("ndc", U::Ndc)])?,
        "motion_direction" => {
            let named = [("previous_minus_current", S::PreviousMinusCurrent), ("current_minus_previous", S::CurrentMinusPrevious)];
            c.motion_direction = pick(value, &named)?;
        }
        "motion_y" => c.motion_y_up = pick(value, &[("down", false), ("up", true)])?,
        "motion_jittered" => c.motion_jittered = value.parse().ok()?,
        "motion_depth" => {
            c.motion_depth = pick(value, &[("none", M::None), ("difference", M::Difference), ("absolute", M::Absolute)])?
        }
        "view_forward" => {
            c.view_forward = pick(value, &[("negative_z", ViewForward::NegativeZ), ("positive_z", ViewForward::PositiveZ)])?;
        }
        _ => return None,
    }
    Some(())
}
