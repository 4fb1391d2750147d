//! How a host encodes depth, normals and motion.

/// How `depth` is encoded.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u32)]
pub enum DepthEncoding {
    /// View-space depth along the view axis, positive, in scene units.
    #[default]
    Linear = 0,
    /// What a depth buffer holds. `FrameParams::clip_from_view` says how: reversed, infinite and orthographic projections all work.
    Device = 1,
    /// Distance from the camera to the surface along the ray.
    RayLength = 2,
}

/// How `normal` is encoded.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u32)]
pub enum NormalEncoding {
    /// xyz in −1..1; need not be of unit length.
    #[default]
    Xyz = 0,
    /// xyz stored as v·0.5 + 0.5.
    XyzUnorm = 1,
    /// Octahedral xy in −1..1.
    Octahedral = 2,
    /// Octahedral xy stored as v·0.5 + 0.5.
    OctahedralUnorm = 3,
}

/// In which space normals are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum NormalSpace {
    /// World space.
    #[default]
    World,
    /// View space of the current frame.
    View,
}

/// Unit of `motion`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u32)]
pub enum MotionUnit {
    /// Pixels of the render extent.
    Pixels = 0,
    /// Fractions of the render extent.
    #[default]
    Uv = 1,
    /// Normalised device coordinates: two across the image.
    Ndc = 2,
}

/// Sign of `motion`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MotionDirection {
    /// Previous position minus current position.
    #[default]
    PreviousMinusCurrent,
    /// Current position minus previous position.
    CurrentMinusPrevious,
}

/// What the z component of `motion` is (2.5D motion).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u32)]
pub enum MotionDepth {
    /// Nothing: the previous depth is computed from the matrices, which is right for what does not move along the view axis by itself.
    #[default]
    None = 0,
    /// Previous linear depth minus current linear depth.
    Difference = 1,
    /// The previous linear depth itself.
    Absolute = 2,
}

/// Which way the camera looks in view space.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ViewForward {
    /// Along −z (right-handed; OpenGL, glTF).
    #[default]
    NegativeZ,
    /// Along +z (left-handed; Direct3D).
    PositiveZ,
}

/// How the host encodes its guides. Only the stage `import` knows them; behind it there is one encoding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conventions {
    /// Depth.
    pub depth: DepthEncoding,
    /// Linear depths from here on are background. Default: infinity.
    pub background_depth: f32,
    /// Normal encoding.
    pub normal: NormalEncoding,
    /// Normal space.
    pub normal_space: NormalSpace,
    /// Motion unit.
    pub motion_unit: MotionUnit,
    /// Motion sign.
    pub motion_direction: MotionDirection,
    /// Whether y of the motion points up. Default: false.
    pub motion_y_up: bool,
    /// Whether the motion includes the change of jitter. Default: false.
    pub motion_jittered: bool,
    /// z of the motion.
    pub motion_depth: MotionDepth,
    /// View direction.
    pub view_forward: ViewForward,
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
        }
    }
}
