//! Visibility of lights: its packing, and lengths on a surface.

use super::binary16::{from_half_bits, half_bits};
use super::bindings::Bindings;
use super::guide::Surface;
use super::projection::pixel_size;
use super::Image;
use crate::{Error, FrameConstants};
use glam::Vec2;

/// Visible shares of a light: red, green and blue, which are the same where it is grey.
pub(crate) type Visible = [f32; 3];

/// The largest of a number for each component.
pub(crate) fn largest(values: Visible) -> f32 {
    values.into_iter().fold(f32::NEG_INFINITY, f32::max)
}

/// A number for each component, from those of others.
pub(crate) fn each(f: impl Fn(usize) -> f32) -> Visible {
    std::array::from_fn(f)
}

/// A pixel of `visibility_history`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct VisibilityHistory {
    /// Share of the light that is seen, 0 to 1, over the history.
    pub mean: Visible,
    /// Standard deviation of a sample, 0 to 0.5.
    pub deviation: f32,
    /// Frames accumulated, 1 to 63.
    pub history_length: f32,
    /// Distance of what is in the way, scene units; 0: nothing is.
    pub occluder_distance: f32,
}

/// The longest history that fits.
pub(crate) const LONGEST_HISTORY: f32 = 63.0;

/// The visibility of a pixel that has no sample.
pub(crate) const NO_SAMPLE: f32 = 2.0;
/// Bits of the word of a sample: its block of 8×8 pixels holds a sample that sees some of the light.
pub(crate) const BLOCK_HAS_LIT: u32 = 0x8000;
/// The same of one that does not see all of it.
pub(crate) const BLOCK_HAS_OCCLUDED: u32 = 0x8000_0000;

/// The words of a light: red, or grey, with what else is remembered; and in colour green and blue.
pub(crate) type Words = [u32; 2];

/// The words of a light in `visibility_history` and `visibility_history_colours`.
pub(crate) fn pack_visibility(h: &VisibilityHistory) -> Words {
    let round = |x: f32| (x + 0.5).floor() as u32;
    let distance = match h.occluder_distance > 0.0 {
        true => round((h.occluder_distance.log2() * 8.0 + 97.0).clamp(0.5, 255.0)),
        false => 0,
    };
    let [red, green, blue] = h.mean.map(|mean| round(mean.clamp(0.0, 1.0) * 4095.0));
    let deviation = round(h.deviation.clamp(0.0, 0.5) * 126.0);
    let word = red | deviation << 12 | round(h.history_length.clamp(1.0, LONGEST_HISTORY)) << 18 | distance << 24;
    [word, green | blue << 12]
}

/// The content of such words.
pub(crate) fn unpack_visibility(word: u32, colours: Option<u32>) -> VisibilityHistory {
    let steps = word >> 24;
    let mean = |steps: u32| (steps & 0xfff) as f32 / 4095.0;
    VisibilityHistory {
        mean: colours.map_or([mean(word); 3], |colours| [mean(word), mean(colours), mean(colours >> 12)]),
        deviation: (word >> 12 & 0x3f) as f32 / 126.0,
        history_length: (word >> 18 & 0x3f) as f32,
        occluder_distance: if steps == 0 { 0.0 } else { ((steps as f32 - 97.0) / 8.0).exp2() },
    }
}

/// The words of one light in the bindings of a pass: with those of other lights in a texel, or alone.
pub(crate) fn words_of(b: &Bindings, name: &str, light: usize) -> Result<Image<u32>, Error> {
    match b.uint(name) {
        Ok(image) if light == 0 => Ok(image.clone()),
        _ => Ok(b.wide(name)?.map(|words| words[light])),
    }
}

/// [`words_of`], where the pass has the binding.
pub(crate) fn some_words_of(b: &Bindings, name: &str, light: usize) -> Result<Option<Image<u32>>, Error> {
    b.has(name).then(|| words_of(b, name, light)).transpose()
}

/// The content of `visibility_history` and its colours for one light.
pub(crate) fn histories_of(b: &Bindings, names: [&str; 2], light: usize) -> Result<Image<VisibilityHistory>, Error> {
    let (words, colours) = (words_of(b, names[0], light)?, some_words_of(b, names[1], light)?);
    let extent = words.extent();
    let unpacked = |p| unpack_visibility(words.at(p), colours.as_ref().map(|colours| colours.at(p)));
    Ok(Image::compute(extent, extent, unpacked))
}

/// The halves of a word, the low one first.
pub(crate) fn halves(word: u32) -> [f32; 2] {
    [from_half_bits(word as u16), from_half_bits((word >> 16) as u16)]
}

