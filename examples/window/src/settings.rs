//! Everything that the panel changes, as one value that a file keeps.

use std::collections::BTreeMap;
use std::path::Path;

use atrous::config::Preset;
use atrous::{ToneCurve, Tuning};
use serde::{Deserialize, Deserializer, Serialize};

use super::content::Content;
use super::layout::Scaling;
use crate::error::{Error, Result};
use atrous_engine::denoiser::FILTERS;

/// Slowest and fastest passing of time.
pub const SPEEDS: [f32; 2] = [0.05, 4.0];

/// Smallest and largest difference that a view of it ends at.
pub const DIFFERENCE_RANGES: [f32; 2] = [0.01, 1.0];

/// Everything that the panel changes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Settings {
    /// A built-in scene's name, or the path of a glTF file.
    pub scene: String,
    /// What is left of the divider.
    pub left: Content,
    /// What is right of it.
    pub right: Content,
    /// Where it is, 0 to 1 of the picture's width.
    pub divider: f32,
    /// The whole picture is the right half minus the left one.
    pub difference: bool,
    /// The difference that is black or white, in encoded values: 1 is that of black and white.
    pub difference_range: f32,
    /// How the picture is enlarged.
    pub scaling: Scaling,
    /// Time stands still.
    pub paused: bool,
    /// How fast time passes; 1: 30 frames for a second.
    pub speed: f32,
    /// The lights change.
    pub animate_light: bool,
    /// The objects move.
    pub animate_objects: bool,
    /// The camera follows its path; off once it is steered.
    pub animate_camera: bool,
    /// Jitter, resolved by temporal anti-aliasing.
    pub taa: bool,
    /// Curve of the tone map.
    #[serde(deserialize_with = "tone_curve")]
    pub tone_curve: ToneCurve,
    /// Scale of the radiance before the tone curve.
    pub exposure: f32,
    /// Wait for the display.
    pub vsync: bool,
    /// Brighter than white, where the display can.
    pub hdr: bool,
    /// The magnifier.
    pub magnifier: bool,
    /// The panel.
    pub panel: bool,
    /// Numbers that are not at their defaults, by filter.
    pub tuning: BTreeMap<String, BTreeMap<String, f32>>,
}

/// By its name; by its number in files of older versions.
fn tone_curve<'de, D: Deserializer<'de>>(from: D) -> std::result::Result<ToneCurve, D::Error> {
    #[derive(Deserialize)]
    #[serde(untagged)]
    enum Given {
        Number(u32),
        Name(String),
    }
    let curve = match Given::deserialize(from)? {
        Given::Number(number) => number.try_into(),
        Given::Name(name) => name.parse(),
    };
    curve.map_err(|e: atrous::Error| serde::de::Error::custom(format!("tone_curve: {e}")))
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            scene: "cornell".into(),
            left: Content::Noisy,
            right: Content::Filtered(Preset::Asvgf),
            divider: 0.5,
            difference: false,
            difference_range: 0.1,
            scaling: Scaling::default(),
            paused: false,
            speed: 1.0,
            animate_light: true,
            animate_objects: true,
            animate_camera: true,
            taa: false,
            tone_curve: ToneCurve::default(),
            exposure: 1.0,
            vsync: true,
            hdr: false,
            magnifier: false,
            panel: true,
            tuning: BTreeMap::new(),
        }
    }
}

impl Settings {
    /// The numbers of a filter.
    pub fn tuning(&self, preset: Preset) -> Tuning {
        let mut tuning = Tuning::for_preset(preset);
        for (name, value) in self.tuning.get(preset.name()).into_iter().flatten() {
            // Checked when it was set or loaded.
            let _ = tuning.set(name, *value);
        }
        tuning.exposure = self.exposure;
        tuning.tone_curve = self.tone_curve;
        tuning
    }

    /// Changes one number of a filter; one at its default is not kept.
    pub fn set_tuning(&mut self, preset: Preset, name: &str, value: f32) {
        let numbers = self.tuning.entry(preset.name().into()).or_default();
        if Tuning::for_preset(preset).get(name) == Some(value) {
            numbers.remove(name);
        } else {
            numbers.insert(name.into(), value);
        }
        self.tuning.retain(|_, numbers| !numbers.is_empty());
    }

