//! Visibility of one light: its packing, and lengths on a surface.

use super::projection::pixel_size;
use crate::FrameConstants;
use glam::Vec2;

/// A pixel of `visibility_history`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct VisibilityHistory {
    /// Share of the light that is seen, 0 to 1, over the history.
    pub mean: f32,
    /// Standard deviation of a sample, 0 to 0.5.
    pub deviation: f32,
    /// Frames accumulated, 1 to 63.
    pub history_length: f32,
    /// Distance of what is in the way, scene units; 0: nothing is.
    pub occluder_distance: f32,
}

/// The longest history that fits.
pub(crate) const LONGEST_HISTORY: f32 = 63.0;

/// A texel of `visibility_history`.
pub(crate) fn pack_visibility(h: &VisibilityHistory) -> u32 {
    let round = |x: f32| (x + 0.5).floor() as u32;
    let distance = match h.occluder_distance > 0.0 {
        true => round((h.occluder_distance.log2() * 8.0 + 97.0).clamp(0.5, 255.0)),
        false => 0,
    };
    let mean = round(h.mean.clamp(0.0, 1.0) * 4095.0);
    let deviation = round(h.deviation.clamp(0.0, 0.5) * 126.0);
    mean | deviation << 12 | round(h.history_length.clamp(1.0, LONGEST_HISTORY)) << 18 | distance << 24
}

/// The content of a texel of `visibility_history`.
pub(crate) fn unpack_visibility(texel: u32) -> VisibilityHistory {
    let steps = texel >> 24;
    VisibilityHistory {
        mean: (texel & 0xfff) as f32 / 4095.0,
        deviation: (texel >> 12 & 0x3f) as f32 / 126.0,
        history_length: (texel >> 18 & 0x3f) as f32,
        occluder_distance: if steps == 0 { 0.0 } else { ((steps as f32 - 97.0) / 8.0).exp2() },
    }
}

/// Lengths on the surface of a pixel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ruler {
    /// Scene units from one pixel to the next, across and down, where a surface faces the camera.
    pub size: Vec2,
    gradient: Vec2,
}

impl Ruler {
    /// `gradient`: change of depth from a pixel to the next.
    pub(crate) fn new(frame: &FrameConstants, linear_depth: f32, gradient: [f32; 2]) -> Self {
        let size = pixel_size(frame, linear_depth);
        Self { size, gradient: gradient.into() }
    }

    /// The longer side of a pixel.
    pub(crate) fn longer(&self) -> f32 {
        self.size.max_element()
    }

    /// Squared distance of two places that lie so many pixels apart.
    pub(crate) fn squared(&self, offset: Vec2) -> f32 {
        (self.size * offset).length_squared() + self.gradient.dot(offset).powi(2)
    }

    /// The variance of a look between pixels, squared scene units; `f`: how far between them.
    pub(crate) fn blur(&self, f: Vec2) -> f32 {
        (f * (1.0 - f)).dot(self.squared_lengths())
    }

    /// Of the ways from a pixel to the next on the surface.
    pub(crate) fn squared_lengths(&self) -> Vec2 {
        self.size * self.size + self.gradient * self.gradient
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::test_scene::*;
    use glam::Vec3;

    #[test]
    fn a_history_survives_packing() {
        for (mean, deviation, history_length, occluder_distance) in
            [(0.0, 0.0, 1.0, 0.0), (1.0, 0.5, 63.0, 1.0), (0.25, 0.125, 7.0, 100.0), (0.5, 0.25, 10.0, 0.01)]
        {
            let h = unpack_visibility(pack_visibility(&VisibilityHistory { mean, deviation, history_length, occluder_distance }));
            assert!((h.mean - mean).abs() < 2e-4 && (h.deviation - deviation).abs() < 5e-3, "{h:?}");
            assert_eq!(h.history_length, history_length);
            assert!((h.occluder_distance - occluder_distance).abs() <= 0.05 * occluder_distance, "{h:?} {occluder_distance}");
        }
    }

    #[test]
    fn what_does_not_fit_saturates() {
        let far = VisibilityHistory { mean: 7.0, deviation: 3.0, history_length: 1e9, occluder_distance: 1e30 };
        let h = unpack_visibility(pack_visibility(&far));
        assert_eq!((h.mean, h.deviation, h.history_length), (1.0, 0.5, 63.0));
        assert!(h.occluder_distance > 65504.0);
        let near = unpack_visibility(pack_visibility(&VisibilityHistory { occluder_distance: 1e-9, ..far }));
        assert!(near.occluder_distance > 0.0 && near.occluder_distance < 1e-3);
    }

    #[test]
    fn a_pixel_is_longer_far_away_and_where_the_surface_recedes() {
        let extent = [64, 32];
        let view = camera(extent, Vec3::ZERO);
        let frame = frame_with(&crate::Config::new(extent), &view, &view);
        let near = Ruler::new(&frame, 1.0, [0.0; 2]);
        // 90 degrees from top to bottom: two scene units at depth 1.
        assert!((near.size.y - 2.0 / 32.0).abs() < 1e-6 && (near.size.x - near.size.y).abs() < 1e-6, "{near:?}");
        let far = Ruler::new(&frame, 10.0, [0.0, 1.0]);
        assert!((far.size.y - 20.0 / 32.0).abs() < 1e-5);
        assert!((far.squared(Vec2::Y) - (far.size.y * far.size.y + 1.0)).abs() < 1e-5);
        assert!((far.squared(Vec2::X) - far.size.x * far.size.x).abs() < 1e-5);
    }
}
