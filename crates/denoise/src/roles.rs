//! Roles that a channel can have for the denoiser, and the loss without it.

/// Meaning of one or more channels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Role {
    /// Radiance to denoise, all of it.
    Noisy,
    /// Coverage of the beauty, passed through.
    Alpha,
    /// All light that is filtered, as one signal, without the emission.
    Lighting,
    /// Light scattered once.
    Direct,
    /// Light scattered more than once.
    Indirect,
    /// Light that the base of surfaces reflects, without what their coat or metal does.
    Diffuse,
    /// Light that the coat or the metal of surfaces reflects.
    Specular,
    /// Specular light by lamps divided by [`Role::SpecularAlbedo`] (Blender's `GlossDir`).
    DemodulatedSpecularDirect,
    /// Other specular light divided by [`Role::SpecularAlbedo`] (Blender's `GlossInd`).
    DemodulatedSpecularIndirect,
    /// Reflectance of the coat or metal under light from everywhere (Blender's `GlossCol`).
    SpecularAlbedo,
    /// Distance from the first hit to what is seen in it.
    HitDistance,
    /// [`Role::Id`] of what is seen in it.
    HitId,
    /// Length of the way from the eye that goes on at mirrors and through glass, to the first surface that is neither.
    PathLength,
    /// Where that thing was, minus where it is.
    HitMotion,
    /// Emitters and environment seen directly, without noise.
    Emission,
    /// A further emission that is added to the first (Blender's `Env`).
    Environment,
    /// An environment that a transparent film leaves out of the picture, but not out of Blender's albedo for denoisers.
    HiddenEnvironment,
    /// Direct light divided by the albedo (Blender's `DiffDir`); multiplied by [`Role::DiffuseColour`] it is direct light.
    DemodulatedDirect,
    /// The divisor of [`Role::DemodulatedDirect`].
    DiffuseColour,
    /// Diffuse reflectance at the first hit.
    Albedo,
    /// Shading normal.
    Normal,
    /// Normal in the space of the object, by which a turning object keeps its history.
    ObjectNormal,
    /// Depth.
    Depth,
    /// World-space position of the first hit.
    Position,
    /// Motion, 2D.
    Motion,
    /// The third component of the motion, as the conventions say.
    MotionDepth,
    /// View depth of the surface point in the previous frame's camera.
    PreviousDepth,
    /// Stable id per instance.
    Id,
    /// A number per instance that may be another in the next frame.
    Shape,
    /// Class of the material at the first hit.
    MaterialClass,
    /// Roughness at the first hit.
    Roughness,
    /// Converged image, for the score.
    Reference,
    /// Previous frame's direct samples, shaded again in this frame's scene.
    ReshadeDirect,
    /// Previous frame's indirect samples, likewise.
    ReshadeIndirect,
    /// Previous frame's emission, likewise.
    ReshadeEmission,
    /// All of the previous frame's samples in this frame's scene, as one.
    Reshaded,
    /// Motion from the previous frame to this one, at the pixels of the previous frame; z: depth in this frame.
    ForwardMotion,
    /// A host's own differences of luminance δ and the larger luminance Δ, one pixel a stratum, in the top left corner.
    SparseGradient,
    /// A host's own confidence in the history.
    Confidence,
    /// The output of another denoiser, for the preset `stabilize`.
    OtherDenoised,
    /// Light that a medium scattered towards the eye, apart from the surfaces.
    Volume,
    /// A further part of it that is added to the first (Blender's `VolumeInd`).
    VolumeIndirect,
    /// Depth at which it did.
    ScatteringDepth,
    /// Whether rays into the hemisphere hit nothing.
    Ambient,
    /// How far away is what they hit.
    AmbientDistance,
    /// Visibility of a light, 0 to 3, apart from the paths.
    Visibility(usize),
    /// How far along the shadow ray to that light something is in the way.
    OccluderDistance(usize),
    /// [`Role::Id`] of that thing.
    OccluderId(usize),
    /// Where it was, minus where it is.
    OccluderMotion(usize),
    /// What that light would give the surface if nothing were.
    UnshadowedDirect(usize),
}

/// Number and type of the components of a role.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// R, G, B; half or float.
    Colour,
    /// X, Y, Z; half or float.
    Vector,
    /// X, Y; half or float.
    Motion,
    /// One half or float.
    Scalar,
    /// One integer, stored as any type.
    Id,
}

impl Kind {
    /// Numbers per pixel.
    pub const fn components(self) -> usize {
        match self {
            Self::Colour | Self::Vector => 3,
            Self::Motion => 2,
            Self::Scalar | Self::Id => 1,
        }
    }
}

