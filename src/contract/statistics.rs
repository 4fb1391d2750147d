//! The counters of a frame: values that are not finite, surfaces that kept or lost their history, and noise that repeats.

use crate::choice::choices;
use crate::error::Error;
use std::ops::{Index, IndexMut};

choices! {
    /// The counters in the buffer `statistics`, in pixels of the render extent: 32-bit words, in
    /// the order of `glsl/include/statistics.glsl`.
    ///
    /// `temporal_accumulation` counts those from [`Self::HistoryKept`] to [`Self::LostNormal`], once for each
    /// accumulation of a graph. It counts nothing in the background, or in a frame with a reset.
    #[non_exhaustive]
    pub enum Counter {
        /// A depth that is NaN.
        Depth = 0 => "depth",
        /// A normal that is not finite, on a surface.
        Normal = 1 => "normal",
        /// A motion that is not finite.
        Motion = 2 => "motion",
        /// A radiance that is not finite; once for every signal.
        Radiance = 3 => "radiance",
        /// An albedo that is not finite, on a surface.
        Albedo = 4 => "albedo",
        /// An emission that is not finite.
        Emission = 5 => "emission",
        /// A forward motion that is not finite; once for every candidate that needs it.
        ForwardMotion = 6 => "forward_motion",
        /// A scattering depth that is NaN.
        ScatteringDepth = 7 => "scattering_depth",
        /// A roughness that is not finite or not from 0 to 1, on a surface, and not −1.
        Roughness = 8 => "roughness",
        /// A hit distance that is NaN or negative, on a surface, and not −1.
        HitDistance = 9 => "hit_distance",
        /// A visibility that is not finite, or outside 0 to 1, on a surface.
        Visibility = 10 => "visibility",
        /// A distance of an occluder that is NaN or negative, on a surface.
        OccluderDistance = 11 => "occluder_distance",
        /// A surface that found its history.
        HistoryKept = 12 => "history_kept",
        /// A surface without history: its motion leads out of the picture.
        LostOffScreen = 13 => "lost_off_screen",
        /// A surface without history: its motion leads to a different `surface_id` or to the
        /// background.
        LostSurfaceId = 14 => "lost_surface_id",
        /// A surface without history: its motion leads to a different depth.
        LostDepth = 15 => "lost_depth",
        /// A surface without history: its motion leads to a different normal.
        LostNormal = 16 => "lost_normal",
        /// Light above 65504, which a half float cannot hold: a signal as it comes into the filter, in the exposure of the filter, or the
        /// picture as it goes out, unless that is of 32-bit floats.
        Saturated = 17 => "saturated",
        /// A `specular_hit_id` without a transform: beyond the end of `instance_transforms`, or one that is not finite. Of surfaces whose
        /// hit distance is known, and not in a frame with a reset.
        HitId = 18 => "hit_id",
        /// An `occluder_id` without a transform, as [`Self::HitId`]. Of occluded surfaces, and not in a frame with a reset.
        OccluderId = 19 => "occluder_id",
        /// An `occluder_motion` that is not finite. Of occluded surfaces, and not in a frame with a reset.
        OccluderMotion = 20 => "occluder_motion",
        /// A `specular_motion` that is not finite, as [`Self::HitId`].
        SpecularMotion = 21 => "specular_motion",
        /// A `material_class` of 16 or above, on a surface; once for each accumulation of a graph.
        MaterialClass = 22 => "material_class",
        /// A surface whose noise comes again from frame to frame, so that averaging leaves it; once for every signal. Of surfaces with
        /// 8 frames of history, in presets with [`crate::nodes::Estimator::OfMean`].
        RepeatedSample = 23 => "repeated_sample",
    }
}

impl Counter {
    /// The reasons for which a surface has no history.
    pub const LOSSES: [Self; 4] = [Self::LostOffScreen, Self::LostSurfaceId, Self::LostDepth, Self::LostNormal];
}

/// Size of the buffer `statistics`.
pub(crate) const STATISTICS_BYTES: u64 = size_of::<Statistics>() as u64;

/// The counters of a frame, by [`Counter`]: the content of the buffer `statistics`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(transparent)]
pub struct Statistics([u32; Counter::ALL.len()]);

impl Statistics {
    /// Reads a copy of the buffer `statistics`.
    ///
    /// # Errors
    /// [`Error::Size`] if the size differs.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, Error> {
        bytemuck::try_pod_read_unaligned(bytes).map_err(|_| Error::Size {
            resource: "a copy of `statistics`".into(),
            given: format!("{} bytes", bytes.len()),
            needed: format!("{STATISTICS_BYTES} bytes"),
        })
    }

    /// The bytes of the buffer.
    pub fn as_bytes(&self) -> &[u8] {
        bytemuck::bytes_of(self)
    }

    /// Surfaces that looked for their history: 0 in a frame with a reset.
    pub fn history_sought(&self) -> u64 {
        u64::from(self[Counter::HistoryKept]) + self.history_lost()
    }

    /// Surfaces that did not find their history.
    pub fn history_lost(&self) -> u64 {
        Counter::LOSSES.iter().map(|&reason| u64::from(self[reason])).sum()
    }

    /// The sum of both, counter by counter.
    pub(crate) fn plus(&self, other: &Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i].wrapping_add(other.0[i])))
    }
}

impl Index<Counter> for Statistics {
    type Output = u32;

    fn index(&self, counter: Counter) -> &u32 {
        &self.0[counter as usize]
    }
}

impl IndexMut<Counter> for Statistics {
    fn index_mut(&mut self, counter: Counter) -> &mut u32 {
        &mut self.0[counter as usize]
    }
}
