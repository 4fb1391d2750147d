//! What is seen in mirrors and through flat glass, by the lengths of paths.
//!
//! Blender writes no hit distances, and its motion is that of the glass. But its depth for denoisers goes on at mirrors and through glass, up to the
//! first surface that is neither. What lies beyond a surface is a reflection's hit distance. What is seen through flat glass is seen straight on, and
//! moves as it does without the glass. A ball of glass turns its picture around, and what is seen in it has no motion that is known.

use crate::projection::Projection;
use crate::raster::Raster;
use crate::transmission::is_black;
use atrous::Input;
use std::collections::BTreeMap;

/// Share of the way to a surface from which on a path goes on behind it.
const GOES_ON: f32 = 0.02;
/// What a path meets that ends at no surface, in ways to the surface where it starts.
const SKY: f32 = 1e4;
/// The roughness of what a path goes on at: Blender has that of a lobe of at most 0.075, so at most 0.27 here.
const OF_MIRROR: f32 = 0.15;
/// As the library has it.
const UNKNOWN: f32 = -1.0;
/// The least part of the light that a mirror reflects: a path counts by it.
const LEAST_REFLECTED: f32 = 0.05;
/// How much a mirror may turn from pixel to pixel, in radians: of what is smaller, pixels beside each other show things that are far apart.
const MOST_CURVED: f32 = 0.06;
/// Pixels to each side of one whose path is known that are as flat.
const ASIDE: usize = 2;
/// Pixels to each side over which normals are compared.
const SIDE: usize = 3;
/// How much a normal may turn over the way that light goes on, in radians: glass is a lens otherwise, and a mirror curved.
const FLAT: f32 = 0.1;
/// Twice as far as 1/depth may depart from the mean of a pixel to each side, as a part of itself.
const BENT: f32 = 1e-4;
/// A shorter normal is a mean of several.
pub const OF_ONE: f32 = 0.98;

/// What is seen in flat mirrors and through flat glass.
#[derive(Debug)]
pub struct Through {
    /// Its depth, straight on.
    pub depth: Vec<Option<f32>>,
    /// Pixels of such mirrors and glass, where paths alone tell them.
    pub windows: Option<Vec<bool>>,
}

/// Surfaces, and how long paths go on behind them.
pub struct Paths<'a> {
    raster: Raster,
    ids: &'a [u32],
    /// Diffuse colour.
    base: &'a [[f32; 4]],
    /// Pixels of glass.
    transmits: Vec<bool>,
    normals: &'a [[f32; 4]],
    camera: Projection<'a>,
    /// Lengths of the ways to surfaces.
    first: Vec<f32>,
    /// Beyond these, where all pixels around show the same surface.
    beyond: Vec<f32>,
}

impl<'a> Paths<'a> {
    /// `lengths`: from the eye.
    pub fn new(
        raster: Raster,
        camera: Projection<'a>,
        lengths: &[f32],
        ids: &'a [u32],
        base: &'a [[f32; 4]],
        transmits: Vec<bool>,
        images: &'a BTreeMap<&'static str, Vec<[f32; 4]>>,
    ) -> Option<Self> {
        let (depth, normals) = (images.get("depth")?, images.get("normal")?);
        let first: Vec<f32> = (0..raster.pixels()).map(|i| camera.way(i, depth[i][0])).collect();
        let beyond = |i: usize| {
            let beyond = lengths[i] - first[i];
            let is_inner = ids[i] != 0 && raster.around(i, 1).all(|j| ids[j] == ids[i]);
            match lengths[i] {
                _ if !is_inner => 0.0,
                0.0 => SKY * first[i],
                _ if beyond > GOES_ON * first[i] => beyond,
                _ => 0.0,
            }
        };
        let beyond = (0..raster.pixels()).map(beyond).collect();
        Some(Self { raster, ids, base, transmits, normals, camera, first, beyond })
    }

    /// Hit distances of mirrors, and roughness: of mirrors, and of what is not known.
    pub fn mirrors(&self, coat: &[[f32; 4]]) -> [Vec<[f32; 4]>; 2] {
        let is_even = |i: usize| self.is_metal(i) && self.turn(i).is_some_and(|turn| turn < MOST_CURVED);
        let distance = |i: usize| {
            let reflected = coat[i][..3].iter().sum::<f32>() / 3.0;
            let is_known = self.beyond[i] > 0.0 && is_even(i);
            if is_known {
                self.beyond[i] / reflected.max(LEAST_REFLECTED)
            } else {
                UNKNOWN
            }
        };
        let distances: Vec<f32> = (0..self.raster.pixels()).map(distance).collect();
        let is_mirror = |i: usize| self.ids[i] != 0 && self.is_beside(i, |j| distances[j] > 0.0) && is_even(i);
        let roughness = (0..self.raster.pixels()).map(|i| [if is_mirror(i) { OF_MIRROR } else { UNKNOWN }; 4]).collect();
        [distances.iter().map(|distance| [*distance; 4]).collect(), roughness]
    }

    /// The depth that a pixel of flat glass has at what is seen through it; `None` elsewhere.
    pub fn through(&self) -> Vec<Option<f32>> {
        let depth = |i: usize| {
            let beyond = self.beyond[i];
            (beyond > 0.0 && self.transmits[i] && self.is_flat(i)).then(|| self.camera.depth(i, self.first[i] + beyond))
        };
        (0..self.raster.pixels()).map(depth).collect()
    }

