//! When two pictures count as equal.

use super::Captured;
use crate::support::pixels;
use atrous::reference::{Image, BLOCK_SIZE};

/// Half floats have 11 bits and devices round them either way: two steps, and next to nothing near zero.
pub const HALF: Tolerance = Tolerance { relative: 1.5e-3, absolute: 2e-5, outliers: 0.0 };

/// What two values may differ by, and what share of pixels may differ by more, since a test against a threshold fell the other way.
#[derive(Clone, Copy)]
pub struct Tolerance {
    pub relative: f32,
    pub absolute: f32,
    pub outliers: f32,
}

/// Compares texels over the render rect; both must be finite.
pub fn texels<const N: usize, T: Copy + Default + 'static>(
    what: &str,
    captured: &Captured,
    gpu: &Image<T>,
    twin: &Image<T>,
    tolerance: Tolerance,
    values: impl Fn(T) -> [f32; N],
) {
    equal(what, captured, captured.frame.render_extent, gpu, twin, tolerance, values);
}

/// The same for images with one texel a block.
pub fn blocks<const N: usize, T: Copy + Default + 'static>(
    what: &str,
    captured: &Captured,
    gpu: &Image<T>,
    twin: &Image<T>,
    tolerance: Tolerance,
    values: impl Fn(T) -> [f32; N],
) {
    let extent = captured.frame.render_extent.map(|side| side.div_ceil(BLOCK_SIZE));
    equal(what, captured, extent, gpu, twin, tolerance, values);
}

/// The same over the top left `extent` of images that have not one texel a pixel.
pub fn equal<const N: usize, T: Copy + Default + 'static>(
    what: &str,
    captured: &Captured,
    extent: [u32; 2],
    gpu: &Image<T>,
    twin: &Image<T>,
    tolerance: Tolerance,
    values: impl Fn(T) -> [f32; N],
) {
    let (mut differ, mut first) = (0, None);
    for (x, y) in pixels(extent) {
        let texel = |image: &Image<T>| values(*image.get(x as i32, y as i32).expect("inside"));
        let (a, b) = (texel(gpu), texel(twin));
        let equal = (0..N).all(|i| {
            let limit = tolerance.absolute + tolerance.relative * a[i].abs().max(b[i].abs());
            a[i].is_finite() && b[i].is_finite() && (a[i] - b[i]).abs() <= limit
        });
        if !equal {
            differ += 1;
            first.get_or_insert((x, y, a, b));
        }
    }
    if let Some((x, y, gpu, twin)) = first {
        let allowed = (tolerance.outliers * (extent[0] * extent[1]) as f32).ceil() as usize;
        let (frame, reset) = (captured.frame.index, captured.frame.reset);
        assert!(
            differ <= allowed,
            "{what}, frame {frame} (reset: {reset:?}): {differ} pixels of {extent:?} differ, {allowed} may; the first at {x},{y}: GPU {gpu:?}, twin {twin:?}"
        );
    }
}

/// The same for images of half floats.
pub fn halves(what: &str, captured: &Captured, gpu: &Image<[f32; 4]>, twin: &Image<[f32; 4]>, tolerance: Tolerance) {
    texels(what, captured, gpu, twin, tolerance, |t| t);
}
