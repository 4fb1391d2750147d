//! Encodings of a host's depth, normals and motion.

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
        /// No depth: the previous depth is computed from the matrices, which is right for what does not move along the view axis by
        /// itself.
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

/// Encodings of the host's guides. Only the stage `import` knows them; behind it there is one encoding.
///
/// With the feature `serde`, what a file leaves out has its default.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(default, deny_unknown_fields))]
pub struct Conventions {
    /// Encoding of depth. Default: [`DepthEncoding::Linear`].
    pub depth: DepthEncoding,
    /// Linear depths from here on are background, as are those from 1e15 on; above 0. Default: infinity, which a file has as `"inf"`.
    #[cfg_attr(feature = "serde", serde(with = "super::serde_forms::distance"))]
    pub background_depth: f32,
    /// Encoding of normals. Default: [`NormalEncoding::Xyz`].
    pub normal: NormalEncoding,
    /// Space of the normals. Default: [`NormalSpace::World`].
    pub normal_space: NormalSpace,
    /// Unit of the motion. Default: [`MotionUnit::Uv`].
    pub motion_unit: MotionUnit,
    /// Sign of the motion. Default: [`MotionDirection::PreviousMinusCurrent`].
    pub motion_direction: MotionDirection,
    /// Whether y of the motion points up. A file has it as `motion_y`, `"up"` or `"down"`. Default: false.
    #[cfg_attr(feature = "serde", serde(rename = "motion_y", alias = "motion_y_up", with = "super::serde_forms::up"))]
    pub motion_y_up: bool,
    /// Whether the motion includes the change of jitter. Default: false.
    pub motion_jittered: bool,
    /// Meaning of z of the motion. Default: [`MotionDepth::None`].
    pub motion_depth: MotionDepth,
    /// Direction in which the camera looks. Default: [`ViewForward::NegativeZ`].
    pub view_forward: ViewForward,
    /// Encoding of roughness. Default: [`RoughnessEncoding::Linear`].
    pub roughness: RoughnessEncoding,
}

impl Default for Conventions {
    fn default() -> Self {
        Self {
            depth: DepthEncoding::default(),
            background_depth: f32::INFINITY,
            normal: NormalEncoding::default(),
            normal_space: NormalSpace::default(),
            motion_unit: MotionUnit::default(),
            motion_direction: MotionDirection::default(),
            motion_y_up: false,
            motion_jittered: false,
            motion_depth: MotionDepth::default(),
            view_forward: ViewForward::default(),
            roughness: RoughnessEncoding::default(),
        }
    }
}

impl Conventions {
    /// Checks the one number among them.
    ///
    /// # Errors
    /// [`Error::Conventions`] for a `background_depth` that is not above 0.
    pub fn validate(&self) -> Result<(), Error> {
        let given = self.background_depth;
        (given > 0.0).then_some(()).ok_or(Error::Conventions { name: "background_depth", given })
    }
}
