//! The part of an image that exists in a frame.

use glam::{IVec2, Vec2};

/// The top left part of an image that a frame renders; pixels outside do not exist.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RenderRect {
    extent: IVec2,
}

impl RenderRect {
    pub(crate) fn new(extent: [u32; 2]) -> Self {
        Self { extent: IVec2::new(extent[0] as i32, extent[1] as i32) }
    }

    pub(crate) fn contains(&self, p: IVec2) -> bool {
        p.cmpge(IVec2::ZERO).all() && p.cmplt(self.extent).all()
    }

    /// Whether a position, in pixels with centres at .5, is inside.
    pub(crate) fn contains_position(&self, s: Vec2) -> bool {
        s.cmpge(Vec2::ZERO).all() && s.cmplt(self.extent.as_vec2()).all()
    }

    /// The pixel at the lower right.
    pub(crate) fn last(&self) -> IVec2 {
        self.extent - 1
    }

    pub(crate) fn clamp(&self, p: IVec2) -> IVec2 {
        p.clamp(IVec2::ZERO, self.extent - 1)
    }

    /// The four cells of `size` × `size` pixels whose centres are nearest to a pixel, where this is a rectangle of cells, with bilinear
    /// weights; beyond the edge the last cell stands in.
    pub(crate) fn cells_around(&self, p: IVec2, size: u32) -> [(IVec2, f32); 4] {
        let position = (p.as_vec2() + 0.5) / size as f32 - 0.5;
        let corner = position.floor();
        let f = position - corner;
        [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(x, y)| {
            let weight = (if x == 0 { 1.0 - f.x } else { f.x }) * (if y == 0 { 1.0 - f.y } else { f.y });
            (self.clamp(corner.as_ivec2() + IVec2::new(x, y)), weight)
        })
    }

    /// Offsets and pixels of the window of `2·radius + 1` taps a side, spaced `step`, that exist; in row order.
    pub(crate) fn window(self, p: IVec2, radius: i32, step: i32) -> impl Iterator<Item = (IVec2, IVec2)> {
        (-radius..=radius)
            .flat_map(move |y| (-radius..=radius).map(move |x| IVec2::new(x, y)))
            .map(move |offset| (offset, p + offset * step))
            .filter(move |(_, q)| self.contains(*q))
    }
}
