//! The albedo of what light passes through, such as glass: its diffuse colour is black, but other light than specular comes from it.
//!
//! A pixel at its rim shows a part of something else as well, and has a part of that albedo. Light of the glass, divided by so little, would
//! shine in each pixel whose albedo is more.

use crate::raster::Raster;
use crate::setup::Setup;
use std::collections::BTreeMap;

/// The largest component of a black diffuse colour.
const BLACK: f32 = 1e-3;
/// The least share of a pixel's light that is no rounding error of its parts.
const LIT: f32 = 0.02;

/// What tells it from other surfaces. All images have the size of the raster.
pub struct Transmission<'a> {
    raster: Raster,
    /// Ids of surfaces; 0 in the background.
    ids: &'a [u32],
    /// Diffuse colour.
    base: &'a [[f32; 4]],
    /// Light that is divided by the albedo.
    light: &'a [[f32; 4]],
    /// Specular light, where that is filtered apart.
    specular: Option<&'a [[f32; 4]]>,
}

impl<'a> Transmission<'a> {
    /// None where light has other pixels than the diffuse colour `base`.
    pub fn new(
        setup: &Setup,
        ids: &'a [u32],
        base: &'a [[f32; 4]],
        images: &'a BTreeMap<&'static str, Vec<[f32; 4]>>,
    ) -> Option<Self> {
        if setup.is_verbatim() || setup.config.light_extent.is_some() {
            return None;
        }
        let light = ["noisy_diffuse", "noisy_indirect", "noisy_radiance"].into_iter().find_map(|name| images.get(name))?;
        Some(Self {
            raster: Raster::new(setup.config.allocated_extent),
            ids,
            base,
            light,
            specular: images.get("noisy_specular").map(Vec::as_slice),
        })
    }

    /// Of each pixel: whether its surface is black and lit, there or in a pixel beside it.
    pub fn pixels(&self) -> Vec<bool> {
        let is_lit = |i: usize| {
            let (light, specular) = (largest(&self.light[i]), self.specular.map_or(0.0, |specular| largest(&specular[i])));
            is_black(&self.base[i]) && light > LIT * (light + specular)
        };
        let lit: Vec<bool> = (0..self.raster.pixels()).map(is_lit).collect();
        let transmits = |i: usize| self.ids[i] != 0 && self.raster.around(i, 1).any(|j| lit[j] && self.ids[i] == self.ids[j]);
        (0..lit.len()).map(transmits).collect()
    }

    /// Pixels of what transmits that have a part of the diffuse colour of something beside it.
    pub fn rim(&self) -> Vec<usize> {
        let is_part = |i: usize, j: usize| self.ids[i] != self.ids[j] && largest(&self.base[i]) <= largest(&self.base[j]);
        let transmits = self.pixels();
        (0..transmits.len()).filter(|i| transmits[*i] && self.raster.around(*i, 1).any(|j| is_part(*i, j))).collect()
    }
}

pub fn is_black(base: &[f32; 4]) -> bool {
    largest(base) < BLACK
}

/// The albedo of light that passes, and of the diffuse colour beside it. `all` follows light into glass: it is of the surfaces behind, and of
/// those that are reflected, each by its share of the light. The share of the latter is `coat`.
pub fn behind(all: [f32; 4], base: [f32; 4], coat: [f32; 4]) -> [f32; 4] {
    std::array::from_fn(|c| base[c] + (all[c].min(1.0) - base[c]).max(0.0) * (1.0 - coat[c]).clamp(0.0, 1.0))
}

pub fn largest([r, g, b, _]: &[f32; 4]) -> f32 {
    r.max(*g).max(*b)
}

#[cfg(test)]
mod tests {
    use super::*;

    const GLASS: u32 = 7;
    const WALL: u32 = 8;

    /// A row: four pixels of glass, of which the last one shows the wall as well, and three of the wall.
    fn row(light: [f32; 7], specular: [f32; 7]) -> (Vec<u32>, [Vec<[f32; 4]>; 3]) {
        let ids = vec![GLASS, GLASS, GLASS, GLASS, WALL, WALL, WALL];
        let texels = |values: [f32; 7]| values.map(|v| [v, v, v, 0.0]).to_vec();
        (ids, [texels([0.0, 0.0, 0.0, 0.1, 0.6, 0.6, 0.6]), texels(light), texels(specular)])
    }

    fn rim(light: [f32; 7], specular: [f32; 7]) -> Vec<usize> {
        let (ids, [base, light, specular]) = row(light, specular);
        Transmission { raster: Raster::new([7, 1]), ids: &ids, base: &base, light: &light, specular: Some(&specular) }.rim()
    }

    #[test]
    fn the_rim_of_glass_has_a_part_of_the_colour_beside_it() {
        assert_eq!(rim([0.5; 7], [0.1; 7]), [3]);
    }

    #[test]
    fn a_mirror_transmits_nothing() {
        assert_eq!(rim([1e-6, 1e-6, 1e-6, 0.1, 0.5, 0.5, 0.5], [1.0; 7]), [0; 0]);
    }

    #[test]
    fn the_background_transmits_nothing() {
        let (_, [base, light, _]) = row([0.5; 7], [0.0; 7]);
        let transmission = Transmission { raster: Raster::new([7, 1]), ids: &[0; 7], base: &base, light: &light, specular: None };
        assert_eq!(transmission.pixels(), [false; 7]);
    }

    #[test]
    fn what_is_behind_glass_is_seen_by_what_is_not_reflected() {
        let [red, .., alpha] = behind([0.5, 0.5, 0.5, 0.0], [0.1, 0.1, 0.1, 0.0], [0.25, 0.25, 0.25, 0.0]);
        assert_eq!((red, alpha), (0.1 + 0.4 * 0.75, 0.0));
        // Less than the diffuse colour alone is noise.
        assert_eq!(behind([0.0; 4], [0.1; 4], [2.0; 4]), [0.1; 4]);
    }
}