    /// Reads a file.
    ///
    /// # Errors
    /// A file that cannot be read, or that has a value that is not allowed: the message names it.
    pub fn load(path: &Path) -> Result<Self> {
        let bad = |problem: String| Error::SettingsFile { path: path.to_owned(), problem };
        let text = atrous_files::read_text(path, 1 << 20).map_err(|e| bad(e.to_string()))?;
        let settings: Self = serde_json::from_str(&text).map_err(|e| bad(e.to_string()))?;
        settings.check().map_err(bad)?;
        Ok(settings)
    }

    /// Writes a file.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn save(&self, path: &Path) -> Result<()> {
        let bad = |problem: String| Error::SettingsFile { path: path.to_owned(), problem };
        let text = serde_json::to_string_pretty(self).map_err(|e| bad(e.to_string()))?;
        std::fs::write(path, text + "\n").map_err(|e| bad(e.to_string()))
    }

    fn check(&self) -> std::result::Result<(), String> {
        let ranges = [
            ("divider", self.divider, 0.0, 1.0),
            ("difference_range", self.difference_range, DIFFERENCE_RANGES[0], DIFFERENCE_RANGES[1]),
            ("speed", self.speed, SPEEDS[0], SPEEDS[1]),
            ("exposure", self.exposure, 0.0, 65504.0),
        ];
        for (name, given, min, max) in ranges {
            if !(min..=max).contains(&given) {
                return Err(format!("{name} is {given}; allowed is {min} to {max}"));
            }
        }
        for (filter, numbers) in &self.tuning {
            if !FILTERS.iter().any(|preset| preset.name() == filter) {
                return Err(format!("tuning of \"{filter}\": no such filter; there are {}", FILTERS.map(Preset::name).join(", ")));
            }
            for (name, value) in numbers {
                Tuning::default().set(name, *value).map_err(|e| format!("tuning of {filter}: {e}"))?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(text: &str) -> std::path::PathBuf {
        let path = std::env::temp_dir().join(format!("atrous-settings-{}-{}.json", std::process::id(), text.len()));
        std::fs::write(&path, text).expect("a temporary file");
        path
    }

    #[test]
    fn settings_survive_a_file() {
        let mut settings = Settings { scene: "hall".into(), divider: 0.25, speed: 0.5, ..Settings::default() };
        settings.set_tuning(Preset::Svgf, "alpha", 0.05);
        settings.set_tuning(Preset::Eaw, "eaw_sigma_radiance", Tuning::default().eaw_sigma_radiance);
        let path = file("");
        settings.save(&path).expect("saved");
        assert_eq!(Settings::load(&path).expect("loaded"), settings);
        assert_eq!(settings.tuning(Preset::Svgf).alpha, 0.05);
        assert_eq!(settings.tuning.len(), 1, "a default is not kept");
        let _ = std::fs::remove_file(path);
    }

    #[test]
    fn a_tone_curve_is_read_by_name_and_by_number() {
        for text in ["{\"tone_curve\": \"reinhard\"}", "{\"tone_curve\": 1}"] {
            assert_eq!(serde_json::from_str::<Settings>(text).expect(text).tone_curve, ToneCurve::Reinhard);
        }
        let settings = Settings { tone_curve: ToneCurve::Linear, ..Settings::default() };
        assert!(serde_json::to_string(&settings).expect("JSON").contains("\"tone_curve\":\"linear\""));
    }

    #[test]
    fn a_file_that_is_wrong_says_where() {
        for (text, named) in [
            ("{\"divider\": 2}", "divider"),
            ("{\"difference_range\": 0}", "difference_range"),
            ("{\"scaling\": \"large\"}", "integer"),
            ("{\"left\": \"svfg\"}", "svfg"),
            ("{\"left\": \"volume\"}", "volume"),
            ("{\"tone_curve\": \"filmic\"}", "reinhard"),
            ("{\"tone_curve\": 3}", "2 (linear)"),
            ("{\"tuning\": {\"svgf\": {\"alpha\": 7}}}", "alpha"),
            ("{\"tuning\": {\"nrd\": {}}}", "nrd"),
            ("{\"devider\": 0.5}", "devider"),
            ("nonsense", "line 1"),
        ] {
            let path = file(text);
            let message = Settings::load(&path).expect_err("wrong").to_string();
            assert!(message.contains(named), "{message}");
            let _ = std::fs::remove_file(path);
        }
    }
}