/// One row: role, name for options and messages, kind, and what is lost without it (empty: nothing worth a word).
const ROLES: &[(Role, &str, Kind, &str)] = &[
    (Role::Noisy, "noisy", Kind::Colour, ""),
    (Role::Alpha, "alpha", Kind::Scalar, ""),
    (Role::Lighting, "lighting", Kind::Colour, ""),
    (Role::Direct, "direct", Kind::Colour, ""),
    (Role::Indirect, "indirect", Kind::Colour, "direct and indirect light are filtered together, which blurs shadow edges more"),
    (Role::Diffuse, "diffuse", Kind::Colour, ""),
    (Role::Specular, "specular", Kind::Colour, ""),
    (Role::DemodulatedSpecularDirect, "demodulated_specular_direct", Kind::Colour, ""),
    (Role::DemodulatedSpecularIndirect, "demodulated_specular_indirect", Kind::Colour, ""),
    (Role::SpecularAlbedo, "specular_albedo", Kind::Colour, ""),
    (Role::HitDistance, "hit_distance", Kind::Scalar, ""),
    (Role::HitId, "hit_id", Kind::Id, ""),
    (Role::PathLength, "path_length", Kind::Scalar, ""),
    (Role::HitMotion, "specular_motion", Kind::Vector, ""),
    (Role::Emission, "emission", Kind::Colour, "lights and sky are filtered with everything else instead of passing through"),
    (Role::Environment, "environment", Kind::Colour, ""),
    (Role::HiddenEnvironment, "hidden_environment", Kind::Colour, ""),
    (Role::DemodulatedDirect, "demodulated_direct", Kind::Colour, ""),
    (Role::DiffuseColour, "diffuse_colour", Kind::Colour, ""),
    (Role::Albedo, "albedo", Kind::Colour, "textures are blurred together with the light"),
    (Role::Normal, "normal", Kind::Vector, "light bleeds across creases, where only the orientation of the surface changes"),
    (Role::ObjectNormal, "object_normal", Kind::Vector, ""),
    (
        Role::Depth,
        "depth",
        Kind::Scalar,
        "light bleeds across silhouettes, and uncovered surfaces keep the history of what hid them",
    ),
    (Role::Position, "position", Kind::Vector, ""),
    (Role::Motion, "motion", Kind::Motion, ""),
    (Role::MotionDepth, "motion_depth", Kind::Scalar, ""),
    (Role::PreviousDepth, "previous_depth", Kind::Scalar, ""),
    (Role::Id, "id", Kind::Id, "objects at equal depth and orientation are not told apart in the history"),
    (Role::Shape, "shape", Kind::Id, ""),
    (Role::MaterialClass, "material_class", Kind::Id, ""),
    (Role::Roughness, "roughness", Kind::Scalar, ""),
    (Role::Reference, "reference", Kind::Colour, ""),
    (Role::ReshadeDirect, "reshade_direct", Kind::Colour, ""),
    (Role::ReshadeIndirect, "reshade_indirect", Kind::Colour, ""),
    (Role::ReshadeEmission, "reshade_emission", Kind::Colour, ""),
    (Role::Reshaded, "reshaded", Kind::Colour, ""),
    (Role::ForwardMotion, "forward_motion", Kind::Vector, ""),
    (Role::SparseGradient, "sparse_gradient", Kind::Motion, ""),
    (Role::Confidence, "confidence", Kind::Scalar, ""),
    (Role::OtherDenoised, "other_denoised", Kind::Colour, ""),
    (Role::Volume, "volume", Kind::Colour, ""),
    (Role::VolumeIndirect, "volume_indirect", Kind::Colour, ""),
    (Role::ScatteringDepth, "scattering_depth", Kind::Scalar, ""),
    (Role::Ambient, "ambient", Kind::Scalar, ""),
    (Role::AmbientDistance, "ambient_distance", Kind::Scalar, ""),
    (Role::Visibility(0), "visibility", Kind::Colour, ""),
    (Role::OccluderDistance(0), "occluder_distance", Kind::Scalar, ""),
    (Role::OccluderId(0), "occluder_id", Kind::Id, ""),
    (Role::OccluderMotion(0), "occluder_motion", Kind::Vector, ""),
    (Role::UnshadowedDirect(0), "unshadowed_direct", Kind::Colour, ""),
    (Role::Visibility(1), "visibility_1", Kind::Colour, ""),
    (Role::OccluderDistance(1), "occluder_distance_1", Kind::Scalar, ""),
    (Role::OccluderId(1), "occluder_id_1", Kind::Id, ""),
    (Role::OccluderMotion(1), "occluder_motion_1", Kind::Vector, ""),
    (Role::UnshadowedDirect(1), "unshadowed_direct_1", Kind::Colour, ""),
    (Role::Visibility(2), "visibility_2", Kind::Colour, ""),
    (Role::OccluderDistance(2), "occluder_distance_2", Kind::Scalar, ""),
    (Role::OccluderId(2), "occluder_id_2", Kind::Id, ""),
    (Role::OccluderMotion(2), "occluder_motion_2", Kind::Vector, ""),
    (Role::UnshadowedDirect(2), "unshadowed_direct_2", Kind::Colour, ""),
    (Role::Visibility(3), "visibility_3", Kind::Colour, ""),
    (Role::OccluderDistance(3), "occluder_distance_3", Kind::Scalar, ""),
    (Role::OccluderId(3), "occluder_id_3", Kind::Id, ""),
    (Role::OccluderMotion(3), "occluder_motion_3", Kind::Vector, ""),
    (Role::UnshadowedDirect(3), "unshadowed_direct_3", Kind::Colour, ""),
];

impl Role {
    /// All roles.
    pub fn all() -> impl Iterator<Item = Self> {
        ROLES.iter().map(|r| r.0)
    }

    fn row(self) -> &'static (Self, &'static str, Kind, &'static str) {
        // Every role has a row: a test walks them.
        ROLES.iter().find(|r| r.0 == self).unwrap_or(&ROLES[0])
    }

    /// Name for options and messages.
    pub fn name(self) -> &'static str {
        self.row().1
    }

    /// Numbers per pixel.
    pub fn kind(self) -> Kind {
        self.row().2
    }

    /// The loss without the role.
    pub fn loss(self) -> &'static str {
        self.row().3
    }

    /// The value of pixels that have none, where that is not 0: white takes nothing out of the light.
    pub fn stand_in(self) -> Option<f32> {
        matches!(self, Self::Albedo | Self::DiffuseColour | Self::SpecularAlbedo).then_some(1.0)
    }

    /// A role by its name.
    pub fn by_name(name: &str) -> Option<Self> {
        ROLES.iter().find(|r| r.1 == name).map(|r| r.0)
    }
}
