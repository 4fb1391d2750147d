//! Counters of bad input.

/// Counters, indexed by [`Counter`].
pub type Statistics = [u32; 12];

/// Kinds of bad input, counted in pixels of the render extent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(usize)]
pub enum Counter {
    /// A depth that is NaN.
    Depth = 0,
    /// A normal that is not finite, on a surface.
    Normal = 1,
    /// A motion that is not finite.
    Motion = 2,
    /// A radiance that is not finite; once for every signal.
    Radiance = 3,
    /// An albedo that is not finite, on a surface.
    Albedo = 4,
    /// An emission that is not finite.
    Emission = 5,
    /// A forward motion that is not finite; once for every candidate that needs it.
    ForwardMotion = 6,
    /// A scattering depth that is NaN.
    ScatteringDepth = 7,
    /// A roughness that is not finite or not from 0 to 1, on a surface.
    Roughness = 8,
    /// A hit distance that is NaN or negative, on a surface.
    HitDistance = 9,
    /// A visibility that is not finite, or outside of 0 to 1, on a surface.
    Visibility = 10,
    /// A distance of an occluder that is NaN or negative, on a surface.
    OccluderDistance = 11,
}

/// Counts the texels that are true.
pub(crate) fn count(flags: impl Iterator<Item = bool>) -> u32 {
    flags.filter(|&bad| bad).count() as u32
}