    /// Where something is seen in mirrors and through glass, on surfaces that are mostly flat there. Normals for denoisers are of what is seen.
    pub fn windows(&self) -> Vec<bool> {
        let mut counts: BTreeMap<u32, [usize; 2]> = BTreeMap::new();
        for i in (0..self.raster.pixels()).filter(|i| self.beyond[*i] > 0.0) {
            let Some(is_plane) = self.is_plane(i) else { continue };
            let [all, flat] = counts.entry(self.ids[i]).or_default();
            (*all, *flat) = (*all + 1, *flat + usize::from(is_plane));
        }
        let is_flat = |id: &u32| counts.get(id).is_some_and(|[all, flat]| 2 * flat > *all);
        let is_window = |i: usize| is_flat(&self.ids[i]) && self.is_beside(i, |j| self.beyond[j] > 0.0);
        (0..self.raster.pixels()).map(is_window).collect()
    }

    /// Whether 1/depth is linear around a pixel, as on a plane; `None` where other surfaces are near.
    fn is_plane(&self, pixel: usize) -> Option<bool> {
        let [x, y] = self.raster.place(pixel);
        let nearness = |i: usize| 1.0 / self.camera.depth(i, self.first[i]);
        let (mut sums, mut counts) = ([0.0; 2], [0; 2]);
        for j in self.raster.around(pixel, SIDE).filter(|j| self.ids[*j] == self.ids[pixel]) {
            let [jx, jy] = self.raster.place(j);
            let axis = match (jx.abs_diff(x), jy.abs_diff(y)) {
                (SIDE, 0) => 0,
                (0, SIDE) => 1,
                _ => continue,
            };
            (sums[axis], counts[axis]) = (sums[axis] + nearness(j), counts[axis] + 1);
        }
        let own = nearness(pixel);
        (counts == [2; 2]).then(|| sums.iter().all(|sum| (sum - 2.0 * own).abs() < BENT * own))
    }

    /// Light of lamps and of the sky that is seen in flat mirrors: what `all`, Blender's albedo for denoisers, has there beyond what is reflected of
    /// surfaces. Glass has two lobes, and which of them a sample takes is noise.
    pub fn emission(&self, all: &[[f32; 4]], coat: &[[f32; 4]]) -> Vec<[f32; 4]> {
        let is_known = |i: usize| self.beyond[i] > 0.0 && self.is_metal(i) && self.is_flat(i);
        let known: Vec<bool> = (0..self.raster.pixels()).map(is_known).collect();
        let seen = |i: usize| match self.is_metal(i) && self.is_beside(i, |j| known[j]) {
            true => std::array::from_fn(|c| (all[i][c] - coat[i][c]).max(0.0)),
            false => [0.0; 4],
        };
        (0..self.raster.pixels()).map(seen).collect()
    }

    fn is_metal(&self, pixel: usize) -> bool {
        is_black(&self.base[pixel]) && !self.transmits[pixel]
    }

    /// Whether one of the pixels around that show the same surface is so.
    fn is_beside(&self, pixel: usize, is_so: impl Fn(usize) -> bool) -> bool {
        self.raster.around(pixel, ASIDE).any(|j| self.ids[j] == self.ids[pixel] && is_so(j))
    }

    /// Whether the surface turns so little over the way that light goes on that it is no lens.
    fn is_flat(&self, pixel: usize) -> bool {
        let turned = |turn: f32| turn * self.beyond[pixel] / (self.camera.pixel() * self.first[pixel]);
        self.turn(pixel).is_some_and(|turn| turned(turn) < FLAT)
    }

    /// How much the normal turns from pixel to pixel, in radians, along the axis where it turns most; `None` on outlines.
    fn turn(&self, pixel: usize) -> Option<f32> {
        let normal = |i: usize| {
            Some(glam::Vec3::from_slice(&self.normals[i][..3])).filter(|n| n.length() > OF_ONE).map(glam::Vec3::normalize)
        };
        let (own, [x, y]) = (normal(pixel)?, self.raster.place(pixel));
        let is_beside = |j: &usize| {
            let [jx, jy] = self.raster.place(*j);
            matches!((jx.abs_diff(x), jy.abs_diff(y)), (SIDE, 0) | (0, SIDE)) && self.ids[*j] == self.ids[pixel]
        };
        let turns = self.raster.around(pixel, SIDE).filter(is_beside).filter_map(normal).map(|beside| beside.distance(own));
        let (count, most) = turns.fold((0, 0.0_f32), |(count, most), turn| (count + 1, most.max(turn)));
        (count > 1).then(|| most / SIDE as f32)
    }
}

/// Puts hit distances and roughness beside the images, where those are not given.
pub fn add_mirrors(images: &mut BTreeMap<&'static str, Vec<[f32; 4]>>, [distances, roughness]: [Vec<[f32; 4]>; 2]) {
    let (of_distance, of_roughness) = (Input::SPECULAR_HIT_DISTANCE.name, Input::ROUGHNESS.name);
    let is_seen = distances.iter().any(|distance| distance[0] > 0.0);
    if is_seen && !images.contains_key(of_distance) && !images.contains_key(of_roughness) {
        images.extend([(of_distance, distances), (of_roughness, roughness)]);
    }
}
