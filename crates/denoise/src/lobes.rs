//! Light of surfaces that have no albedo, in frames with all light in one picture.
//!
//! Many renderers write the albedo of diffuse light. That of mirrors and of glass is black. For rough metal Mitsuba writes the value of the lobe
//! towards the normal, from 0 at the rim of a ball to 10 in its middle: divided by that, even light is not even. The light of such surfaces is what is
//! seen in them or through them. So it is filtered as specular light, with a white albedo. The same goes for pixels that show such a surface or the
//! background beside something else: their albedo is that of a part of their light.

use crate::gaps;
use crate::paths::OF_ONE;
use crate::raster::Raster;
use crate::transmission::{is_black, largest};
use std::collections::BTreeMap;

/// An albedo above that is no reflectance: a little more is rounding, or a painter's colour.
pub const ABOVE: f32 = 1.05;
/// The least relative difference of pixels beside each other in a lobe: what is above 1 all over a surface is a wrong number.
pub const VARIED: f32 = 0.01;
/// The share of such pixels of a surface that makes it one of a lobe.
const LEAST_ABOVE: f32 = 0.005;
/// What reflects less is no paint: half of the pixels of a lobe may lie in its tail.
const DARK: f32 = 0.02;
/// The same beside a pixel of a lobe.
const DIM: f32 = 0.05;
/// The cosine between normals of pixels beside each other that show one surface.
const SAME: f32 = 0.7;
/// Their depths, the farther over the nearer.
const SAME_DEPTH: f32 = 1.1;
/// Pixels to each side among which the surfaces of a pixel that shows several are found: out of focus they are far apart.
const REACH: usize = 4;

/// The number of the background among surfaces.
const OPEN: u32 = 0;
/// That of surfaces without a normal: of what shows the sky, where normals are those of what is seen.
const UNSEEN: u32 = u32::MAX - 1;
/// That of pixels that show several.
const SEVERAL: u32 = u32::MAX;

type Texels = Vec<[f32; 4]>;

/// What a pixel shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shown {
    /// Nothing.
    Background,
    /// Surfaces with an albedo.
    Diffuse,
    /// A surface without one.
    Lobe,
    /// Several surfaces, of which one has none, or surfaces beside the background.
    Part,
}

impl Shown {
    fn has_albedo(self) -> bool {
        matches!(self, Self::Background | Self::Diffuse)
    }
}

/// Knowledge of the surfaces of a frame beside its images.
pub struct Told {
    pub raster: Raster,
    /// Depth from which on there is no surface.
    pub far: f32,
    /// Numbers of surfaces; means of several at outlines.
    pub numbers: Option<Vec<f32>>,
    /// Flat mirrors and flat glass, where the albedo is that of what is seen, and not black.
    pub windows: Option<Vec<bool>>,
}

/// Surfaces of a frame.
struct Surfaces<'a> {
    told: Told,
    albedo: &'a Texels,
    /// Of length 1 where a pixel shows one surface.
    normals: &'a Texels,
    depth: &'a Texels,
}

/// Of each pixel, what it shows; `None` without the images that tell.
pub fn shown(images: &BTreeMap<&'static str, Texels>, told: Told) -> Option<Vec<Shown>> {
    let [albedo, normals, depth] = ["albedo", "normal", "depth"].map(|name| images.get(name));
    Some(Surfaces { told, albedo: albedo?, normals: normals?, depth: depth? }.shown())
}

