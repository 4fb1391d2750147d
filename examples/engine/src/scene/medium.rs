//! Fog.

use glam::Vec3;

/// A homogeneous medium that fills everything.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Medium {
    /// Scattering coefficient, 1 / scene unit.
    pub scattering: Vec3,
    /// Extinction coefficient, scattering and absorption together, 1 / scene unit; the same for all colours.
    pub extinction: f32,
    /// Mean cosine of the scattering angle (Henyey and Greenstein 1941), −1 to 1: 0 scatters evenly, above it forwards.
    pub anisotropy: f32,
}
