//! Edges of the sun's shadows: where they are, how wide they are, and how wrong a picture is around them.

use atrous_lab::scores::{rmse, Rgb};
use glam::{IVec2, Vec2};

use crate::measure::luminance;
use crate::Result;
use atrous_engine::{Gpu, PathTracer};

/// Pixels around an edge that count, on either side.
pub const BAND: f32 = 8.0;
/// Pixels that a profile reaches to either side of its edge, and steps of a pixel.
const REACH: i32 = 7;
const STEPS: i32 = 4;
/// Where a profile is level, pixels from the edge.
const LEVEL: f32 = 5.0;

/// What a frame shows, by pixel.
pub struct ShadowGuides {
    /// Width and height in pixels.
    pub extent: [u32; 2],
    /// Share of the sun that is seen.
    pub visibility: Vec<f32>,
    /// Whether it would light the surface.
    pub is_turned: Vec<bool>,
    /// Luminance of the albedo.
    pub albedo: Vec<f32>,
    /// Linear depth.
    pub depth: Vec<f32>,
    /// Surface, 0 for none.
    pub surface_id: Vec<u32>,
}

/// The edges of a frame.
pub struct ShadowEdges {
    guides: ShadowGuides,
    /// Pixels in the band.
    pub band: Vec<usize>,
    profiles: Vec<Profile>,
}

/// A line across an edge that lies by itself: a point in pixels where half of the sun is seen, and the way into the light.
struct Profile {
    middle: Vec2,
    towards_light: Vec2,
}

impl ShadowGuides {
    /// Those of the tracer's frame, whose lighting was recorded with lamps apart, for the first; `samples` shadow rays a pixel.
    ///
    /// # Errors
    /// No memory, or a lost device. Nothing without a lamp.
    pub fn read(gpu: &Gpu, tracer: &PathTracer, samples: u32) -> Result<Option<Self>> {
        let (Some(lamp), Some(visibility)) = (tracer.lamps_apart().first(), tracer.lamp_reference(0, samples)?) else {
            return Ok(None);
        };
        let outputs = tracer.outputs();
        Ok(Some(Self {
            extent: [tracer.extent().width, tracer.extent().height],
            visibility: visibility.iter().map(|v| v[0]).collect(),
            is_turned: gpu.read_image(&lamp.unshadowed_direct)?.iter().map(|l| luminance([l[0], l[1], l[2]]) > 0.05).collect(),
            albedo: gpu.read_image(&outputs.albedo)?.iter().map(|a| luminance([a[0], a[1], a[2]]).max(0.01)).collect(),
            depth: gpu.read_image(&outputs.depth)?.iter().map(|d| d[0]).collect(),
            surface_id: gpu.read_image_u32(&outputs.surface_id)?,
        }))
    }

    fn index(&self, p: IVec2) -> Option<usize> {
        let [w, h] = self.extent.map(|side| side as i32);
        ((0..w).contains(&p.x) && (0..h).contains(&p.y)).then_some((p.y * w + p.x) as usize)
    }

    /// Whether two pixels show one surface, of which the sun is above.
    fn belong_together(&self, a: usize, b: usize) -> bool {
        let near = (self.depth[a] - self.depth[b]).abs() < 0.1 * self.depth[a].max(self.depth[b]);
        self.surface_id[a] != 0 && self.surface_id[a] == self.surface_id[b] && near && self.is_turned[a] && self.is_turned[b]
    }

    /// Pairs of pixels between which half of the sun disappears.
    fn edges(&self) -> Vec<(IVec2, IVec2)> {
        let [w, h] = self.extent.map(|side| side as i32);
        let pairs = (0..h).flat_map(|y| (0..w).map(move |x| IVec2::new(x, y))).flat_map(|p| [(p, p + IVec2::X), (p, p + IVec2::Y)]);
        let is_edge = |(p, q): &(IVec2, IVec2)| match (self.index(*p), self.index(*q)) {
            (Some(a), Some(b)) => self.belong_together(a, b) && (self.visibility[a] - 0.5) * (self.visibility[b] - 0.5) < 0.0,
            _ => false,
        };
        pairs.filter(is_edge).collect()
    }

