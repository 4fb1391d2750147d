//! The stage `upsample`: filtered light of fewer pixels, brought to each pixel of the guides \[Kopf 2007\].

use crate::nodes::import::twin::rendered_guide;
use crate::reference::binary16::store;
use crate::reference::bindings::Bindings;
use crate::reference::compare::Rule;
use crate::reference::guide::{unpack_guide, Surface};
use crate::reference::projection::view_position;
use crate::reference::render_rect::RenderRect;
use crate::reference::rules::{pixels, WEIGHTED};
use crate::reference::volume::{relative_difference, sight};
use crate::reference::Image;
use crate::{Error, FrameConstants};
use glam::{IVec2, Mat3, Mat4, UVec2, Vec3};

/// Standard deviation of the Gauss, pixels of light.
const SIGMA: f32 = 0.8;
/// Distance from the plane of a surface, in shares of its depth, at which a weight is down to 1/e.
const PLANE_TOLERANCE: f32 = 0.02;
/// Of 1 − cos of two normals.
const NORMAL_SHARPNESS: f32 = 16.0;
/// Of the difference of two depths behind a volume, as a share of the larger one.
const VOLUME_SHARPNESS: f32 = 8.0;
/// Weight of taps on other surfaces.
const LEAST_ALIKE: f32 = 1e-3;
/// Weight of taps with light of another kind.
const LEAST: f32 = 1e-6;

/// Inputs of [`upsample`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct UpsampleInputs<'a> {
    /// Of every rendered pixel.
    pub rendered_guide: &'a Image<[u16; 4]>,
    /// Of the pixels that light was traced for.
    pub guide: &'a Image<[u16; 4]>,
    /// Whether the light is a volume's, and not that of the surfaces.
    pub is_volume: bool,
    /// rgb: irradiance of every signal.
    pub filtered: &'a [&'a Image<[f32; 4]>],
}

/// rgb: what `store` makes of the irradiance of every rendered pixel and signal; alpha 0.
pub(crate) fn upsample(frame: &FrameConstants, inputs: &UpsampleInputs, store: impl Fn(f32) -> f32 + Sync) -> Vec<Image<[f32; 4]>> {
    let of_guides = frame.of_guides();
    let light = RenderRect::new(frame.render_extent);
    let ratio = UVec2::from(frame.light_ratio).as_vec2();
    let weights = Image::compute(inputs.rendered_guide.extent(), frame.guide_extent, |p| {
        let centre = unpack_guide(inputs.rendered_guide.at(p));
        let u = (p.as_vec2() + 0.5) / ratio - 0.5;
        let nearest = ((p.as_vec2() + 0.5) / ratio).floor().as_ivec2();
        let taps = [-1, 0, 1].map(|y| [-1, 0, 1].map(|x| nearest + IVec2::new(x, y)));
        taps.as_flattened().iter().copied().fold(Taps::default(), |mut taps, q| {
            if light.contains(q) {
                let tap = unpack_guide(inputs.guide.at(q));
                let gauss = (-(q.as_vec2() - u).length_squared() / (2.0 * SIGMA * SIGMA)).exp();
                let likeness = match inputs.is_volume {
                    true => LEAST + (-VOLUME_SHARPNESS * relative_difference(sight(&centre), sight(&tap))).exp(),
                    false => likeness(&of_guides, (p, &centre), (frame.guide_pixel(q), &tap)),
                };
                taps.0[taps.1] = (q, gauss * likeness);
                taps.1 += 1;
            }
            taps
        })
    });
    let of_signal = |signal: &&Image<[f32; 4]>| {
        Image::compute(weights.extent(), frame.guide_extent, |p| {
            let Taps(taps, count) = weights.at(p);
            let (mut sum, mut total) = (Vec3::ZERO, 0.0);
            for (q, weight) in &taps[..count] {
                let [r, g, b, _] = signal.at(*q);
                sum += *weight * Vec3::new(r, g, b);
                total += weight;
            }
            let [r, g, b] = (sum / total).to_array().map(&store);
            [r, g, b, 0.0]
        })
    };
    inputs.filtered.iter().map(of_signal).collect()
}

/// Taps of a pixel with their weights, and their number.
#[derive(Clone, Copy, Default)]
struct Taps([(IVec2, f32); 9], usize);

/// How far two pixels of the guides show the same surface.
fn likeness(frame: &FrameConstants, (p, centre): (IVec2, &Surface), (q, tap): (IVec2, &Surface)) -> f32 {
    if centre.is_background() {
        return if tap.is_background() { 1.0 + LEAST } else { LEAST };
    }
    if tap.is_background() || tap.is_apart != centre.is_apart {
        return LEAST;
    }
    let normal = Vec3::from(centre.normal);
    let view_from_world = Mat3::from_mat4(Mat4::from_cols_array_2d(&frame.world_from_view)).transpose();
    let between = view_position(frame, q, tap.linear_depth) - view_position(frame, p, centre.linear_depth);
    let distance = (view_from_world * normal).dot(between).abs();
    // 1 − cos of two unit normals is half of their squared distance.
    let turned = 0.5 * normal.distance_squared(tap.normal.into());
    LEAST + LEAST_ALIKE + (-NORMAL_SHARPNESS * turned - distance / (PLANE_TOLERANCE * centre.linear_depth)).exp()
}

