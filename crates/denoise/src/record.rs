//! The options that a frame was made with, in the header of its file: `--resume` mixes no two of them.

use crate::error::{Result, ToolError};
use crate::exr_header::ExrHeader;
use crate::sampling::Pattern;
use crate::setup::{Options, Setup};
use exr::meta::attribute::AttributeValue;
use exr::prelude::Text;
use serde_json::{json, Map, Value};

/// Name of the attribute.
const ATTRIBUTE: &str = "atrousDenoise";

/// Everything that changes what a run writes for a frame, but for the frames themselves.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Record(Map<String, Value>);

impl Record {
    /// The record of a run.
    ///
    /// # Errors
    /// [`ToolError::Usage`] for what JSON cannot hold.
    pub fn new(setup: &Setup, options: &Options) -> Result<Self> {
        let config = serde_json::to_value(setup.config).map_err(|e| ToolError::Usage(e.to_string()))?;
        let channels: Map<String, Value> =
            setup.mapping.roles.iter().map(|(role, names)| (role.name().to_owned(), json!(names.join(",")))).collect();
        let set: Map<String, Value> = options.tunables.iter().map(|(name, value)| (name.clone(), json!(value))).collect();
        let made = options.made;
        let engine = if made.reference { "reference" } else { "vulkan" };
        let fields = json!({
            "version": env!("CARGO_PKG_VERSION"),
            "engine": engine,
            "config": config,
            "set": set,
            "channel": channels,
            "sequence.json, checksum": setup.sequence.as_ref().map(|s| s.checksum),
            "keep_samples": options.keep_samples.map(Pattern::name),
            "float": made.float,
            "png": made.preview.is_some(),
            "exposure": made.preview,
            "views": made.views,
            "keep_layers": made.keeps_layers,
            "scaled by 2^": setup.range.exponent,
            "depth_scale": setup.scales.depth,
            "stills": setup.stills,
            "smoothed": setup.smoothed,
            "depth looked up": setup.carries_depth,
        });
        Ok(Self(fields.as_object().cloned().unwrap_or_default()))
    }

    /// Name and value of the attribute.
    pub fn attribute(&self) -> Option<(Text, AttributeValue)> {
        let json = Value::Object(self.0.clone()).to_string();
        // The format has one byte a character.
        let mut ascii = String::new();
        for c in json.chars() {
            match c.is_ascii() {
                true => ascii.push(c),
                false => c.encode_utf16(&mut [0; 2]).iter().for_each(|unit| ascii += &format!("\\u{unit:04x}")),
            }
        }
        Some((Text::new_or_none(ATTRIBUTE)?, AttributeValue::Text(Text::new_or_none(ascii)?)))
    }

    /// The part that holds the result of a run: the one with its record, or the first one.
    pub fn part(header: &ExrHeader) -> usize {
        let name = Text::new_or_none(ATTRIBUTE);
        let has_record = |part: &exr::prelude::LayerAttributes| name.as_ref().is_some_and(|name| part.other.contains_key(name));
        header.parts.iter().position(has_record).unwrap_or_default()
    }

    /// What is wrong with keeping a file beside files of this record, if anything is.
    pub fn objection(&self, header: &ExrHeader) -> Option<String> {
        let part = header.parts.get(Self::part(header));
        let earlier = match part.and_then(|part| part.other.get(&Text::new_or_none(ATTRIBUTE)?)) {
            Some(AttributeValue::Text(text)) => serde_json::from_str(&text.to_string()).ok(),
            _ => None,
        };
        let Some(earlier) = earlier else { return Some("does not say with which options it was made".to_owned()) };
        let (there, now) = (flat(&earlier), flat(&Value::Object(self.0.clone())));
        let absent = Value::Null;
        let value = |of: &Map<String, Value>, key: &str| of.get(key).unwrap_or(&absent).clone();
        let key = there.keys().chain(now.keys()).find(|key| value(&there, key) != value(&now, key))?;
        Some(format!("was made with other options: `{key}` was {} and is {}", value(&there, key), value(&now, key)))
    }
}

/// Fields of fields as `outer.inner`.
fn flat(value: &Value) -> Map<String, Value> {
    let mut fields = Map::new();
    for (name, value) in value.as_object().into_iter().flatten() {
        match value {
            Value::Object(_) => fields.extend(flat(value).into_iter().map(|(inner, value)| (format!("{name}.{inner}"), value))),
            value => _ = fields.insert(name.clone(), value.clone()),
        }
    }
    fields
}
