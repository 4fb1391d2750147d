//! Encodings of a sequence's guides: the defaults of each layout, changed by `sequence.json` and `--convention KEY=VALUE`.

use crate::layouts::Layout;
use crate::mapping::Mapping;
use crate::roles::Role;
use atrous::config::{
    Channel, Conventions, DepthEncoding, MotionDepth, MotionDirection, MotionUnit, NormalEncoding, NormalSpace, RoughnessEncoding,
    ViewForward,
};
use atrous::Choice;
use serde_json::{Map, Value};

/// Depths from here on are background in the data sets of this project, and in Blender, whose sky is at 1e10.
const ATROUS_BACKGROUND: f32 = 1e4;
const BLENDER_BACKGROUND: f32 = 1e9;

/// Factors that bring guides to the unit of the matrices, and of the conventions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scales {
    /// Of depth, unless it is that of a depth buffer.
    pub depth: f32,
}

impl Default for Scales {
    fn default() -> Self {
        Self { depth: 1.0 }
    }
}

impl Scales {
    /// Changes one. None: there is none of this name.
    ///
    /// # Errors
    /// A value that is no factor.
    pub fn set(&mut self, key: &str, value: &str) -> Option<Result<(), String>> {
        let field = match key {
            "depth_scale" => &mut self.depth,
            _ => return None,
        };
        let factor = value.parse::<f32>().ok().filter(|factor| factor.is_normal() && *factor > 0.0);
        Some(factor.map(|factor| *field = factor).ok_or_else(|| format!("`{value}` is no number above 0")))
    }
}

/// The conventions of a layout.
pub fn of_layout(mapping: &Mapping) -> Conventions {
    let mut c = Conventions { motion_unit: MotionUnit::Pixels, ..Conventions::default() };
    match mapping.layout {
        Layout::Atrous => {
            // The background has the id 0; without ids only its depth tells it.
            if !mapping.has(Role::Id) {
                c.background_depth = ATROUS_BACKGROUND;
            }
            c.roughness = RoughnessEncoding::Alpha;
            if mapping.has(Role::PreviousDepth) {
                c.motion_depth = MotionDepth::Absolute;
            }
        }
        Layout::Blender => {
            c.background_depth = BLENDER_BACKGROUND;
            c.motion_y_up = true;
            if mapping.is_for_denoisers(Role::Normal) {
                c.normal_space = NormalSpace::View;
            }
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
pub fn keys() -> String {
    fn names<T: Choice>() -> String {
        T::ALL.iter().map(|value| value.name()).collect::<Vec<_>>().join("|")
    }
    [
        ("depth", names::<DepthEncoding>()),
        ("depth_scale", "NUMBER".to_owned()),
        ("background_depth", "NUMBER".to_owned()),
        ("normal", names::<NormalEncoding>()),
        ("normal_space", names::<NormalSpace>()),
        ("motion_unit", names::<MotionUnit>()),
        ("motion_scale", "NUMBER".to_owned()),
        ("motion_direction", names::<MotionDirection>()),
        ("motion_y", "down|up".to_owned()),
        ("motion_jittered", "true|false".to_owned()),
        ("motion_depth", names::<MotionDepth>()),
        ("view_forward", names::<ViewForward>()),
        ("roughness", names::<RoughnessEncoding>()),
        ("roughness_channel", names::<Channel>()),
        ("demodulated", "true|false".to_owned()),
    ]
    .map(|(key, values)| format!("{key}={values}"))
    .join(", ")
}

/// Changes one convention.
///
/// # Errors
/// The key or the value that there is not, as a sentence.
pub fn set(c: &mut Conventions, key: &str, value: &str) -> std::result::Result<(), serde_json::Error> {
    let number = || value.parse().ok().and_then(serde_json::Number::from_f64).map(Value::Number);
    let value = value.parse().ok().map(Value::Bool).or_else(number).unwrap_or_else(|| Value::String(value.to_owned()));
    let mut fields: Map<String, Value> = serde_json::from_value(serde_json::to_value(*c)?)?;
    fields.insert(key.to_owned(), value);
    *c = serde_json::from_value(fields.into())?;
    Ok(())
}

/// Keys and values in which conventions differ from others, as [`set`] takes them.
pub fn changes(from: &Conventions, to: &Conventions) -> Vec<(String, String)> {
    let fields = |c: &Conventions| match serde_json::to_value(c) {
        Ok(Value::Object(fields)) => fields,
        _ => Map::new(),
    };
    let (from, to) = (fields(from), fields(to));
    let text = |value: &Value| value.as_str().map_or_else(|| value.to_string(), str::to_owned);
    to.iter().filter(|(key, value)| from.get(*key) != Some(*value)).map(|(key, value)| (key.clone(), text(value))).collect()
}
