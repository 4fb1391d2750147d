//! The matrices by which `forward_project` carries a pixel of the previous frame to this one without a division.

use super::{double, FrameParams};
use crate::config::{Conventions, ViewForward};
use glam::{DMat2, DMat4, DVec2, DVec3, DVec4};

/// Computed in double precision: both matrices replace a chain of inverses in the shader.
#[derive(Clone, Copy, Debug)]
pub(super) struct ForwardProjection {
    /// World position from `(x·w, y·w, z, 1)`: x, y in pixels of the previous frame, z the linear depth, w as below.
    pub world_from_previous_sample: [[f32; 4]; 4],
    /// `(x·w, y·w, z, w)` in pixels of this frame from a world position.
    pub sample_from_world: [[f32; 4]; 4],
    /// `w = [0]·z + [1]`: w of the previous frame's clip space.
    pub previous_clip_w: [f32; 2],
}

impl ForwardProjection {
    /// `eye`: the origin of the world that shaders see.
    pub(crate) fn new(conventions: &Conventions, now: &FrameParams, before: &FrameParams, eye: DVec3) -> Self {
        let forward = match conventions.view_forward {
            ViewForward::NegativeZ => -1.0,
            ViewForward::PositiveZ => 1.0,
        };
        let clip_from_view = double(&before.clip_from_view);
        let row_w = clip_from_view.row(3);
        let world_from_view = DMat4::from_translation(-eye) * double(&before.view_from_world).inverse();
        let world_from_previous_sample = world_from_view * view_from_sample(before, clip_from_view, forward);
        let sample_from_world = sample_from_view(now, forward) * double(&now.view_from_world) * DMat4::from_translation(eye);
        Self {
            world_from_previous_sample: columns(world_from_previous_sample),
            sample_from_world: columns(sample_from_world),
            previous_clip_w: [(row_w.z * forward) as f32, row_w.w as f32],
        }
    }
}

/// Zeros, which lead nowhere, where a projection has no solution.
fn columns(m: DMat4) -> [[f32; 4]; 4] {
    let columns = m.to_cols_array_2d().map(|column| column.map(|x| x as f32));
    if columns.iter().flatten().all(|x| x.is_finite()) {
        columns
    } else {
        [[0.0; 4]; 4]
    }
}

/// View position from `(x·w, y·w, z, 1)`. Solves `clip.xy = ndc·w` for view x and y, which covers off-centre and orthographic
/// projections.
fn view_from_sample(params: &FrameParams, clip_from_view: DMat4, forward: f64) -> DMat4 {
    let [row_x, row_y, row_w] = [0, 1, 3].map(|i| clip_from_view.row(i));
    let across = DMat2::from_cols(DVec2::new(row_x.x, row_y.x), DVec2::new(row_x.y, row_y.y)).inverse();
    let extent = DVec2::new(params.render_extent[0].into(), params.render_extent[1].into());
    let jitter = DVec2::new(params.jitter[0].into(), params.jitter[1].into());
    // ndc·w = scale·(s·w) + shift·w, and w = row_w.z·forward·z + row_w.w.
    let (scale, shift) = (2.0 / extent, 2.0 * jitter / extent - 1.0);
    let of_z = shift * row_w.z * forward - DVec2::new(row_x.z, row_y.z) * forward;
    let of_one = shift * row_w.w - DVec2::new(row_x.w, row_y.w);
    let column = |xy: DVec2, z: f64, w: f64| DVec4::new(xy.x, xy.y, z, w);
    DMat4::from_cols(
        column(across * DVec2::new(scale.x, 0.0), 0.0, 0.0),
        column(across * DVec2::new(0.0, scale.y), 0.0, 0.0),
        column(across * of_z, forward, 0.0),
        column(across * of_one, 0.0, 1.0),
    )
}

/// `(x·w, y·w, z, w)` from a view position: x, y such that the sample of pixel p lies at p + 0.5.
fn sample_from_view(params: &FrameParams, forward: f64) -> DMat4 {
    let clip = double(&params.clip_from_view);
    let position = |i: usize| {
        let (side, jitter) = (f64::from(params.render_extent[i]), f64::from(params.jitter[i]));
        (clip.row(i) + clip.row(3)) * (0.5 * side) - clip.row(3) * jitter
    };
    DMat4::from_cols(position(0), position(1), DVec4::new(0.0, 0.0, forward, 0.0), clip.row(3)).transpose()
}