/// Two halves of every pixel of one light, and in colour two more.
pub(crate) fn halves_of(b: &Bindings, names: [&str; 2], light: usize) -> Result<Image<(Visible, f32)>, Error> {
    let (words, colours) = (words_of(b, names[0], light)?, some_words_of(b, names[1], light)?);
    let extent = words.extent();
    Ok(Image::compute(extent, extent, |p| {
        let ([red, number], others) = (halves(words.at(p)), colours.as_ref().map(|colours| halves(colours.at(p))));
        (others.map_or([red; 3], |[green, blue]| [red, green, blue]), number)
    }))
}

/// The words of such halves.
pub(crate) fn pack_halves([red, green, blue]: Visible, number: f32) -> Words {
    let halves = |low: f32, high: f32| u32::from(half_bits(low)) | u32::from(half_bits(high)) << 16;
    [halves(red, number), halves(green, blue)]
}

/// Writes the words of all lights, and in colour the second ones.
pub(crate) fn write_words(b: &mut Bindings, names: [&str; 2], lights: &[Image<Words>]) -> Result<(), Error> {
    for (i, name) in names.into_iter().enumerate().filter(|(i, name)| *i == 0 || b.has(name)).collect::<Vec<_>>() {
        match lights {
            [only] => b.write(name, only.map(|words| words[i]))?,
            [first, ..] => {
                let extent = first.extent();
                b.write(
                    name,
                    Image::compute(extent, extent, |p| {
                        std::array::from_fn(|light| lights.get(light).map_or(0, |words| words.at(p)[i]))
                    }),
                )?;
            }
            [] => {}
        }
    }
    Ok(())
}

/// The lights of a pass.
pub(crate) fn lights_of(b: &Bindings) -> usize {
    b.constant("LIGHTS").map_or(1, |count| count as usize)
}

/// The name of a binding of a light.
pub(crate) fn of_light(name: &str, light: usize) -> String {
    if light == 0 {
        name.to_owned()
    } else {
        format!("{name}_{light}")
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
    /// Of the pixel of a surface.
    pub(crate) fn new(frame: &FrameConstants, surface: &Surface) -> Self {
        Self { size: pixel_size(frame, surface.linear_depth), gradient: surface.gradient.into() }
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
            let mean = [mean, 1.0 - mean, 0.75 * mean];
            let [word, colours] = pack_visibility(&VisibilityHistory { mean, deviation, history_length, occluder_distance });
            let h = unpack_visibility(word, Some(colours));
            assert!(largest(each(|c| (h.mean[c] - mean[c]).abs())) < 2e-4 && (h.deviation - deviation).abs() < 5e-3, "{h:?}");
            assert_eq!(unpack_visibility(word, None), VisibilityHistory { mean: [h.mean[0]; 3], ..h });
            assert_eq!(h.history_length, history_length);
            assert!((h.occluder_distance - occluder_distance).abs() <= 0.05 * occluder_distance, "{h:?} {occluder_distance}");
        }
    }

    #[test]
    fn what_does_not_fit_saturates() {
        let far = VisibilityHistory { mean: [7.0; 3], deviation: 3.0, history_length: 1e9, occluder_distance: 1e30 };
        let packed = |h: &VisibilityHistory| unpack_visibility(pack_visibility(h)[0], Some(pack_visibility(h)[1]));
        let h = packed(&far);
        assert_eq!((h.mean, h.deviation, h.history_length), ([1.0; 3], 0.5, 63.0));
        assert!(h.occluder_distance > 65504.0);
        let near = packed(&VisibilityHistory { occluder_distance: 1e-9, ..far });
        assert!(near.occluder_distance > 0.0 && near.occluder_distance < 1e-3);
    }

    #[test]
    fn a_pixel_is_longer_far_away_and_where_the_surface_recedes() {
        let extent = [64, 32];
        let view = camera(extent, Vec3::ZERO);
        let frame = frame_with(&crate::Config::new(extent), &view, &view);
        let near = Ruler::new(&frame, &surface(1.0));
        // 90 degrees from top to bottom: two scene units at depth 1.
        assert!((near.size.y - 2.0 / 32.0).abs() < 1e-6 && (near.size.x - near.size.y).abs() < 1e-6, "{near:?}");
        let far = Ruler::new(&frame, &Surface { gradient: [0.0, 1.0], ..surface(10.0) });
        assert!((far.size.y - 20.0 / 32.0).abs() < 1e-5);
        assert!((far.squared(Vec2::Y) - (far.size.y * far.size.y + 1.0)).abs() < 1e-5);
        assert!((far.squared(Vec2::X) - far.size.x * far.size.x).abs() < 1e-5);
    }
}
