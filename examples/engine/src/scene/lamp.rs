//! Light that does not come from meshes.

use glam::{Affine3A, Vec3};

/// A light that no ray can hit by chance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lamp {
    /// Parallel light from a small disc in the sky.
    Sun {
        /// Unit vector towards it.
        direction: Vec3,
        /// On a surface that faces it.
        irradiance: Vec3,
        /// Sine of the disc's angular radius.
        radius: f32,
    },
    /// A ball that shines as a point does, or a spot.
    Point {
        /// Where it is.
        position: Vec3,
        /// What shadows see of it, scene units; 0: a point.
        radius: f32,
        /// Radiant intensity.
        intensity: Vec3,
        /// Where a spot shines, and the cosines of its inner and outer angle.
        spot: Option<(Vec3, f32, f32)>,
    },
}

impl Lamp {
    /// Where it is, homogeneous: the direction towards a sun has w 0.
    pub fn place(&self) -> [f32; 4] {
        match *self {
            Self::Sun { direction, .. } => direction.extend(0.0).to_array(),
            Self::Point { position, .. } => position.extend(1.0).to_array(),
        }
    }

    /// The same after a movement.
    pub(super) fn moved(self, by: &Affine3A) -> Self {
        match self {
            Self::Sun { direction, irradiance, radius } => {
                Self::Sun { direction: by.transform_vector3(direction).normalize(), irradiance, radius }
            }
            Self::Point { position, radius, intensity, spot } => {
                let turned = |(axis, inner, outer)| (by.transform_vector3(axis).normalize(), inner, outer);
                Self::Point { position: by.transform_point3(position), radius, intensity, spot: spot.map(turned) }
            }
        }
    }
}

/// Light from everywhere, as a gradient. All black: none.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Environment {
    /// Radiance from above.
    pub zenith: Vec3,
    /// Radiance from the side.
    pub horizon: Vec3,
    /// Radiance from below.
    pub ground: Vec3,
}