impl Surfaces<'_> {
    fn shown(&self) -> Vec<Shown> {
        let surfaces = self.numbered();
        let is_none = self.told.windows.clone().unwrap_or_else(|| self.without_albedo(&surfaces));
        let of_one = |i: usize| match surfaces[i] {
            OPEN => Shown::Background,
            _ if is_none[i] => Shown::Lobe,
            _ => Shown::Diffuse,
        };
        let of_several = |i: usize| {
            let around = |reach: usize| self.told.raster.around(i, reach).filter(|j| surfaces[*j] != SEVERAL);
            let has_two = |reach: &usize| {
                let first = around(*reach).next();
                first.is_some_and(|first| around(*reach).any(|j| surfaces[j] != surfaces[first]))
            };
            let reach = (1..REACH).find(has_two).unwrap_or(REACH);
            if around(reach).any(|j| of_one(j) != Shown::Diffuse) {
                Shown::Part
            } else {
                Shown::Diffuse
            }
        };
        (0..surfaces.len()).map(|i| if surfaces[i] == SEVERAL { of_several(i) } else { of_one(i) }).collect()
    }

    /// Of each pixel, whether its surface has no albedo.
    fn without_albedo(&self, surfaces: &[u32]) -> Vec<bool> {
        let of_lobes = self.of_lobes(surfaces);
        let is_dim = |i: usize| largest(&self.albedo[i]) < DIM;
        let is_none = |i: usize| {
            is_black(&self.albedo[i]) || (surfaces[i] == UNSEEN && is_dim(i)) || of_lobes.get(&surfaces[i]) == Some(&true)
        };
        let none: Vec<bool> = (0..surfaces.len()).map(is_none).collect();
        // Of several samples, a few may have met something else than the sky.
        let is_beside = |i: usize| {
            let around = self.told.raster.around(i, 1);
            around.filter(|j| none[*j] && surfaces[*j] != OPEN).any(|j| self.is_near(i, j))
        };
        (0..none.len()).map(|i| none[i] || (is_dim(i) && is_beside(i))).collect()
    }

    /// Whether two pixels have nearly the same depth.
    fn is_near(&self, i: usize, j: usize) -> bool {
        let (a, b) = (self.depth[i][0], self.depth[j][0]);
        a.max(b) < SAME_DEPTH * a.min(b)
    }

    fn normal(&self, pixel: usize) -> glam::Vec3 {
        glam::Vec3::from_slice(&self.normals[pixel][..3])
    }

    /// Of each pixel, the number of its surface.
    fn numbered(&self) -> Vec<u32> {
        let is_one = |i: usize| self.normal(i).length() > OF_ONE;
        let number = |i: usize| match &self.told.numbers {
            None if is_one(i) => None,
            None if self.normal(i) == glam::Vec3::ZERO => Some(UNSEEN),
            // A mean may be whole as well, but no pixel around it has that number.
            Some(numbers) if numbers[i].fract() == 0.0 => {
                let is_so = self.told.raster.around(i, 1).any(|j| is_one(j) && numbers[j] == numbers[i]);
                Some(if is_so { (numbers[i] as u32).saturating_add(1).min(UNSEEN - 1) } else { SEVERAL })
            }
            _ => Some(SEVERAL),
        };
        let of = |i: usize| if gaps::is_surface(self.depth[i][0], self.told.far) { number(i) } else { Some(OPEN) };
        self.connected((0..self.told.raster.pixels()).map(of).collect())
    }

    /// Numbers those that have none, by the pixels beside each other that are alike.
    fn connected(&self, mut numbers: Vec<Option<u32>>) -> Vec<u32> {
        let is_same = |i: usize, j: usize| self.normal(i).dot(self.normal(j)) > SAME && self.is_near(i, j);
        let (mut number, mut open) = (OPEN, Vec::new());
        for start in 0..numbers.len() {
            if numbers[start].is_some() {
                continue;
            }
            number += 1;
            numbers[start] = Some(number);
            open.push(start);
            while let Some(i) = open.pop() {
                for j in self.told.raster.beside(i).filter(|j| is_same(i, *j)) {
                    if numbers[j].is_none() {
                        numbers[j] = Some(number);
                        open.push(j);
                    }
                }
            }
        }
        numbers.into_iter().map(|number| number.unwrap_or(SEVERAL)).collect()
    }

    /// Of each surface, whether its albedo is none.
    fn of_lobes(&self, surfaces: &[u32]) -> BTreeMap<u32, bool> {
        let mut counts: BTreeMap<u32, [f32; 3]> = BTreeMap::new();
        for (i, surface) in surfaces.iter().enumerate().filter(|(_, surface)| !matches!(**surface, OPEN | UNSEEN | SEVERAL)) {
            let own = largest(&self.albedo[i]);
            let differs = |j: usize| surfaces[j] == *surface && (largest(&self.albedo[j]) - own).abs() > VARIED * own;
            let is_above = own > ABOVE && self.told.raster.beside(i).any(differs);
            let [pixels, above, dark] = counts.entry(*surface).or_default();
            *pixels += 1.0;
            *above += f32::from(u8::from(is_above));
            *dark += f32::from(u8::from(own < DARK));
        }
        let is_none = |[pixels, above, dark]: [f32; 3]| above > LEAST_ABOVE * pixels || 2.0 * dark > pixels;
        counts.into_iter().map(|(surface, counts)| (surface, is_none(counts))).collect()
    }
}

