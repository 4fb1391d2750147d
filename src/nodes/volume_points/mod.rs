//! Takes in the light that a volume scatters towards the camera, and its places. \[PSVGF\], volumes.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::pass;
use crate::contract::{Input, Lifetime};
use crate::graph::{Graph, Image, Port, Radiance, VolumeRadiance, HDR, PACKED_64};
use crate::shaders;

/// A volume of yours: fog, smoke, light shafts.
#[derive(Clone, Copy, Debug)]
pub struct Volume {
    pub(super) noisy: Radiance,
    /// One point a pixel for the next frame: depth and contribution.
    pub(super) points: Image,
}

impl Volume {
    /// Your noisy radiance.
    pub fn noisy(&self) -> Radiance {
        self.noisy
    }
}

impl Graph {
    /// A volume of yours: its input `noisy_volume`, and the points of the previous frame that give
    /// it motion.
    pub fn volume(&mut self) -> Volume {
        let noisy = self.radiance("noisy_volume");
        Volume { noisy, points: self.named_image("volume_points", "", PACKED_64, 1, Lifetime::HistoryInPlace) }
    }

    /// Radiance of a volume, with its points for the next frame from the optional input `scattering_depth`. Behind the node
    /// `volume_motion`, which reads the points of the previous frame.
    pub fn volume_points(&mut self, volume: &Volume) -> VolumeRadiance {
        let node = self.node("volume_points", "");
        let label = self.label(volume.noisy.image()).to_owned();
        let radiance = self.named_image("irradiance", &label, HDR, 1, Lifetime::Transient);
        let pass = pass(&node, &shaders::VOLUME_POINTS)
            .bind("noisy_volume", volume.noisy.image())
            .bind("scattering_depth", self.input(Input::SCATTERING_DEPTH))
            .bind("radiance", radiance)
            .bind("volume_points", volume.points);
        self.add(pass);
        Port::of(self.refreshed(radiance))
    }
}
