//! Edge stopping of specular light: no tap counts that lies outside of what the lobe of the surface blurs.

use crate::reference::guide::{unpack_guide, Surface};
use crate::reference::reflection::{lobe_radius, lobe_width, mirror_share, nearness, unpack_reflection};
use crate::reference::Image;
use crate::{FrameConstants, Tuning};
use glam::{IVec2, Vec3};

/// Where no hit distance is known, the most that a deviation around counts, over the own one, unless light is rare there.
const UNKNOWN_SHARE: f32 = 1.5;

/// Sharpness of the weights of a pixel, and what they compare.
#[derive(Clone, Copy, Default)]
struct Lobe {
    normal: Vec3,
    /// 0 where no hit distance is known.
    nearness: f32,
    /// Per squared pixel.
    spatial: f32,
    /// Per squared difference of normals, halved.
    normals: f32,
    /// Per squared difference of nearness.
    distances: f32,
}

/// The lobes of all pixels.
pub(super) struct Lobes(Image<Lobe>);

impl Lobes {
    pub(crate) fn new(frame: &FrameConstants, tuning: &Tuning, guide: &Image<[u16; 4]>, reflection: &Image<u32>) -> Self {
        Self(Image::compute(guide.extent(), frame.render_extent, |p| {
            lobe(frame, tuning, &unpack_guide(guide.at(p)), reflection.at(p))
        }))
    }

    /// The largest deviation that counts around the pixel `p`, whose own is given, where light is not rare.
    pub(crate) fn tolerated(&self, p: IVec2, deviation: f32) -> f32 {
        if self.0.at(p).nearness > 0.0 {
            f32::INFINITY
        } else {
            UNKNOWN_SHARE * deviation
        }
    }

    /// The weight of the pixel `q` for the pixel `p`; 1 for itself.
    pub(crate) fn weight(&self, p: IVec2, q: IVec2) -> f32 {
        let (centre, tap) = (self.0.at(p), self.0.at(q));
        let apart = (q - p).as_vec2().length_squared() * centre.spatial;
        let turned = 0.5 * (centre.normal - tap.normal).length_squared() * centre.normals;
        let beyond = (centre.nearness - tap.nearness).powi(2) * centre.distances;
        (-(apart + turned + beyond)).exp()
    }
}

fn lobe(frame: &FrameConstants, tuning: &Tuning, surface: &Surface, texel: u32) -> Lobe {
    if surface.is_background() {
        return Lobe::default();
    }
    let seen = unpack_reflection(texel);
    let (share, width) = (mirror_share(seen.roughness), lobe_width(seen.roughness));
    let radius = (tuning.specular_blur * lobe_radius(frame, surface.linear_depth, seen)).max(0.01);
    Lobe {
        normal: surface.normal.into(),
        nearness: nearness(surface.linear_depth, seen.hit_distance),
        spatial: 0.5 * share / (radius * radius),
        normals: share / (width * width + 1e-3),
        distances: if seen.hit_distance > 0.0 { 4.0 * share / (width * width + 0.02) } else { 0.0 },
    }
}
