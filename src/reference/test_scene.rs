//! Scenes that the tests of the twins have in common.

use super::*;
use crate::config::Preset;
use crate::{Config, Counter, Flags, FrameConstants, FrameParams, FrameState, Statistics, Tuning};
use glam::{Mat4, Vec3};

/// The numbers of SVGF, for which the tests say what has to come out.
pub(crate) fn svgf_tuning() -> Tuning {
    Tuning::for_preset(Preset::Svgf)
}

/// A frame with history behind it, default conventions, identity matrices.
pub(crate) fn frame(extent: [u32; 2]) -> FrameConstants {
    frame_with(&Config::new(extent), &FrameParams::new(extent), &FrameParams::new(extent))
}

/// The second of two frames.
pub(crate) fn frame_with(config: &Config, before: &FrameParams, now: &FrameParams) -> FrameConstants {
    let mut state = FrameState::default();
    state.begin(&config.setup(), before, &svgf_tuning()).expect("first frame");
    state.begin(&config.setup(), now, &svgf_tuning()).expect("second frame").constants
}

/// The frame as one that drops all history.
pub(crate) fn reset(frame: FrameConstants) -> FrameConstants {
    FrameConstants { flags: frame.flags | Flags::RESET, ..frame }
}

/// A perspective camera at a position, looking along −z; 90 degrees from top to bottom, near plane 0.1, far plane 100.
pub(crate) fn camera(extent: [u32; 2], position: Vec3) -> FrameParams {
    FrameParams {
        view_from_world: Mat4::from_translation(-position).to_cols_array_2d(),
        clip_from_view: perspective(extent).to_cols_array_2d(),
        ..FrameParams::new(extent)
    }
}

/// Looks along −z; depth 0..1, y down.
pub(crate) fn perspective(extent: [u32; 2]) -> Mat4 {
    let (near, far) = (0.1, 100.0);
    Mat4::from_cols_array_2d(&[
        [extent[1] as f32 / extent[0] as f32, 0.0, 0.0, 0.0],
        [0.0, -1.0, 0.0, 0.0],
        [0.0, 0.0, far / (near - far), -1.0],
        [0.0, 0.0, near * far / (near - far), 0.0],
    ])
}

/// Packed guides of surfaces that do not move.
#[derive(Clone)]
pub(crate) struct Guides {
    pub guide: Image<[u16; 4]>,
    pub surface_motion: Image<[u16; 4]>,
}

pub(crate) fn surface(linear_depth: f32) -> Surface {
    Surface { linear_depth, is_apart: false, normal: [0.0, 0.0, 1.0], gradient: [0.0; 2], id: 1 }
}

/// `surfaces(x, y)` without motion and with a gradient of 0.
pub(crate) fn guides(extent: [u32; 2], surfaces: impl Fn(i32, i32) -> Surface) -> Guides {
    let surfaces = paint(extent, surfaces);
    Guides {
        guide: surfaces.map(pack_guide),
        surface_motion: surfaces.map(|s| pack_surface_motion([0.0; 2], (!s.is_background()).then_some((0.0, s.normal)))),
    }
}

pub(crate) fn paint<T: Clone>(extent: [u32; 2], f: impl Fn(i32, i32) -> T) -> Image<T> {
    // Compiled once for a type of texels: hundreds of closures are painted.
    fn texels<T>(extent: [u32; 2], f: &dyn Fn(i32, i32) -> T) -> Vec<T> {
        let mut texels = Vec::new();
        for y in 0..extent[1] as i32 {
            for x in 0..extent[0] as i32 {
                texels.push(f(x, y));
            }
        }
        texels
    }
    Image::from_texels(extent, texels(extent, &f)).expect("as many texels as pixels")
}

/// Uniform in 0..1, grey, independent between pixels and seeds.
pub(crate) fn noise(extent: [u32; 2], seed: u32) -> Image<[f32; 4]> {
    paint(extent, |x, y| {
        let mut v = (x as u32) ^ (y as u32).rotate_left(16) ^ seed.wrapping_mul(0x9e37_79b9);
        for _ in 0..3 {
            v = (v ^ v >> 16).wrapping_mul(0x7feb_352d);
            v = (v ^ v >> 15).wrapping_mul(0x846c_a68b);
        }
        let l = (v >> 8) as f32 / (1 << 24) as f32;
        [l, l, l, 0.0]
    })
}

/// An image inside a larger one, with `fill` around it.
pub(crate) fn embed<T: Clone>(image: &Image<T>, extent: [u32; 2], fill: T) -> Image<T> {
    paint(extent, |x, y| image.get(x, y).unwrap_or(&fill).clone())
}

/// The top left of an image.
pub(crate) fn crop<T: Clone>(image: &Image<T>, extent: [u32; 2]) -> Image<T> {
    paint(extent, |x, y| image.get(x, y).expect("inside").clone())
}

/// Counters of which a few counted something.
pub(crate) fn counted(counts: &[(Counter, u32)]) -> Statistics {
    let mut statistics = Statistics::default();
    counts.iter().for_each(|(counter, count)| statistics[*counter] = *count);
    statistics
}

pub(crate) fn all_finite(image: &Image<[f32; 4]>) -> bool {
    image.texels().iter().flatten().all(|x| x.is_finite())
}