/// Parts the light in `noisy_diffuse` into that of surfaces with an albedo and that of others. Returns 1 for the former and 2 for the latter; 0 in
/// the background.
pub fn part(images: &mut BTreeMap<&'static str, Texels>, told: Told) -> Option<Vec<u32>> {
    let is_known = told.windows.is_some();
    let shown = shown(images, told)?;
    let [light, albedo] = ["noisy_diffuse", "albedo"].map(|name| images.get(name));
    let (light, albedo) = (light?, albedo?);
    let of = |image: &Texels, has_albedo: bool| -> Texels {
        image.iter().zip(&shown).map(|(texel, shown)| if shown.has_albedo() == has_albedo { *texel } else { [0.0; 4] }).collect()
    };
    let white = vec![[1.0; 4]; light.len()];
    let kind = |shown: &Shown| match shown {
        Shown::Background => 0,
        shown => 1 + u32::from(!shown.has_albedo()),
    };
    let kinds = shown.iter().map(kind).collect();
    let parts = [
        ("noisy_diffuse", of(light, true)),
        ("noisy_specular", of(light, false)),
        ("albedo", of(albedo, true)),
        ("specular_albedo", of(if is_known { albedo } else { &white }, false)),
    ];
    images.extend(parts);
    Some(kinds)
}

/// Takes all light for that of surfaces without an albedo.
pub fn take_all(images: &mut BTreeMap<&'static str, Texels>) {
    let Some(light) = images.remove("noisy_diffuse") else { return };
    images.insert("noisy_diffuse", vec![[0.0; 4]; light.len()]);
    images.insert("noisy_specular", light);
}

/// Ids of surfaces that differ where their kinds do.
pub fn told_apart(ids: Option<Vec<u32>>, kinds: Vec<u32>) -> Vec<u32> {
    let of_both = |(id, kind): (u32, u32)| if kind == 0 { 0 } else { id.saturating_mul(2).saturating_add(kind) };
    match ids {
        Some(ids) => ids.into_iter().zip(kinds).map(of_both).collect(),
        None => kinds,
    }
}

#[cfg(test)]
mod tests {
    use super::Shown::{Background, Diffuse, Lobe, Part};
    use super::*;

    /// A row of pixels: albedo, z of the normal, depth, number.
    fn shown<const N: usize>(row: [(f32, f32, f32, f32); N], has_numbers: bool) -> Vec<Shown> {
        let texels = |of: fn((f32, f32, f32, f32)) -> [f32; 4]| row.map(of).to_vec();
        let (albedo, depth) = (texels(|p| [p.0, p.0, p.0, 0.0]), texels(|p| [p.2; 4]));
        let normals = texels(|p| [0.0, 0.0, p.1, 0.0]);
        let numbers = has_numbers.then(|| row.map(|p| p.3).to_vec());
        let told = Told { raster: Raster::new([N as u32, 1]), far: 1e9, numbers, windows: None };
        Surfaces { told, albedo: &albedo, normals: &normals, depth: &depth }.shown()
    }

    #[test]
    fn a_lobe_is_one_all_over_its_surface() {
        let rim = (0.3, 1.0, 2.0, 7.0);
        let wall = (0.3, 1.0, 4.0, 8.0);
        for has_numbers in [true, false] {
            assert_eq!(shown([wall, rim, (9.0, 1.0, 2.0, 7.0), rim, wall], has_numbers), [Diffuse, Lobe, Lobe, Lobe, Diffuse]);
        }
        // Rough metal that is seen from the side has the tail of its lobe alone.
        let tail = (0.01, 1.0, 2.0, 7.0);
        assert_eq!(shown([wall, tail, (0.03, 1.0, 2.0, 7.0), tail, wall], true), [Diffuse, Lobe, Lobe, Lobe, Diffuse]);
    }

    #[test]
    fn black_is_no_albedo_on_any_surface() {
        let wall = (0.5, 1.0, 4.0, 8.0);
        assert_eq!(shown([wall, wall, (0.0, 1.0, 4.0, 8.0), wall, wall], true), [Diffuse, Diffuse, Lobe, Diffuse, Diffuse]);
    }

