//! Where nobody knows the hit distance: how likely the light of now makes it that the image is seen, and not the light of the surface.

use super::agreement::{DARK, LOG_ROUNDED};
use super::past::{of_light, Past};
use super::{Centre, Scene};
use crate::reference::binary16::LARGEST_HALF;
use crate::reference::render_rect::RenderRect;
use glam::{IVec2, Vec2};

/// How likely it is at first that a surface shows an image, and how much of the odds, as logarithms, is kept.
pub(super) const CHANCE_AT_FIRST: f32 = 0.076;
const ODDS_KEPT: f32 = 0.8;
/// The most that one frame tells, and that all of them tell, as logarithms of odds.
const LARGEST_EVIDENCE: f32 = 8.0;
const LARGEST_ODDS: f32 = 4.8;
/// An image that is less likely is not looked up.
pub(super) const UNLIKELY: f32 = 0.1;
/// Pixels to each side, and the fewest that tell which past is seen.
const EVIDENCE_REACH: i32 = 3;
const FEWEST_TELLING: f32 = 6.0;
/// Variance of a past of one frame beside that of a sample, both as logarithms.
const PAST_NOISE: f32 = 0.35;

fn log_odds(chance: f32) -> f32 {
    (chance / (1.0 - chance)).ln()
}

impl Scene<'_> {
    /// How likely it is that the image is seen, by all frames of the surface. `image_position`: where it was, if it moved.
    pub(super) fn image_chance(&self, c: &Centre, image_position: Option<Vec2>, surface: &Past) -> f32 {
        let before = log_odds(surface.image_share.clamp(1e-3, 0.999)).clamp(-LARGEST_ODDS, LARGEST_ODDS);
        let at_first = log_odds(CHANCE_AT_FIRST);
        let evidence = image_position.map_or(0.0, |position| self.evidence_for_image(c, position, surface));
        let odds = at_first + ODDS_KEPT * (before - at_first) + evidence;
        1.0 / (1.0 + (-odds.clamp(-LARGEST_ODDS, LARGEST_ODDS)).exp())
    }

    /// By how much the light of now makes it likelier that the image is seen, as logarithm of the odds. Both pasts are compared with it over
    /// 7×7 pixels, as logarithms, by the differences about their mean: logarithms of samples lie below those of what they are samples of.
    fn evidence_for_image(&self, c: &Centre, image_position: Vec2, surface: &Past) -> f32 {
        let ratio = self.frame.exposure_ratio;
        let dark = DARK * of_light(surface.irradiance.map(|value| (value * ratio).clamp(0.0, LARGEST_HALF))) + 1e-6;
        let counts = |q: IVec2| {
            let there = self.motion.surfaces.at(q);
            self.inputs.noisy.at(q)[3] >= 0.0 && !there.is_background() && there.id == c.mirror.surface.id
        };
        let tells: Vec<[f32; 2]> = self
            .rect
            .window(c.mirror.p, EVIDENCE_REACH, 1)
            .filter(|(_, q)| counts(*q))
            .map(|(offset, q)| {
                let [r, g, b, _] = self.inputs.noisy.at(q);
                let now = (of_light([r, g, b]) + dark).log2();
                let then = [c.mirror.surface_position, image_position].map(|at| self.luminance_then(at, offset));
                then.map(|then| now - (then + dark).log2())
            })
            .collect();
        let count = tells.len() as f32;
        if count < FEWEST_TELLING {
            return 0.0;
        }
        let variation = |of: &dyn Fn(&[f32; 2]) -> f32| {
            let mean = tells.iter().map(of).sum::<f32>() / count;
            tells.iter().map(|pair| (of(pair) - mean).powi(2)).sum::<f32>()
        };
        let [from_surface, from_image] = [variation(&|pair| pair[0]), variation(&|pair| pair[1])];
        let noise = from_surface.min(from_image) / count + LOG_ROUNDED;
        // Pasts also differ by their own noise, which tells nothing.
        let of_noise = 2.0 * PAST_NOISE * noise * count / surface.frames.max(1.0);
        let share = (1.0 - of_noise / variation(&|pair| pair[0] - pair[1]).max(1e-6)).clamp(0.0, 1.0);
        (share * (from_surface - from_image) / (2.0 * noise)).clamp(-LARGEST_EVIDENCE, LARGEST_EVIDENCE)
    }

    /// Luminance of the past between pixels.
    fn luminance_then(&self, position: Vec2, offset: IVec2) -> f32 {
        let (corner, f) = (position.floor().as_ivec2() + offset, position - position.floor());
        let previous = RenderRect::new(self.frame.previous_render_extent);
        let at = |x, y| {
            let [r, g, b, _] = self.inputs.previous.history.at(previous.clamp(corner + IVec2::new(x, y)));
            of_light([r, g, b].map(|value| (value * self.frame.exposure_ratio).clamp(0.0, LARGEST_HALF)))
        };
        let row = |y| at(0, y) + f.x * (at(1, y) - at(0, y));
        row(0) + f.y * (row(1) - row(0))
    }
}
