//! The stage `reactive_mask`: shares of new and of emitted light.

use crate::nodes::import::twin::rendered_guide;
use crate::reference::bindings::Bindings;
use crate::reference::both_confidences::change_by;
use crate::reference::compare::Rule;
use crate::reference::guide::unpack_guide;
use crate::reference::luminance::texel_luminance;
use crate::reference::luminance_history::{luminance_histories, LuminanceHistory};
use crate::reference::rules::{pixels, HALF};
use crate::reference::{render_rect::RenderRect, Image};
use crate::{Error, FrameConstants};
use glam::{IVec2, UVec2};

/// Inputs of [`reactive_mask`]; images have the allocated extent.
#[derive(Clone, Copy)]
pub(crate) struct ReactiveInputs<'a> {
    /// Guides of every rendered pixel.
    pub rendered_guide: &'a Image<[u16; 4]>,
    /// The image `guide`, from the stage `import`.
    pub guide: &'a Image<[u16; 4]>,
    /// `luminance_history*` of every signal.
    pub histories: &'a [&'a Image<LuminanceHistory>],
    /// Confidence in the history.
    pub confidence: Option<&'a Image<f32>>,
    /// rgb: denoised radiance, emission included.
    pub radiance: &'a Image<[f32; 4]>,
    /// rgb: what the host emits.
    pub emission: Option<&'a Image<[f32; 4]>>,
}

/// Red: share of what is new, green: share of what is emitted, each 0 to 1.
pub(crate) fn reactive_mask(frame: &FrameConstants, inputs: &ReactiveInputs) -> Image<[f32; 4]> {
    Image::compute(inputs.rendered_guide.extent(), frame.guide_extent, |p| {
        let surface = unpack_guide(inputs.rendered_guide.at(p));
        let q = light_pixel(frame, inputs.guide, p, surface.linear_depth);
        let lengths = inputs.histories.iter().map(|history| history.at(q).history_length);
        let shortest = lengths.fold(f32::INFINITY, f32::min).max(1.0);
        let changed = inputs.confidence.map_or(0.0, |confidence| change_by(confidence.at(q)));
        let is_surface = !surface.is_background();
        let new = if is_surface { (1.0 / shortest).max(changed).clamp(0.0, 1.0) } else { 0.0 };
        let emission = inputs.emission.map_or([0.0; 4], |emission| emission.at(p));
        let emitted = if emission[..3].iter().all(|c| c.is_finite()) { texel_luminance(emission) } else { 0.0 };
        let share = if emitted > 0.0 { emitted / texel_luminance(inputs.radiance.at(p)).max(emitted) } else { 0.0 };
        [new, share, 0.0, 1.0]
    })
}

/// Of the 2×2 pixels of light around a rendered pixel the one whose surface is nearest to its depth. With light of every pixel, its own.
fn light_pixel(frame: &FrameConstants, guide: &Image<[u16; 4]>, p: IVec2, depth: f32) -> IVec2 {
    if frame.light_ratio == [1; 2] {
        return p;
    }
    let rect = RenderRect::new(frame.render_extent);
    let corner = ((p.as_vec2() + 0.5) / UVec2::from(frame.light_ratio).as_vec2() - 0.5).floor().as_ivec2();
    let taps = [IVec2::ZERO, IVec2::X, IVec2::Y, IVec2::ONE].map(|offset| rect.clamp(corner + offset));
    let difference = |q: IVec2| (unpack_guide(guide.at(q)).linear_depth - depth).abs();
    taps.into_iter().reduce(|best, q| if difference(q) < difference(best) { q } else { best }).unwrap_or(p)
}

/// How what it writes is compared with the GPU.
pub(crate) const RULES: &[Rule] = &[pixels("reactive_mask", HALF)];

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let histories = luminance_histories(b, "luminance_history")?;
    let inputs = ReactiveInputs {
        rendered_guide: &*rendered_guide(b, false)?,
        guide: b.packed("guide")?,
        histories: &histories.iter().collect::<Vec<_>>(),
        confidence: b.optional_scalar("history_confidence")?,
        radiance: b.colour("radiance")?,
        emission: b.optional_colour("emission")?,
    };
    let mask = reactive_mask(b.frame, &inputs);
    b.write("reactive_mask", mask)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::test_scene::*;
    use crate::{Config, FrameParams};

    const EXTENT: [u32; 2] = [3, 1];

    fn history(lengths: [f32; 3]) -> Image<LuminanceHistory> {
        let of = |x: i32| LuminanceHistory { history_length: lengths[x as usize], ..LuminanceHistory::default() };
        paint(EXTENT, |x, _| of(x))
    }

    #[test]
    fn what_is_new_and_what_is_emitted_is_marked() {
        let guides = guides(EXTENT, |x, _| surface(if x == 2 { 0.0 } else { 4.0 }));
        let (long, short) = (history([64.0, 8.0, 1.0]), history([64.0, 1.0, 1.0]));
        let confidence = paint(EXTENT, |x, _| if x == 0 { 0.25 } else { 1.0 });
        let emission = paint(EXTENT, |x, _| [[0.0; 4], [1.0; 4], [f32::INFINITY; 4]][x as usize]);
        let radiance = Image::new(EXTENT, [4.0, 4.0, 4.0, 1.0]);
        let inputs = ReactiveInputs {
            rendered_guide: &guides.guide,
            guide: &guides.guide,
            histories: &[&long],
            confidence: None,
            radiance: &radiance,
            emission: Some(&emission),
        };
        let mask = |inputs| reactive_mask(&frame(EXTENT), &inputs).texels().iter().map(|t| [t[0], t[1]]).collect::<Vec<_>>();
        assert_eq!(mask(inputs), [[1.0 / 64.0, 0.0], [0.125, 0.25], [0.0, 0.0]]);
        assert_eq!(mask(ReactiveInputs { confidence: Some(&confidence), ..inputs })[0], [0.75, 0.0]);
        let both = ReactiveInputs { histories: &[&long, &short], emission: None, ..inputs };
        assert_eq!(mask(both)[1], [1.0, 0.0]);
    }

    #[test]
    fn with_half_the_light_a_thing_takes_what_is_new_from_its_own_surface() {
        let (rendered, light) = ([8, 4], [4, 2]);
        let config = Config { light_extent: Some(light), ..Config::new(rendered) };
        let frame = frame_with(&config, &FrameParams::new(rendered), &FrameParams::new(rendered));
        // A near thing came in from the left, up to the middle of a cell.
        let rendered_guide = guides(rendered, |x, _| surface(if x < 3 { 2.0 } else { 9.0 })).guide;
        let guide = guides(light, |x, _| surface(if x < 2 { 2.0 } else { 9.0 })).guide;
        let history = paint(light, |x, _| {
            let history_length = if x < 2 { 1.0 } else { 50.0 };
            LuminanceHistory { history_length, ..LuminanceHistory::default() }
        });
        let radiance = Image::new(rendered, [1.0; 4]);
        let inputs = ReactiveInputs {
            rendered_guide: &rendered_guide,
            guide: &guide,
            histories: &[&history],
            confidence: None,
            radiance: &radiance,
            emission: None,
        };
        let mask = reactive_mask(&frame, &inputs);
        let new = |x: i32| mask.at(IVec2::new(x, 1))[0];
        assert_eq!([0, 1, 2].map(new), [1.0; 3]);
        assert!([3, 4, 5, 6, 7].iter().all(|x| new(*x) < 0.03), "{:?}", mask.texels());
    }
}
