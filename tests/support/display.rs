//! Pictures at the size of a display, from frames of fewer pixels.

use super::pixels;
use super::scene::Scene;

/// Light under one path a pixel.
pub fn scene(extent: [u32; 2], speed: f32, jitter: [f32; 2]) -> Scene {
    Scene { speed, jitter, noise: 0.3, ..Scene::new(extent) }
}

/// Means over the pixels of the output.
pub fn reference(output: [u32; 2], speed: f32, index: u32) -> Vec<[f32; 4]> {
    let mut sum = vec![[0.0; 4]; pixels(output).count()];
    for i in 0..16 {
        let part = [(i % 4) as f32 / 4.0 - 0.375, (i / 4) as f32 / 4.0 - 0.375];
        let clean = Scene { noise: 0.0, ..scene(output, speed, part) }.frame(index, 0).clean;
        sum.iter_mut().zip(&clean).for_each(|(sum, c)| (0..3).for_each(|i| sum[i] += c[i] / 16.0));
    }
    sum
}

/// A picture by the four pixels around, moved back by its jitter.
pub fn enlarged(image: &[[f32; 4]], extent: [u32; 2], output: [u32; 2], jitter: [f32; 2]) -> Vec<[f32; 4]> {
    let around = |p: u32, axis: usize| {
        let s = (p as f32 + 0.5) * extent[axis] as f32 / output[axis] as f32 - 0.5 - jitter[axis];
        let s = s.clamp(0.0, (extent[axis] - 1) as f32);
        let first = (s as u32).min(extent[axis] - 2);
        (first, s - first as f32)
    };
    let pixel = |(x, y)| {
        let ((x, fx), (y, fy)) = (around(x, 0), around(y, 1));
        let at = |x: u32, y: u32| image[(y * extent[0] + x) as usize];
        let mix = |a: [f32; 4], b: [f32; 4], t: f32| std::array::from_fn(|i| a[i] + t * (b[i] - a[i]));
        mix(mix(at(x, y), at(x + 1, y), fx), mix(at(x, y + 1), at(x + 1, y + 1), fx), fy)
    };
    pixels(output).map(pixel).collect()
}
