//! The text of `sequence.json`: see docs/specification/exr.md for its keys.

use crate::config::{Config, Conventions, Signals};
use crate::contract::{FrameParams, Material, ResetReason, Tuning};
use serde::Serialize;
use serde_json::{Error, Map, Value};
use std::collections::BTreeMap;

/// One entry of `frames`. Numbers are doubles: as the decimal of one, a float survives readers that go through doubles with all its
/// bits.
#[derive(Serialize)]
struct Frame {
    i: u64,
    /// What it counted as in the engine, where that is not its number in the sequence.
    #[serde(skip_serializing_if = "Option::is_none")]
    index: Option<u64>,
    extent: [u32; 2],
    jitter: [f64; 2],
    exposure_ratio: f64,
    reset: Reset,
    reshaded: bool,
    /// Left out where no place is known.
    #[serde(skip_serializing_if = "Option::is_none")]
    lights: Option<[[f64; 4]; 4]>,
    /// Left out where it is the first pixel of its cell.
    #[serde(skip_serializing_if = "Option::is_none")]
    offset: Option<[u32; 2]>,
    /// Left out where all classes are as the tunables say.
    #[serde(skip_serializing_if = "Option::is_none")]
    materials: Option<[[f64; 4]; Material::CLASSES]>,
    tuning: BTreeMap<&'static str, f64>,
    view: [[f64; 4]; 4],
    proj: [[f64; 4]; 4],
}

/// `false`, or the reason.
#[derive(Serialize)]
#[serde(untagged)]
enum Reset {
    No(bool),
    Reason(ResetReason),
}

/// Columns, as the library has them, to rows.
fn rows(columns: &[[f32; 4]; 4]) -> [[f64; 4]; 4] {
    std::array::from_fn(|row| columns.map(|column| f64::from(column[row])))
}

/// The tunables that are not those of `other`; all without.
fn tunables(tuning: &Tuning, other: Option<&Tuning>) -> BTreeMap<&'static str, f64> {
    let names = Tuning::FIELDS.iter().map(|field| field.name);
    let changed = names.filter(|name| other.is_none_or(|other| tuning.get(name) != other.get(name)));
    changed.filter_map(|name| Some((name, f64::from(tuning.get(name)?)))).collect()
}

/// One entry of `frames`: number in the sequence and index in the engine, and the tunables that are not those of the first.
pub(super) fn frame([number, index]: [u64; 2], params: &FrameParams, tuning: &Tuning, first: &Tuning) -> Result<String, Error> {
    serde_json::to_string(&Frame {
        i: number,
        index: (index != number).then_some(index),
        extent: params.render_extent,
        jitter: params.jitter.map(f64::from),
        exposure_ratio: params.exposure_ratio.into(),
        reset: params.reset.map_or(Reset::No(false), Reset::Reason),
        reshaded: params.reshaded,
        lights: (params.lights != [[0.0; 4]; 4]).then(|| params.lights.map(|light| light.map(f64::from))),
        offset: (params.light_offset != [0; 2]).then_some(params.light_offset),
        materials: (params.materials != FrameParams::new([1; 2]).materials)
            .then(|| params.materials.map(|material| <[f32; 4]>::from(material).map(f64::from))),
        tuning: tunables(tuning, Some(first)),
        view: rows(&params.view_from_world),
        proj: rows(&params.clip_from_view),
    })
}

/// The part of the file that does not change from frame to frame.
pub(super) struct Head {
    config: String,
    conventions: String,
    tuning: String,
}

impl Head {
    /// `config`: that of a preset; a graph of a host has none, and a replay chooses a preset.
    /// `extents`: sizes of light and output, where they have some of their own.
    pub(crate) fn new(
        config: Option<&Config>,
        extents: [(&str, Option<[u32; 2]>); 2],
        conventions: &Conventions,
        tuning: &Tuning,
    ) -> Result<Self, Error> {
        let mut fields: Map<String, Value> = match config {
            // Defaults may change, and a replay must not.
            Some(config) => serde_json::from_value(serde_json::to_value(Config { levels: Some(config.levels()), ..*config })?)?,
            None => Map::new(),
        };
        // Guides a replay sees by the channels, and signals, but for one that two kinds of light share.
        let is_mixed = config.is_some_and(|config| config.signals == Signals::Mixed);
        let is_told = |name: &str| name == "signals" && is_mixed;
        fields.retain(|name, _| is_told(name) || Config::FIELDS.iter().any(|field| field.is_of_filter && field.name == name));
        fields.extend(extents.into_iter().filter_map(|(name, extent)| Some((name.to_owned(), extent?.to_vec().into()))));
        Ok(Self {
            config: serde_json::to_string(&fields)?,
            conventions: serde_json::to_string(conventions)?,
            tuning: serde_json::to_string(&tunables(tuning, None))?,
        })
    }

    /// The whole file: a line for each frame, so that a person can read it.
    pub(crate) fn with_frames<'a>(&self, frames: impl IntoIterator<Item = &'a String>) -> String {
        let Self { config, conventions, tuning } = self;
        let frames: Vec<&str> = frames.into_iter().map(String::as_str).collect();
        format!(
            "{{\"verbatim\":true,\n\"config\":{config},\n\"conventions\":{conventions},\n\"tuning\":{tuning},\n\"frames\":[\n{}\n]}}\n",
            frames.join(",\n")
        )
    }
}
