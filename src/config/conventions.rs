//! Encodings of your depth, normals and motion.

use super::fields::{is_of_filter, values, ConfigField};
use crate::choice::choices;
use crate::error::Error;

choices! {
    /// Encoding of `depth`.
    #[derive(Default)]
    pub enum DepthEncoding {
        /// View-space depth along the view axis, positive, in scene units.
        #[default]
        Linear = 0 => "linear",
        /// The values of a depth buffer, by `FrameParams::clip_from_view`: reversed, infinite and orthographic projections all
        /// work.
        Device = 1 => "device",
        /// Distance from the camera to the surface along the ray.
        RayLength = 2 => "ray_length",
    }

    /// Encoding of `normal`.
    #[derive(Default)]
    pub enum NormalEncoding {
        /// xyz in −1..1; need not be of unit length.
        #[default]
        Xyz = 0 => "xyz",
        /// xyz stored as v·0.5 + 0.5.
        XyzUnorm = 1 => "xyz_unorm",
        /// Octahedral xy in −1..1.
        Octahedral = 2 => "octahedral",
        /// Octahedral xy stored as v·0.5 + 0.5.
        OctahedralUnorm = 3 => "octahedral_unorm",
    }

    /// Space of normals.
    #[derive(Default)]
    pub enum NormalSpace {
        /// World space.
        #[default]
        World = 0 => "world",
        /// View space of the current frame.
        View = 1 => "view",
    }

    /// Unit of `motion`.
    #[derive(Default)]
    pub enum MotionUnit {
        /// Pixels of the render extent.
        Pixels = 0 => "pixels",
        /// Fractions of the render extent.
        #[default]
        Uv = 1 => "uv",
        /// Normalised device coordinates: two across the image.
        Ndc = 2 => "ndc",
    }

    /// Sign of `motion`.
    #[derive(Default)]
    pub enum MotionDirection {
        /// Previous position minus current position.
        #[default]
        PreviousMinusCurrent = 0 => "previous_minus_current",
        /// Current position minus previous position.
        CurrentMinusPrevious = 1 => "current_minus_previous",
    }

    /// Meaning of the z component of `motion` (2.5D motion).
    #[derive(Default)]
    pub enum MotionDepth {
        /// No depth: the previous depth is computed from the matrices. That is right for everything
        /// that does not move along the view axis by itself.
        #[default]
        None = 0 => "none",
        /// Previous linear depth minus current linear depth.
        Difference = 1 => "difference",
        /// The previous linear depth itself.
        Absolute = 2 => "absolute",
    }

    /// Direction in which the camera looks in view space.
    #[derive(Default)]
    pub enum ViewForward {
        /// View along −z (right-handed; OpenGL, glTF).
        #[default]
        NegativeZ = 0 => "negative_z",
        /// View along +z (left-handed; Direct3D).
        PositiveZ = 1 => "positive_z",
    }

    /// A channel of an image.
    #[derive(Default)]
    pub enum Channel {
        /// Red.
        #[default]
        R = 0 => "r",
        /// Green.
        G = 1 => "g",
        /// Blue.
        B = 2 => "b",
        /// Alpha.
        A = 3 => "a",
    }

    /// Encoding of `roughness`.
    #[derive(Default)]
    pub enum RoughnessEncoding {
        /// Perceptual roughness, 0 to 1, whose square is the α of GGX.
        #[default]
        Linear = 0 => "linear",
        /// The α of GGX, 0 to 1.
        Alpha = 1 => "alpha",
    }
}

macro_rules! conventions {
    (
        config { $($config:tt)+ }
        conventions { $($first:tt)+ }
        later_conventions { $($later:tt)+ }
        later_config { $($later_config:tt)+ }
    ) => {
        conventions! { $($first)+ $($later)+ }
    };
    ($($(#[doc = $doc:literal])+ $(@[$attribute:meta])* $name:ident: $of:ident $kind:ident $type:ty = $default:expr;)+) => {
        /// Encodings of your guides. Only the stage `import` knows them; after it there is one
        /// encoding.
        ///
        /// With the feature `serde`, a field that a file leaves out has its default.
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(default, deny_unknown_fields))]
        pub struct Conventions {
            $($(#[doc = $doc])+ $(#[$attribute])* pub $name: $type,)+
        }

        impl Default for Conventions {
            fn default() -> Self {
                Self { $($name: $default,)+ }
            }
        }

        impl Conventions {
            /// Every field.
            pub const FIELDS: &'static [ConfigField] =
                &[$(ConfigField {
                    name: stringify!($name),
                    doc: concat!($($doc, "\n"),+),
                    is_of_filter: is_of_filter!($of),
                    values: values!($kind $type),
                },)+];
        }
    };
}

crate::config_fields!(conventions);

impl Conventions {
    /// Checks the numbers among them.
    ///
    /// # Errors
    /// [`Error::Conventions`] for a `background_depth` that is not above 0, and a `motion_scale` that is no factor.
    pub fn validate(&self) -> Result<(), Error> {
        let Self { background_depth, motion_scale, .. } = *self;
        let refused = |name, given, allowed| Err(Error::Conventions { name, given, allowed });
        if background_depth.is_nan() || background_depth <= 0.0 {
            return refused("background_depth", background_depth, "a number above 0, or infinity where there is no such distance");
        }
        if !motion_scale.is_normal() || motion_scale < 0.0 {
            return refused("motion_scale", motion_scale, "a number above 0, and the sign by motion_direction");
        }
        Ok(())
    }
}
