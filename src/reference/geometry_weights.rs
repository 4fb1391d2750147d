//! Edge stopping by geometry, shared by all signals and by the stages `variance` and `atrous`.

use super::guide::{unpack_guide, Surface};
use super::material::tuning_at;
use super::volume::{relative_difference, volume_depth};
use super::Image;
use crate::{FrameConstants, Tuning};
use glam::{IVec2, Vec2, Vec3};

/// Tolerated relative departure from the local plane, by which a plane that faces the camera has a tolerance as well.
pub(crate) const DEPTH_EPSILON: f32 = 0.001;

/// The decoded guide with the weights `w_z` and `w_n`.
pub(crate) struct Geometry {
    surfaces: Image<Surface>,
    edges: Edges,
    sigma_l: f32,
    /// Those of each pixel, where materials have some of their own.
    materials: Option<Image<(Edges, f32)>>,
}

/// Edge stopping by geometry.
#[derive(Clone, Copy)]
enum Edges {
    Surface {
        sigma_z: f32,
        sigma_n: f32,
    },
    /// Depth alone, and less strictly; there is no background \[PSVGF\].
    Volume {
        sigma_z: f32,
    },
}

impl Default for Edges {
    fn default() -> Self {
        Self::Surface { sigma_z: 0.0, sigma_n: 0.0 }
    }
}

impl Edges {
    fn of_surfaces(tuning: &Tuning) -> Self {
        Self::Surface { sigma_z: tuning.sigma_z, sigma_n: tuning.sigma_n }
    }
}

impl Geometry {
    pub(crate) fn new(frame: &FrameConstants, tuning: &Tuning, guide: &Image<[u16; 4]>) -> Self {
        Self {
            surfaces: Image::compute(guide.extent(), frame.render_extent, |p| unpack_guide(guide.at(p))),
            edges: Edges::of_surfaces(tuning),
            sigma_l: tuning.sigma_l,
            materials: None,
        }
    }

    /// By the classes of materials.
    pub(crate) fn with_materials(mut self, frame: &FrameConstants, tuning: &Tuning, classes: &Image<u32>) -> Self {
        let of = |p| tuning_at(frame, tuning, Some(classes), p);
        let sigmas = |tuning: Tuning| (Edges::of_surfaces(&tuning), tuning.sigma_l);
        self.materials = Some(Image::compute(self.extent(), frame.render_extent, |p| sigmas(of(p))));
        self
    }

    /// The geometry of a volume before the surfaces of the guide.
    pub(crate) fn of_volume(frame: &FrameConstants, tuning: &Tuning, guide: &Image<[u16; 4]>) -> Self {
        let seen = |p| Surface { linear_depth: volume_depth(guide.at(p)), ..Surface::default() };
        Self {
            surfaces: Image::compute(guide.extent(), frame.render_extent, seen),
            edges: Edges::Volume { sigma_z: tuning.volume_sigma_z },
            sigma_l: tuning.sigma_l,
            materials: None,
        }
    }

    pub(crate) fn extent(&self) -> [u32; 2] {
        self.surfaces.extent()
    }

    fn edges(&self, p: IVec2) -> Edges {
        self.materials.as_ref().map_or(self.edges, |materials| materials.at(p).0)
    }

    /// Tolerated difference of luminance in standard deviations.
    pub(crate) fn sigma_l(&self, p: IVec2) -> f32 {
        self.materials.as_ref().map_or(self.sigma_l, |materials| materials.at(p).1)
    }

    pub(crate) fn is_background(&self, p: IVec2) -> bool {
        self.surfaces.at(p).is_background()
    }

    pub(crate) fn surface(&self, p: IVec2) -> Surface {
        self.surfaces.at(p)
    }

    /// `w_z·w_n` \[SVGF eq. 3, 4\] of a pixel `q` inside the image for the surface pixel `p`; 1 for `q = p`, 0 for the
    /// background, and for a surface whose light is kept apart where that of `p` is not, or the other way round.
    pub(crate) fn weight(&self, p: IVec2, q: IVec2) -> f32 {
        let is_alike =
            matches!(self.edges(p), Edges::Volume { .. }) || self.surfaces.at(p).is_apart == self.surfaces.at(q).is_apart;
        if is_alike {
            self.weight_of_shape(p, q)
        } else {
            0.0
        }
    }

    /// The same, whatever the albedo of either: for what is no light of a surface, such as its visibility.
    pub(crate) fn weight_of_shape(&self, p: IVec2, q: IVec2) -> f32 {
        if p == q {
            return 1.0;
        }
        let (at_p, at_q) = (self.surfaces.at(p), self.surfaces.at(q));
        if at_q.is_background() {
            return 0.0;
        }
        match self.edges(p) {
            Edges::Surface { sigma_z, sigma_n } => {
                let offset = (q - p).as_vec2();
                depth_and_normal_weight([sigma_z, sigma_n], &at_p, &at_q, offset)
            }
            Edges::Volume { sigma_z } => (-relative_difference(at_p.linear_depth, at_q.linear_depth) / sigma_z).exp(),
        }
    }
}

/// `w_z·w_n` of two surfaces that lie `offset` pixels apart.
pub(crate) fn depth_and_normal_weight([sigma_z, sigma_n]: [f32; 2], p: &Surface, q: &Surface, offset: Vec2) -> f32 {
    let tolerance = sigma_z * Vec2::from(p.gradient).dot(offset).abs() + DEPTH_EPSILON * p.linear_depth;
    let difference = (p.linear_depth - q.linear_depth).abs();
    let exponent_z = -difference / tolerance.max(f32::MIN_POSITIVE);
    // 1 − cos of two unit normals is half of their squared distance.
    let exponent_n = -sigma_n * 0.5 * Vec3::from(p.normal).distance_squared(q.normal.into());
    (exponent_z + exponent_n).exp()
}