    #[test]
    fn what_shows_a_part_of_a_lobe_or_of_the_background_has_the_albedo_of_a_part() {
        let (mirror, wall, sky) = ((0.0, 1.0, 2.0, 7.0), (0.5, 1.0, 4.0, 8.0), (0.0, 0.0, 0.0, 0.0));
        let both = |z: f32, number: f32| (0.25, z, 3.0, number);
        assert_eq!(shown([mirror, both(0.9, 7.5), wall], true), [Lobe, Part, Diffuse]);
        assert_eq!(shown([mirror, both(0.9, 0.0), wall], false), [Lobe, Part, Diffuse]);
        assert_eq!(shown([wall, both(0.5, 4.5), sky], true), [Diffuse, Part, Background]);
        assert_eq!(shown([wall, both(0.9, 8.5), (0.5, 1.0, 4.0, 9.0)], true), [Diffuse; 3]);
    }

    /// Out of focus, several pixels beside each other show the same two surfaces.
    #[test]
    fn surfaces_of_a_pixel_are_found_further_off() {
        let (mirror, wall, both) = ((0.0, 1.0, 2.0, 7.0), (0.5, 1.0, 4.0, 8.0), (0.25, 0.9, 3.0, 7.5));
        assert_eq!(shown([mirror, both, both, both, wall], true), [Lobe, Part, Part, Part, Diffuse]);
        assert_eq!(shown([wall, both, both, both, wall], true), [Diffuse; 5]);
        let (sky, part) = ((0.0, 0.0, 0.0, 0.0), (0.1, 0.5, 2.0, 4.5));
        assert_eq!(shown([sky, part, part, part, part, part], true), [Background, Part, Part, Part, Part, Diffuse]);
    }

    /// Half of 7 and 9 is the number of a mirror elsewhere.
    #[test]
    fn a_mean_that_is_whole_is_a_mean() {
        let (a, b, mirror) = ((0.5, 1.0, 2.0, 7.0), (0.5, 1.0, 4.0, 9.0), (0.0, 1.0, 3.0, 8.0));
        assert_eq!(shown([mirror, mirror, a, a, (0.5, 0.9, 3.0, 8.0), b], true)[4], Diffuse);
        // The rim of a ball that is small turns within a pixel, too.
        assert_eq!(shown([(0.5, 1.0, 3.0, 8.0), (0.0, 0.97, 3.0, 8.0), (0.0, 1.0, 3.0, 8.0)], true)[1], Lobe);
    }

    /// LuxCore's albedo and normal are those of what is seen, and the sky has none.
    #[test]
    fn the_sky_in_a_mirror_has_no_albedo() {
        let (mirror, glass, wall) = ((0.0, 0.0, 2.0, 0.0), (0.04, 0.0, 2.0, 0.0), (0.5, 1.0, 4.0, 0.0));
        let (floor, dim) = ((0.1, 1.0, 2.0, 0.0), (0.04, 1.0, 2.0, 0.0));
        assert_eq!(shown([mirror, mirror, wall, wall], false), [Lobe, Lobe, Diffuse, Diffuse]);
        // A few of the samples of a pixel meet the floor.
        assert_eq!(shown([glass, dim, dim, floor, (0.1, 0.0, 2.0, 0.0)], false), [Lobe, Lobe, Diffuse, Diffuse, Diffuse]);
        assert_eq!(shown([glass, (0.04, 1.0, 4.0, 0.0), wall], false), [Lobe, Diffuse, Diffuse], "behind it");
    }

    #[test]
    fn surfaces_at_other_depths_are_others() {
        let (metal, wall) = ((9.0, 1.0, 2.0, 0.0), (0.5, 1.0, 4.0, 0.0));
        assert_eq!(shown([metal, (8.0, 1.0, 2.0, 0.0), wall, wall], false), [Lobe, Lobe, Diffuse, Diffuse]);
    }

    #[test]
    fn kinds_tell_ids_apart() {
        assert_eq!(told_apart(Some(vec![3, 3, 4, 9]), vec![1, 2, 2, 0]), [7, 8, 10, 0]);
        assert_eq!(told_apart(None, vec![1, 2, 0]), [1, 2, 0]);
    }
}
