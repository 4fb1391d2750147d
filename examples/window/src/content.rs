//! What a half of the split screen shows.

use std::fmt;
use std::str::FromStr;

use atrous::config::Preset;
use atrous::DebugView;
use serde::{Deserialize, Serialize};

use atrous_engine::denoiser::FILTERS;

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
    /// How far a filter is from the reference, as FLIP sees it.
    Error(Preset),
    /// What a filter knows of each pixel.
    Debug(Preset, DebugView),
}

impl Content {
    /// The filter that has to run for it.
    pub fn preset(self) -> Option<Preset> {
        match self {
            Self::Noisy | Self::Reference => None,
            Self::Filtered(preset) | Self::Error(preset) | Self::Debug(preset, _) => Some(preset),
        }
    }

    /// Whether the reference has to grow for it.
    pub fn needs_reference(self) -> bool {
        matches!(self, Self::Reference | Self::Error(_))
    }

    /// The filter whose error it shows.
    pub fn compared(self) -> Option<Preset> {
        match self {
            Self::Error(preset) => Some(preset),
            _ => None,
        }
    }

    /// The error of the filter that it shows, or what that error is of; itself where there is no filter.
    pub fn error_or_back(self) -> Self {
        match self {
            Self::Error(preset) => Self::Filtered(preset),
            Self::Filtered(preset) | Self::Debug(preset, _) => Self::Error(preset),
            Self::Noisy | Self::Reference => self,
        }
    }

    /// To show to people.
    pub fn title(self) -> String {
        match self {
            Self::Noisy => "noisy".into(),
            Self::Reference => "reference".into(),
            Self::Filtered(preset) => preset.title().into(),
            Self::Error(preset) => format!("{}: error (FLIP)", preset.title()),
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
            Self::Error(preset) => write!(f, "{preset}/error"),
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
            (_, Some((filter, "error"))) => preset(filter).map(Self::Error),
            (_, Some((filter, shown))) => preset(filter).zip(shown.parse().ok()).map(|(p, v)| Self::Debug(p, v)),
            (_, None) => preset(text).map(Self::Filtered),
        };
        parsed.ok_or_else(|| {
            let filters = FILTERS.map(Preset::name).join(", ");
            let views = DebugView::ALL.map(DebugView::name).join(", ");
            format!(
                "\"{text}\" is nothing to show: give noisy, reference, a filter ({filters}), FILTER/error, or FILTER/VIEW with one of {views}"
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_is_of_the_filter_that_is_shown() {
        let [filtered, error] = [Content::Filtered(Preset::Svgf), Content::Error(Preset::Svgf)];
        assert_eq!([filtered.error_or_back(), error.error_or_back()], [error, filtered]);
        assert_eq!(Content::Debug(Preset::Svgf, DebugView::Depth).error_or_back(), error);
        assert_eq!(Content::Noisy.error_or_back(), Content::Noisy);
        assert!(error.needs_reference() && Content::Reference.needs_reference() && !filtered.needs_reference());
    }

    #[test]
    fn every_content_survives_its_name() {
        let mut all = vec![Content::Noisy, Content::Reference];
        for preset in FILTERS {
            all.extend([Content::Filtered(preset), Content::Error(preset)]);
            all.extend(DebugView::ALL.map(|view| Content::Debug(preset, view)));
        }
        for content in all {
            assert_eq!(content.to_string().parse(), Ok(content));
        }
        for bad in ["", "svfg", "svgf/", "svgf/heat", "/alpha", "noisy/error"] {
            assert!(bad.parse::<Content>().expect_err("unknown").contains("history_length"), "{bad}");
        }
    }
}