    /// Bilinear between pixel centres; nothing where another surface takes part.
    fn look_up(&self, image: impl Fn(usize) -> f32, position: Vec2, like: usize) -> Option<f32> {
        let corner = (position - 0.5).floor();
        let f = position - 0.5 - corner;
        let mut sum = 0.0;
        for (x, y) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            let weight = (if x == 0 { 1.0 - f.x } else { f.x }) * (if y == 0 { 1.0 - f.y } else { f.y });
            let i = self.index(corner.as_ivec2() + IVec2::new(x, y))?;
            if self.surface_id[i] != self.surface_id[like] || !self.is_turned[i] {
                return None;
            }
            sum += weight * image(i);
        }
        Some(sum)
    }

    /// The profile through an edge, where visibility rises from nothing to everything within reach, and is level beyond.
    fn profile(&self, (p, q): (IVec2, IVec2)) -> Option<Profile> {
        let like = self.index(p)?;
        let around = (-2..=2).flat_map(|y| (-2..=2).map(move |x| IVec2::new(x, y)));
        let slope = around.filter_map(|o| Some(o.as_vec2() * (self.visibility[self.index(p + o)?] - 0.5))).sum::<Vec2>();
        let towards_light = slope.try_normalize()?;
        let seen = |at: Vec2| self.look_up(|i| self.visibility[i], at, like);
        // From between both pixels to where half is seen.
        let mut middle = (p + q).as_vec2() * 0.5 + 0.5;
        for step in [1.0, 0.5, 0.25, 0.125, 0.0625] {
            middle -= towards_light * step * (seen(middle)? - 0.5).signum();
        }
        for i in -REACH * STEPS..=REACH * STEPS {
            let t = i as f32 / STEPS as f32;
            let v = seen(middle + t * towards_light)?;
            if (t <= -LEVEL && v > 0.03) || (t >= LEVEL && v < 0.97) {
                return None;
            }
        }
        Some(Profile { middle, towards_light })
    }
}

impl ShadowEdges {
    /// Finds them.
    pub fn new(guides: ShadowGuides) -> Self {
        let edges = guides.edges();
        let [w, h] = guides.extent.map(|side| side as i32);
        let mut is_near = vec![false; guides.visibility.len()];
        let reach = BAND as i32;
        for (p, q) in &edges {
            let middle = (*p + *q).as_vec2() * 0.5;
            for (x, y) in (-reach..=reach + 1).flat_map(|y| (-reach..=reach + 1).map(move |x| (x, y))) {
                let near = *p + IVec2::new(x, y);
                if near.as_vec2().distance(middle) <= BAND && near.x >= 0 && near.y >= 0 && near.x < w && near.y < h {
                    is_near[(near.y * w + near.x) as usize] = true;
                }
            }
        }
        let band = is_near.iter().enumerate().filter_map(|(i, near)| near.then_some(i)).collect();
        let profiles = edges.into_iter().filter_map(|edge| guides.profile(edge)).collect();
        Self { guides, band, profiles }
    }

    /// Number of edges whose width is measured.
    pub fn profiles(&self) -> usize {
        self.profiles.len()
    }

    /// Root mean square error in the band.
    ///
    /// # Errors
    /// A picture with values that are not finite.
    pub fn error(&self, image: &[[f32; 3]], reference: &[[f32; 3]]) -> Result<f64> {
        let of = |image: &[[f32; 3]]| self.band.iter().map(|i| image[*i]).collect::<Vec<_>>();
        let (image, reference, count) = (of(image), of(reference), self.band.len() as u32);
        Ok(rmse(Rgb::new(count, 1, &image)?, Rgb::new(count, 1, &reference)?)?)
    }

    /// Pixels in which the light rises from a tenth to nine tenths across an edge, in the mean of all profiles; `None` without one. `reference`
    /// says how bright either side is; albedo is divided out.
    pub fn width(&self, image: &[[f32; 3]], reference: &[[f32; 3]]) -> Option<f32> {
        let count = (2 * REACH * STEPS + 1) as usize;
        let mut mean = vec![0.0; count];
        let mut used = 0.0;
        for profile in &self.profiles {
            let (Some(of_image), Some(of_reference)) = (self.light(image, profile), self.light(reference, profile)) else {
                continue;
            };
            let level = (REACH as f32 - LEVEL) * STEPS as f32;
            let side = |values: &[f32]| values.iter().sum::<f32>() / values.len() as f32;
            let (dark, bright) = (side(&of_reference[..level as usize]), side(&of_reference[count - level as usize..]));
            // An edge that is faint beside other light says nothing of itself.
            if bright < 1.5 * dark {
                continue;
            }
            mean.iter_mut().zip(&of_image).for_each(|(sum, l)| *sum += (l - dark) / (bright - dark));
            used += 1.0;
        }
        if used == 0.0 {
            return None;
        }
        mean.iter_mut().for_each(|sum| *sum /= used);
        Some(rise(&mean)? / STEPS as f32)
    }

