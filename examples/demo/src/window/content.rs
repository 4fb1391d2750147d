//! What a half of the split screen shows.

use std::fmt;
use std::str::FromStr;

use atrous::config::Preset;
use atrous::DebugView;
use serde::{Deserialize, Serialize};

use crate::denoiser::FILTERS;

/// What a half of the split screen shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum Content {
    /// One path a pixel.
    Noisy,
    /// All paths since the camera, the objects and the lights last moved.
    Reference,
    /// What a filter makes of it.
    Filtered(Preset),
    /// What a filter knows of each pixel.
    Debug(Preset, DebugView),
}

impl Content {
    /// The filter that has to run for it.
    pub fn preset(self) -> Option<Preset> {
        match self {
            Self::Noisy | Self::Reference => None,
            Self::Filtered(preset) | Self::Debug(preset, _) => Some(preset),
        }
    }

    /// To show to people.
    pub fn title(self) -> String {
        match self {
            Self::Noisy => "noisy".into(),
            Self::Reference => "reference".into(),
            Self::Filtered(preset) => preset.title().into(),
            Self::Debug(preset, view) => format!("{}: {}", preset.title(), view.name().replace('_', " ")),
        }
    }
}

impl fmt::Display for Content {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Noisy => f.write_str("noisy"),
            Self::Reference => f.write_str("reference"),
            Self::Filtered(preset) => f.write_str(preset.name()),
            Self::Debug(preset, view) => write!(f, "{preset}/{view}"),
        }
    }
}

impl From<Content> for String {
    fn from(content: Content) -> Self {
        content.to_string()
    }
}

impl TryFrom<String> for Content {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        text.parse()
    }
}

impl FromStr for Content {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let preset = |name: &str| name.parse().ok().filter(|preset| FILTERS.contains(preset));
        let parsed = match (text, text.split_once('/')) {
            ("noisy", _) => Some(Self::Noisy),
            ("reference", _) => Some(Self::Reference),
            (_, Some((filter, shown))) => preset(filter).zip(shown.parse().ok()).map(|(p, v)| Self::Debug(p, v)),
            (_, None) => preset(text).map(Self::Filtered),
        };
        parsed.ok_or_else(|| {
            let filters = FILTERS.map(Preset::name).join(", ");
            let views = DebugView::ALL.map(DebugView::name).join(", ");
            format!(
                "\"{text}\" is nothing to show: give noisy, reference, a filter ({filters}), or FILTER/VIEW with one of {views}"
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_content_survives_its_name() {
        let mut all = vec![Content::Noisy, Content::Reference];
        for preset in FILTERS {
            all.push(Content::Filtered(preset));
            all.extend(DebugView::ALL.map(|view| Content::Debug(preset, view)));
        }
        for content in all {
            assert_eq!(content.to_string().parse(), Ok(content));
        }
        for bad in ["", "svfg", "svgf/", "svgf/heat", "/alpha"] {
            assert!(bad.parse::<Content>().expect_err("unknown").contains("history_length"), "{bad}");
        }
    }
}
