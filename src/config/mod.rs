//! The configuration of a preset: extents, preset, signals, and the encodings of your guides.
//! Changing it re-declares every resource.

use crate::contract::Setup;
use crate::error::Error;

mod choices;
mod conventions;
mod eaw_weights;
mod fields;
#[cfg(feature = "serde")]
mod serde_forms;
#[cfg(all(test, feature = "serde"))]
mod serde_tests;

pub use choices::{AdaptiveRule, GradientSource, PostProcess, Preset, Sampling, Signals};
pub use conventions::{
    Channel, Conventions, DepthEncoding, MotionDepth, MotionDirection, MotionUnit, NormalEncoding, NormalSpace, RoughnessEncoding,
    ViewForward,
};
pub use eaw_weights::EawWeights;
pub use fields::ConfigField;

macro_rules! config {
    (
        config { $($first:tt)+ }
        conventions { $($conventions:tt)+ }
        later_conventions { $($later_conventions:tt)+ }
        later_config { $($later:tt)+ }
    ) => {
        config! { $($first)+ $($later)+ }
    };
    ($($(#[doc = $doc:literal])+ $(@[$attribute:meta])* $name:ident: $of:ident $kind:ident $type:ty = $default:expr;)+) => {
        /// Choices that you make once for a preset. Numbers that may change from frame to frame are in
        /// [`crate::Tuning`].
        ///
        /// With the feature `serde`, a field that a file leaves out has its default. The extent has none:
        /// [`Config::validate`] refuses a file without one until you set it.
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[cfg_attr(feature = "serde", serde(default = "Config::without_extent", deny_unknown_fields))]
        pub struct Config {
            /// Width and height of the allocated images, 1 to [`Config::MAX_SIDE`] each; a frame renders
            /// into their top left part. No default.
            pub allocated_extent: [u32; 2],
            $($(#[doc = $doc])+ $(#[$attribute])* pub $name: $type,)+
            /// Encodings. Default: those of [`Conventions::default`].
            pub conventions: Conventions,
        }

        impl Config {
            /// The defaults, for an extent.
            pub fn new(allocated_extent: [u32; 2]) -> Self {
                Self { allocated_extent, $($name: $default,)+ conventions: Conventions::default() }
            }

            /// Every field but the extent and the conventions, which have [`Conventions::FIELDS`].
            pub const FIELDS: &'static [ConfigField] =
                &[$(ConfigField {
                    name: stringify!($name),
                    doc: concat!($($doc, "\n"),+),
                    is_of_filter: fields::is_of_filter!($of),
                    values: fields::values!($kind $type),
                },)+];

            /// Sets a field of [`Self::FIELDS`] from text, as command lines and menus have it.
            ///
            /// # Errors
            /// [`Error::Choice`] for a name that does not exist, and for text that is no value of the field. Ranges are
            /// [`Self::validate`]'s.
            pub fn set(&mut self, name: &str, text: &str) -> Result<(), Error> {
                match name {
                    $(stringify!($name) => self.$name = fields::parse!($kind $type, text)?,)+
                    _ => {
                        let allowed = Self::FIELDS.iter().map(|field| field.name).collect::<Vec<_>>().join(", ");
                        return Err(Error::Choice { kind: "field of Config", given: name.to_owned(), allowed });
                    }
                }
                Ok(())
            }
        }
    };
}

crate::config_fields!(config);

impl Config {
    /// Largest side of an extent.
    pub const MAX_SIDE: u32 = 16384;

    /// The configuration that a file starts from.
    #[cfg(feature = "serde")]
    fn without_extent() -> Self {
        Self::new([0; 2])
    }

    /// Checks every field.
    ///
    /// # Errors
    /// [`Error::Extent`], [`Error::Config`] or [`Error::Conventions`] for the first field that is out of range.
    pub fn validate(&self) -> Result<(), Error> {
        check_extent("Config::allocated_extent", self.allocated_extent)?;
        check_output_extent("Config::output_extent", self.output_extent, self.allocated_extent)?;
        check_light_extent(self.light_extent, self.allocated_extent)?;
        check_image_extent(&self.setup())?;
        let ranges = [
            ("frames_in_flight", self.frames_in_flight, 1, 8),
            ("levels", self.levels(), 1, 10),
            ("stratum_size", self.stratum_size, 2, 4),
            ("visibility", self.visibility, 0, 4),
        ];
        for (name, given, min, max) in ranges {
            if !(min..=max).contains(&given) {
                return Err(Error::Config { name, given, min, max });
            }
        }
        self.conventions.validate()
    }

    /// À-trous levels: those of the configuration, or those of the preset for the allocated extent.
    pub fn levels(&self) -> u32 {
        self.levels.unwrap_or(self.preset.levels(self.allocated_extent))
    }

    /// Whether a volume is filtered.
    pub(crate) fn has_volume(&self) -> bool {
        self.volume || self.preset == Preset::Volume
    }
}

pub(crate) fn check_extent(what: &'static str, given: [u32; 2]) -> Result<(), Error> {
    if given.iter().any(|side| !(1..=Config::MAX_SIDE).contains(side)) {
        return Err(Error::Extent { what, given, max: Config::MAX_SIDE });
    }
    Ok(())
}

/// The largest side of an output over that of the rendered picture.
const LARGEST_RATIO: u32 = 3;

/// Checks the output of a picture of so many pixels.
pub(crate) fn check_output_extent(what: &'static str, output: Option<[u32; 2]>, rendered: [u32; 2]) -> Result<(), Error> {
    let Some(output) = output else { return Ok(()) };
    check_extent(what, output)?;
    let fits = |i: usize| (rendered[i]..=rendered[i] * LARGEST_RATIO).contains(&output[i]);
    match fits(0) && fits(1) {
        true => Ok(()),
        false => Err(Error::OutputExtent { what, output, rendered }),
    }
}

/// Checks the light of a picture of so many pixels.
pub(crate) fn check_light_extent(light: Option<[u32; 2]>, rendered: [u32; 2]) -> Result<(), Error> {
    let Some(light) = light else { return Ok(()) };
    match (0..2).all(|i| light[i] == rendered[i] || (rendered[i].is_multiple_of(2) && light[i] == rendered[i] / 2)) {
        true => Ok(()),
        false => Err(Error::LightExtent { light, rendered }),
    }
}

/// Checks the images of a host that are larger than the picture.
pub(crate) fn check_image_extent(setup: &Setup) -> Result<(), Error> {
    let Some(images) = setup.image_extent else { return Ok(()) };
    check_extent("Config::image_extent", images)?;
    let allocated = setup.allocated_extent;
    if (0..2).any(|i| images[i] < allocated[i]) {
        return Err(Error::ImageExtent { images, allocated });
    }
    let others = [("output_extent", setup.output_extent), ("light_extent", setup.light_extent)];
    match others.into_iter().find(|(_, extent)| extent.is_some()) {
        Some((other, _)) => Err(Error::PartAndSize { other, images }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_footprint_of_the_filter_grows_with_the_picture() {
        let levels = |preset, extent| Config { preset, ..Config::new(extent) }.levels();
        let sizes = [[320, 180], [640, 360], [1280, 720], [720, 1280], [1920, 1080], [3840, 2160]];
        for preset in [Preset::Best, Preset::Fast] {
            assert_eq!(sizes.map(|size| levels(preset, size)), [5, 5, 6, 6, 6, 7], "{preset}");
        }
        assert_eq!(sizes.map(|size| levels(Preset::Svgf, size)), [5; 6]);
        assert_eq!(Config { levels: Some(3), ..Config::new([1280, 720]) }.levels(), 3);
    }

    #[test]
    fn a_field_is_set_from_text() {
        let mut config = Config::new([64, 36]);
        for (name, text) in
            [("preset", "fast"), ("levels", "3"), ("surface_id", "false"), ("eaw_weights", "normal"), ("sampling", "one_of_2x2")]
        {
            config.set(name, text).expect(name);
        }
        let expected = Config {
            preset: Preset::Fast,
            levels: Some(3),
            surface_id: false,
            eaw_weights: "normal".parse().expect("weights"),
            sampling: Sampling::OneOf2x2,
            ..Config::new([64, 36])
        };
        assert_eq!(config, expected);
        config.set("levels", "none").expect("none");
        assert_eq!(config.levels, None);
        for (name, text, part) in [
            ("preset", "slow", "svgf"),
            ("levels", "many", "whole number"),
            ("volume", "2", "true, false"),
            ("colour", "1", "preset"),
        ] {
            let message = config.set(name, text).expect_err("refused").to_string();
            assert!(message.contains(part) && message.contains(if name == "colour" { name } else { text }), "{message}");
        }
        for field in Config::FIELDS {
            for (text, _) in (field.values)() {
                config.set(field.name, text).expect(field.name);
            }
        }
    }

    #[test]
    fn levels_are_those_of_the_preset_unless_a_number_is_asked_for() {
        let levels = |preset: Preset, levels: Option<u32>, extent| {
            let declaration = Config { preset, levels, ..Config::new(extent) }.declare().expect("a graph");
            let is_level = |name: &str| name.strip_prefix("atrous_").is_some_and(|level| level.parse::<u32>().is_ok());
            declaration.passes().iter().filter(|pass| is_level(&pass.name)).count()
        };
        let hd = [1280, 720];
        assert_eq!([Preset::Svgf, Preset::Best, Preset::Fast].map(|preset| levels(preset, None, hd)), [5, 6, 6]);
        assert_eq!((levels(Preset::Svgf, Some(4), hd), levels(Preset::Best, Some(3), hd)), (4, 3));
        for given in [0, 11] {
            let error = Config { levels: Some(given), ..Config::new([64, 36]) }.declare().expect_err("out of range");
            assert!(matches!(error, Error::Config { name: "levels", given: g, min: 1, max: 10 } if g == given), "{error}");
        }
    }
}