    /// Demodulated luminance along a profile.
    fn light(&self, image: &[[f32; 3]], profile: &Profile) -> Option<Vec<f32>> {
        let like = self.guides.index(profile.middle.floor().as_ivec2())?;
        let lit = |i: usize| luminance(image[i]) / self.guides.albedo[i];
        let at = |i: i32| profile.middle + i as f32 / STEPS as f32 * profile.towards_light;
        (-REACH * STEPS..=REACH * STEPS).map(|i| self.guides.look_up(lit, at(i), like)).collect()
    }
}

/// Steps between a tenth and nine tenths of the way from the level at the beginning to that at the end.
fn rise(profile: &[f32]) -> Option<f32> {
    let level = ((REACH as f32 - LEVEL) * STEPS as f32) as usize;
    let side = |values: &[f32]| values.iter().sum::<f32>() / values.len() as f32;
    let (low, high) = (side(&profile[..level]), side(&profile[profile.len() - level..]));
    let crossing = |share: f32| {
        let wanted = low + share * (high - low);
        let i = profile.windows(2).rposition(|pair| pair[0] <= wanted && pair[1] > wanted)?;
        Some(i as f32 + (wanted - profile[i]) / (profile[i + 1] - profile[i]))
    };
    Some(crossing(0.9)? - crossing(0.1)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::vec2;

    /// A plane with a slanted shadow whose penumbra is so many pixels wide.
    fn guides(width: f32) -> (ShadowGuides, Vec<[f32; 3]>) {
        let extent = [64, 48];
        let towards_light = vec2(0.8, 0.6);
        let seen = |i: usize| {
            let p = vec2((i % 64) as f32 + 0.5, (i / 64) as f32 + 0.5);
            (0.5 + (p - vec2(32.0, 24.0)).dot(towards_light) / width).clamp(0.0, 1.0)
        };
        let visibility: Vec<f32> = (0..64 * 48).map(seen).collect();
        let albedo: Vec<f32> = (0..64 * 48).map(|i| if i % 7 == 0 { 0.2 } else { 0.8 }).collect();
        let radiance = visibility.iter().zip(&albedo).map(|(v, a)| [a * (0.2 + v); 3]).collect();
        let (is_turned, depth, surface_id) = (vec![true; 64 * 48], vec![3.0; 64 * 48], vec![1; 64 * 48]);
        (ShadowGuides { extent, visibility, is_turned, albedo, depth, surface_id }, radiance)
    }

    #[test]
    fn a_width_is_that_of_the_penumbra() {
        // Narrower ones are as wide as the look-up between pixels.
        for width in [2.0, 3.0, 6.0] {
            let (guides, radiance) = guides(width);
            let edges = ShadowEdges::new(guides);
            let measured = edges.width(&radiance, &radiance).expect("profiles");
            // A ramp rises by eight tenths in that share of its width; between pixels it is a little wider.
            assert!((measured - 0.8 * width).abs() < 0.5, "{width}: {measured}");
            assert!(edges.profiles() > 20);
        }
    }

    #[test]
    fn a_picture_that_is_blurred_or_lags_has_a_wider_edge_and_an_error_in_the_band_alone() {
        let (given, radiance) = guides(2.0);
        let edges = ShadowEdges::new(given);
        let sharp = edges.width(&radiance, &radiance).expect("profiles");
        let blurred = guides(7.0).1;
        assert!(edges.width(&blurred, &radiance).expect("profiles") > sharp + 2.0);
        assert!(edges.error(&blurred, &radiance).expect("finite") > 0.05);
        let mut elsewhere = radiance.clone();
        elsewhere[0] = [9.0; 3];
        assert_eq!(edges.error(&elsewhere, &radiance).expect("finite"), 0.0);
        let share = edges.band.len() as f32 / (64.0 * 48.0);
        assert!(share > 0.2 && share < 0.5, "{share}");
    }

    #[test]
    fn another_surface_is_no_edge() {
        let (mut given, _) = guides(2.0);
        given.surface_id.iter_mut().enumerate().for_each(|(i, id)| *id = 1 + i as u32 % 2);
        given.is_turned.iter_mut().skip(64).for_each(|turned| *turned = false);
        assert!(ShadowEdges::new(given).band.is_empty());
    }
}