/// How what it writes is compared with the GPU.
pub(crate) const RULES: &[Rule] = &[pixels("upsampled_0", WEIGHTED), pixels("upsampled_1", WEIGHTED)];

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let (rendered_guide, guide) = (&*rendered_guide(b, true)?, b.packed("guide")?);
    if let Ok(visibility) = b.scalar("filtered_0") {
        let filtered = visibility.map(|v| [*v, 0.0, 0.0, 0.0]);
        let [upsampled, ..] =
            &upsample(b.frame, &UpsampleInputs { rendered_guide, guide, is_volume: false, filtered: &[&filtered] }, |x| x)[..]
        else {
            return Ok(());
        };
        return b.write("upsampled_0", upsampled.map(|texel| texel[0]));
    }
    let upsampled = upsample(
        b.frame,
        &UpsampleInputs { rendered_guide, guide, is_volume: b.is_on("VOLUME")?, filtered: &b.colours("filtered")? },
        store,
    );
    b.write_signals("upsampled", upsampled)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::guide::pack_guide;
    use crate::reference::test_scene::{camera, frame_with, paint, surface};
    use crate::{Config, FrameParams};

    const EXTENT: [u32; 2] = [16, 12];

    /// Upsampled light of surfaces, traced at an offset; each pixel of light has that of its traced surface.
    fn upsampled(
        light_offset: [u32; 2],
        surfaces: impl Fn(i32, i32) -> Surface,
        light: impl Fn(&Surface) -> f32,
    ) -> Image<[f32; 4]> {
        let config = Config { light_extent: Some(EXTENT.map(|side| side / 2)), ..Config::new(EXTENT) };
        let before = camera(EXTENT, Vec3::ZERO);
        let frame = frame_with(&config, &before, &FrameParams { light_offset, ..before });
        let traced = paint(frame.render_extent, |x, y| {
            let p = frame.guide_pixel(IVec2::new(x, y));
            surfaces(p.x, p.y)
        });
        let filtered = traced.map(|surface| [light(surface); 4]);
        let (rendered_guide, guide) = (paint(EXTENT, |x, y| pack_guide(&surfaces(x, y))), traced.map(pack_guide));
        let inputs = UpsampleInputs { rendered_guide: &rendered_guide, guide: &guide, is_volume: false, filtered: &[&filtered] };
        upsample(&frame, &inputs, store).remove(0)
    }

    #[test]
    fn a_constant_light_is_a_fixed_point() {
        for (offset, light) in [([0, 0], 0.5), ([1, 1], 30000.0), ([1, 0], 0.0)] {
            let picture = upsampled(offset, |x, _| if x < 7 { surface(4.0) } else { Surface::default() }, |_| light);
            assert!(picture.texels().iter().all(|texel| (texel[0] - light).abs() <= 1e-3 * light), "{:?}", picture.texels());
        }
    }

    #[test]
    fn light_stays_on_its_surface() {
        let turned = Surface { normal: [1.0, 0.0, 0.0], ..surface(4.0) };
        let dark = Surface { is_apart: true, ..surface(4.0) };
        for other in [surface(5.0), turned, dark, Surface::default()] {
            for offset in [[0, 0], [1, 0], [0, 1], [1, 1]] {
                let is_other = |x: i32| x >= 7;
                let light = |s: &Surface| if *s == surface(4.0) { 1.0 } else { 0.0 };
                let picture = upsampled(offset, |x, _| if is_other(x) { other } else { surface(4.0) }, light);
                for (x, y) in (0..16).flat_map(|x| (0..12).map(move |y| (x, y))) {
                    let (value, right) = (picture.at(IVec2::new(x, y))[0], if is_other(x) { 0.0 } else { 1.0 });
                    // A wall that is turned away cannot have the same depth everywhere, so its own taps lie beside its plane.
                    let counts = other != turned || !is_other(x);
                    assert!(!counts || (value - right).abs() < 0.15, "{other:?} {offset:?} {x},{y}: {value}");
                }
            }
        }
    }

    #[test]
    fn a_thing_that_no_sample_hit_takes_the_light_around() {
        let is_thin = |x: i32| x == 6;
        let picture =
            upsampled([1, 0], |x, _| if is_thin(x) { Surface { is_apart: true, ..surface(2.0) } } else { surface(4.0) }, |_| 0.75);
        assert!((0..12).all(|y| (picture.at(IVec2::new(6, y))[0] - 0.75).abs() < 1e-3));
    }
}
