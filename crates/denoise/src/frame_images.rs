//! The images of a frame, from the channels of its file.

use crate::camera::Camera;
use crate::exr_read::Samples;
use crate::layouts::Layout;
use crate::paths::{self, Paths, Through};
use crate::projection::Projection;
use crate::raster::Raster;
use crate::roles::Role;
use crate::setup::Setup;
use crate::transmission::{behind, is_black, Transmission};
use atrous::config::{DepthEncoding, MotionDepth, NormalSpace, Signals, ViewForward};
use atrous::{FrameParams, Input};
use std::collections::BTreeMap;

/// Texels of an image.
pub type Texels = Vec<[f32; 4]>;

pub fn rgb(texels: Texels) -> Vec<[f32; 3]> {
    let finite = |v: f32| if v.is_finite() { v } else { 0.0 };
    texels.into_iter().map(|[r, g, b, _]| [r, g, b].map(finite)).collect()
}

/// The planes of a frame, turned into images one role at a time.
pub struct Channels<'a> {
    /// The setup of the sequence.
    pub setup: &'a Setup,
    /// Samples by the name of the channel.
    pub samples: BTreeMap<String, Samples>,
    /// Pixels that were not finite and became 0.
    pub replaced: BTreeMap<Role, usize>,
}

impl Channels<'_> {
    pub fn vectors(&mut self, role: Role) -> Option<Texels> {
        let names = self.setup.mapping.roles.get(&role)?;
        let mut texels = vec![[0.0; 4]; self.setup.pixels()];
        let mut bad = vec![false; texels.len()];
        for (component, name) in names.iter().enumerate().take(role.kind().components()) {
            let Some(Samples::Float(values)) = self.samples.get(name) else { return None };
            for ((texel, value), bad) in texels.iter_mut().zip(values).zip(&mut bad) {
                // An infinite depth is the sky, or nothing in the way; what is no visibility, the filter counts itself.
                let is_distance =
                    matches!(role, Role::Depth | Role::OccluderDistance(_) | Role::AmbientDistance) && !value.is_nan();
                let usable = self.setup.is_verbatim()
                    || value.is_finite()
                    || is_distance
                    || matches!(role, Role::Visibility(_) | Role::Ambient);
                *bad |= !usable;
                texel[component] = if usable { *value } else { 0.0 };
            }
        }
        let count = bad.iter().filter(|b| **b).count();
        if count > 0 {
            if let Some(white) = role.stand_in() {
                // The filter takes an albedo that it does not know for white as well, and keeps the light there apart.
                let value = if role == Role::Albedo { f32::NAN } else { white };
                texels.iter_mut().zip(&bad).filter(|(_, bad)| **bad).for_each(|(texel, _)| *texel = [value; 4]);
            }
            self.replaced.insert(role, count);
        }
        Some(texels)
    }

    pub fn scalars(&mut self, role: Role) -> Option<Vec<f32>> {
        self.vectors(role).map(|texels| texels.into_iter().map(|t| t[0]).collect())
    }

    /// Emitters and what is seen behind everything.
    pub fn emission(&mut self) -> Option<Texels> {
        let parts = (self.vectors(Role::Emission), self.vectors(Role::Environment));
        sum(parts)
    }

    /// Light of a medium.
    pub fn volume(&mut self) -> Option<Texels> {
        let parts = (self.vectors(Role::Volume), self.vectors(Role::VolumeIndirect));
        sum(parts)
    }

    /// Direct light: as it is, or from its demodulated form.
    pub fn direct(&mut self) -> Option<Texels> {
        if self.setup.mapping.has(Role::Direct) {
            return self.vectors(Role::Direct);
        }
        let (light, colour) = (self.vectors(Role::DemodulatedDirect)?, self.vectors(Role::DiffuseColour)?);
        Some(combine(&light, &colour, |a, b| a * b))
    }

    /// Specular light: as it is, or from its demodulated form.
    pub fn specular(&mut self) -> Option<Texels> {
        if self.setup.mapping.has(Role::Specular) {
            return self.vectors(Role::Specular);
        }
        let direct = self.vectors(Role::DemodulatedSpecularDirect)?;
        let (indirect, colour) = (self.vectors(Role::DemodulatedSpecularIndirect)?, self.vectors(Role::SpecularAlbedo)?);
        Some(combine(&combine(&direct, &indirect, |a, b| a + b), &colour, |a, b| a * b))
    }

    /// The picture without what is not filtered with it, and that: parts are never more than the
    /// whole, so that their sum is the picture also where a renderer left one of them out of it. Light of fewer pixels says that of
    /// those alone that were traced, and emission is there for all.
    fn whole(&mut self) -> (Option<Texels>, Option<Texels>) {
        let (noisy, emission) = (self.vectors(Role::Noisy), self.emission());
        let Some(noisy) = noisy.filter(|_| !self.setup.mapping.has(Role::Lighting)) else {
            return (None, emission);
        };
        let is_whole = self.setup.is_verbatim() || self.setup.config.light_extent.is_some();
        let emission = emission.map(|emission| if is_whole { emission } else { within(&emission, &noisy) });
        let mut left = without(&noisy, &emission);
        if self.setup.config.volume && self.setup.mapping.layout == Layout::Blender {
            let volume = self.volume().map(|volume| within(&volume, &left));
            left = without(&left, &volume);
        }
        (Some(left), emission)
    }

    /// The images of light.
    pub fn lighting(&mut self, images: &mut BTreeMap<&'static str, Texels>) {
        let (whole, emission) = self.whole();
        let has = |role: Role| self.setup.mapping.has(role);
        let both = has(Role::Direct) && has(Role::Indirect);
        match (self.setup.config.signals, both) {
            (Signals::Specular, _) => {
                let (diffuse, specular) = (self.vectors(Role::Diffuse), self.specular());
                let specular = match (&diffuse, &whole) {
                    (None, Some(whole)) => specular.map(|specular| within(&specular, whole)),
                    _ => specular,
                };
                let diffuse = diffuse.or_else(|| whole.map(|whole| without(&whole, &specular)));
                images.extend(diffuse.map(|d| ("noisy_diffuse", d)));
                images.extend(specular.map(|s| ("noisy_specular", s)));
            }
            (Signals::Apart, true) => {
                images.extend(self.vectors(Role::Direct).map(|d| ("noisy_direct", d)));
                images.extend(self.vectors(Role::Indirect).map(|d| ("noisy_indirect", d)));
            }
            // What is neither emission nor direct is called indirect, so that nothing is lost.
            (Signals::Apart, false) => {
                let direct = self.direct();
                if let Some(whole) = whole {
                    let direct = direct.map(|direct| within(&direct, &whole));
                    images.insert("noisy_indirect", without(&whole, &direct));
                    images.extend(direct.map(|d| ("noisy_direct", d)));
                }
            }
            (_, true) => {
                let parts = (self.vectors(Role::Direct), self.vectors(Role::Indirect));
                images.extend(sum(parts).map(|both| ("noisy_radiance", both)));
            }
            (_, false) if has(Role::Lighting) => {
                images.extend(self.vectors(Role::Lighting).map(|l| ("noisy_radiance", l)));
            }
            (_, false) => images.extend(whole.map(|whole| ("noisy_radiance", whole))),
        }
        images.extend(emission.map(|e| ("emission", e)));
    }

    pub fn guides(&mut self, camera: Option<&Camera>, images: &mut BTreeMap<&'static str, Texels>) {
        let pixels = self.setup.pixels();
        let signals = self.setup.config.signals;
        let is_mixed = signals == Signals::Mixed;
        let has_coat = signals == Signals::Specular || (is_mixed && self.setup.mapping.has(Role::SpecularAlbedo));
        // In every channel, since the conventions may be those of a host's image.
        images.extend(self.scalars(Role::Roughness).map(|r| ("roughness", r.into_iter().map(|r| [r; 4]).collect())));
        if has_coat {
            images.extend(self.vectors(Role::SpecularAlbedo).map(|a| ("specular_albedo", a)));
        }
        if has_coat || is_mixed {
            images.extend(self.vectors(Role::HitDistance).map(|d| ("specular_hit_distance", d)));
            images.extend(self.vectors(Role::HitMotion).map(|m| (Input::SPECULAR_MOTION.name, m)));
        }
        let mut normal = self.vectors(Role::Normal).unwrap_or_else(|| vec![[0.0, 0.0, 1.0, 0.0]; pixels]);
        if self.setup.mapping.layout == Layout::Blender && self.setup.mapping.is_for_denoisers(Role::Normal) {
            // Their space looks along +z.
            normal.iter_mut().for_each(|n| n[2] = -n[2]);
        }
        images.insert("normal", normal);
        images.extend(self.vectors(Role::ObjectNormal).map(|n| ("object_normal", n)));
        let mut depth = self.vectors(Role::Depth).or_else(|| self.depth_of_positions(camera));
        if self.setup.config.conventions.depth != DepthEncoding::Device {
            depth.iter_mut().flatten().for_each(|z| z[0] *= self.setup.scales.depth);
        }
        // Without depth, nothing is where there is no normal.
        let has_surface = |normal: &[f32; 4]| normal[..3] != [0.0; 3];
        let depth = depth.unwrap_or_else(|| images["normal"].iter().map(|n| [f32::from(u8::from(has_surface(n))); 4]).collect());
        images.insert("depth", depth);
        let albedo = self.albedo(has_coat, images);
        images.extend(albedo.map(|a| ("albedo", a)));
        self.lamps(images);
        if let Some(motion) = self.motion(camera.is_some()) {
            images.insert("motion", motion);
        }
    }

    /// The reflectance of what is filtered with it.
    fn albedo(&mut self, is_specular: bool, images: &BTreeMap<&'static str, Texels>) -> Option<Texels> {
        let is_for_denoisers = self.setup.mapping.is_for_denoisers(Role::Albedo);
        let all = self.albedo_of_surfaces();
        let (base, coat) = (self.vectors(Role::DiffuseColour), self.vectors(Role::SpecularAlbedo).filter(|_| is_specular));
        let (Some(all), Some(base), Some(coat)) = (&all, &base, coat) else { return all.or(base) };
        let ids = is_for_denoisers.then(|| self.surface_ids(images)).flatten();
        let transmits = ids.and_then(|ids| Some(Transmission::new(self.setup, &ids, base, images)?.pixels()));
        let of_pixel = |i: usize| match &transmits {
            Some(transmits) if transmits[i] => behind(all[i], base[i], coat[i]),
            _ if is_black(&base[i]) => base[i],
            _ => std::array::from_fn(|c| (all[i][c].min(1.0) - coat[i][c]).max(base[i][c])),
        };
        Some((0..all.len()).map(of_pixel).collect())
    }

    /// The albedo of base and coat, which Blender's for denoisers has lamps and the sky in as well.
    fn albedo_of_surfaces(&mut self) -> Option<Texels> {
        let all = self.vectors(Role::Albedo)?;
        if !self.setup.mapping.is_for_denoisers(Role::Albedo) {
            return Some(all);
        }
        // Where one of them is a part of a pixel, light that is filtered would be multiplied by them.
        let (emission, hidden) = (self.emission(), self.vectors(Role::HiddenEnvironment));
        Some(without(&without(&all, &emission), &hidden))
    }

    /// Without a pass of emission, lamps are where Blender's albedo for denoisers is above 1.
    fn lamps(&mut self, images: &mut BTreeMap<&'static str, Texels>) {
        let mapping = &self.setup.mapping;
        if mapping.has(Role::Emission) || !mapping.is_for_denoisers(Role::Albedo) || self.setup.config.light_extent.is_some() {
            return;
        }
        let Some(albedo) = images.get("albedo") else { return };
        let above: Texels = albedo.iter().map(|texel| texel.map(|v| (v - 1.0).max(0.0))).collect();
        let light = ["noisy_radiance", "noisy_diffuse", "noisy_indirect"].into_iter().find(|name| images.contains_key(name));
        if let Some(light) = light.filter(|_| above.iter().any(|texel| texel[..3] != [0.0; 3])) {
            images.entry("emission").or_insert_with(|| vec![[0.0; 4]; above.len()]);
            move_to_emission(images, light, &above);
        }
    }

    fn path_lengths(&mut self) -> Option<Vec<f32>> {
        let scale = self.setup.scales.depth;
        Some(self.scalars(Role::PathLength)?.into_iter().map(|length| length * scale).collect())
    }

    /// Adds what is seen in mirrors to the images. Returns what is seen through flat glass. Neither where lines of sight are parallel.
    pub fn follow_paths(
        &mut self,
        params: &FrameParams,
        ids: &[u32],
        images: &mut BTreeMap<&'static str, Texels>,
    ) -> Option<Through> {
        let camera = Projection::new(params, params, &self.setup.config.conventions);
        if !camera.is_perspective() {
            return None;
        }
        let lengths = self.path_lengths()?;
        let raster = Raster::new(self.setup.config.allocated_extent);
        let passes = self.vectors(Role::DiffuseColour).zip(self.vectors(Role::SpecularAlbedo));
        let Some((base, coat)) = passes else {
            // A mirror shows what is straight on behind it, as glass does.
            let paths = Paths::new(raster, camera, &lengths, ids, &[], vec![true; ids.len()], images)?;
            let windows = paths.windows();
            let depth = paths.through().into_iter().zip(&windows).map(|(depth, is_window)| depth.filter(|_| *is_window));
            return Some(Through { depth: depth.collect(), windows: Some(windows) });
        };
        let transmits = Transmission::new(self.setup, ids, &base, images)?.pixels();
        let paths = Paths::new(raster, camera, &lengths, ids, &base, transmits, images)?;
        let depth = paths.through();
        if self.setup.config.signals == Signals::Specular {
            let mirrors = paths.mirrors(&coat);
            let lamps = self.albedo_of_surfaces().map(|all| paths.emission(&all, &coat));
            paths::add_mirrors(images, mirrors);
            if let Some(lamps) = lamps {
                move_to_emission(images, "noisy_specular", &lamps);
            }
        }
        Some(Through { depth, windows: None })
    }

    /// The previous frame's samples in the scene of this frame; absent in the first frame.
    pub fn reshaded(&mut self, images: &mut BTreeMap<&'static str, Texels>) {
        let parts = (self.vectors(Role::ReshadeDirect), self.vectors(Role::ReshadeIndirect));
        let both = sum(parts).or_else(|| self.vectors(Role::Reshaded));
        images.extend(both.map(|s| ("reshaded_radiance", s)));
    }

    /// Inputs by which a host reports changes itself, and the picture that is stabilized.
    pub fn gradients(&mut self, images: &mut BTreeMap<&'static str, Texels>) {
        images.extend(self.vectors(Role::ForwardMotion).map(|m| ("forward_motion", m)));
        images.extend(self.vectors(Role::Confidence).map(|c| ("confidence", c)));
        images.extend(self.vectors(Role::OtherDenoised).map(|o| ("other_denoised_radiance", o)));
        let [width, _] = self.setup.config.allocated_extent.map(|side| side as usize);
        let [columns, rows] = self.setup.config.allocated_extent.map(|side| side.div_ceil(self.setup.config.stratum_size) as usize);
        let corner = |texels: Texels| texels.chunks(width).take(rows).flat_map(|row| row[..columns].to_vec()).collect();
        images.extend(self.vectors(Role::SparseGradient).map(|g| ("sparse_gradient", corner(g))));
    }

    fn depth_of_positions(&mut self, camera: Option<&Camera>) -> Option<Texels> {
        let c = self.setup.config.conventions;
        let in_view = c.normal_space == NormalSpace::View;
        if camera.is_none() && !(in_view && self.setup.mapping.layout == Layout::Pbrt) {
            return None;
        }
        let view = camera.filter(|_| !in_view).map_or(glam::Mat4::IDENTITY, |c| glam::Mat4::from_cols_array_2d(&c.view_from_world));
        let sign = if c.view_forward == ViewForward::NegativeZ { -1.0 } else { 1.0 };
        let positions = self.vectors(Role::Position)?;
        let depth = |p: [f32; 4]| match p {
            // Nothing was hit.
            [0.0, 0.0, 0.0, _] => 0.0,
            [x, y, z, _] => sign * view.transform_point3(glam::Vec3::new(x, y, z)).z,
        };
        Some(positions.into_iter().map(|p| [depth(p), 0.0, 0.0, 0.0]).collect())
    }

    fn motion(&mut self, camera: bool) -> Option<Texels> {
        let still = || (!camera).then(|| vec![[0.0; 4]; self.setup.pixels()]);
        if !self.setup.mapping.has(Role::Motion) {
            return still();
        }
        let mut motion = self.vectors(Role::Motion)?;
        let [x, y] = self.setup.motion_share();
        motion.iter_mut().for_each(|m| (m[0], m[1]) = (m[0] * x, m[1] * y));
        let depth = match self.setup.config.conventions.motion_depth {
            MotionDepth::None => None,
            MotionDepth::Difference => self.scalars(Role::MotionDepth),
            MotionDepth::Absolute => self.scalars(Role::MotionDepth).or_else(|| self.scalars(Role::PreviousDepth)),
        };
        for (texel, z) in motion.iter_mut().zip(depth.unwrap_or_default()) {
            texel[2] = z;
        }
        Some(motion)
    }

    /// Ids of the surfaces, with 0 for the background.
    pub fn surface_ids(&mut self, images: &BTreeMap<&'static str, Texels>) -> Option<Vec<u32>> {
        let far = self.setup.config.conventions.background_depth;
        self.ids(Role::Id, images.get("depth")?, |depth| depth > 0.0 && depth < far)
    }

    /// Numbers of surfaces in this frame.
    pub fn shapes(&self) -> Option<Vec<f32>> {
        let names = [Role::Shape, Role::Id].into_iter().find_map(|role| self.setup.mapping.roles.get(&role))?;
        Some(match self.samples.get(names.first()?)? {
            Samples::Uint(numbers) => numbers.iter().map(|v| *v as f32).collect(),
            Samples::Float(numbers) => numbers.clone(),
        })
    }

    /// Ids of what is seen in the surfaces, with 0 where nothing was hit.
    pub fn hit_ids(&mut self, images: &BTreeMap<&'static str, Texels>) -> Option<Vec<u32>> {
        self.ids(Role::HitId, images.get("specular_hit_distance")?, |distance| distance > 0.0)
    }

    /// Ids of what casts the shadows of a light, with 0 where nothing does.
    pub fn occluder_ids(&mut self, images: &BTreeMap<&'static str, Texels>, light: usize) -> Option<Vec<u32>> {
        self.ids(Role::OccluderId(light), images.get(Input::OCCLUDER_DISTANCE[light].name)?, |distance| distance > 0.0)
    }

    /// Classes of materials, as they are.
    pub fn classes(&mut self) -> Option<Vec<u32>> {
        self.whole_numbers(Role::MaterialClass)
    }

    /// Only this project's data sets keep 0 free for what has no id, which is told by its distance elsewhere.
    fn ids(&mut self, role: Role, distances: &Texels, has_id: impl Fn(f32) -> bool) -> Option<Vec<u32>> {
        let mut ids = self.whole_numbers(role)?;
        if self.setup.mapping.layout != Layout::Atrous {
            for (id, distance) in ids.iter_mut().zip(distances) {
                *id = if has_id(distance[0]) { id.saturating_add(1) } else { 0 };
            }
        }
        Some(ids)
    }

    fn whole_numbers(&mut self, role: Role) -> Option<Vec<u32>> {
        let name = self.setup.mapping.roles.get(&role)?.first()?;
        Some(match self.samples.get(name)? {
            Samples::Uint(numbers) => numbers.clone(),
            Samples::Float(numbers) => {
                let bad = numbers.iter().filter(|v| !v.is_finite()).count();
                if bad > 0 {
                    self.replaced.insert(role, bad);
                }
                let raster = Raster::new(self.setup.config.allocated_extent);
                let whole = |i: usize| raster.around(i, 1).map(|j| numbers[j]).filter(|v| v.fract() == 0.0);
                let nearest = |i: usize| whole(i).min_by(|a, b| (a - numbers[i]).abs().total_cmp(&(b - numbers[i]).abs()));
                // At an outline a number may be a mean of those beside it. The cast saturates, and NaN becomes 0.
                let number =
                    |i: usize| if numbers[i].fract() == 0.0 { numbers[i] } else { nearest(i).unwrap_or(numbers[i]).round() };
                (0..numbers.len()).map(|i| number(i) as u32).collect()
            }
        })
    }

    pub fn total(&mut self, images: &BTreeMap<&'static str, Texels>) -> Vec<[f32; 3]> {
        if let Some(noisy) = self.vectors(Role::Noisy) {
            return rgb(noisy);
        }
        let parts =
            ["noisy_radiance", "noisy_direct", "noisy_indirect", "noisy_diffuse", "noisy_specular", "emission", "noisy_volume"]
                .iter()
                .filter_map(|n| images.get(n));
        let mut sum = parts.fold(vec![[0.0; 4]; self.setup.pixels()], |sum, part| combine(&sum, part, |a, b| a + b));
        for (seen, light) in Input::NOISY_VISIBILITY.iter().zip(Input::UNSHADOWED_DIRECT) {
            let (Some(seen), Some(light)) = (images.get(seen.name), images.get(light.name)) else { continue };
            let coloured = self.setup.config.coloured_visibility;
            let seen: Vec<_> =
                seen.iter().map(|v| (if coloured { *v } else { [v[0]; 4] }).map(|v| v.clamp(0.0, 1.0).max(0.0))).collect();
            sum = combine(&sum, &combine(&seen, light, |v, l| v * l), |a, b| a + b);
        }
        rgb(sum)
    }
}

fn sum(parts: (Option<Texels>, Option<Texels>)) -> Option<Texels> {
    match parts {
        (Some(a), Some(b)) => Some(combine(&a, &b, |a, b| a + b)),
        (a, b) => a.or(b),
    }
}

/// Moves a part of the light of an image to what is emitted.
fn move_to_emission(images: &mut BTreeMap<&'static str, Texels>, light: &'static str, part: &Texels) {
    let (Some(whole), Some(emission)) = (images.get(light), images.get("emission")) else { return };
    let part = within(part, whole);
    let moved = [("emission", combine(emission, &part, |a, b| a + b)), (light, without(whole, &Some(part)))];
    images.extend(moved);
}

/// A part of the light, no more than the whole has.
fn within(part: &Texels, whole: &Texels) -> Texels {
    combine(part, whole, |part, whole| part.min(whole.max(0.0)))
}

fn without(whole: &Texels, part: &Option<Texels>) -> Texels {
    match part {
        // Negative light stays: the part is not more than the whole.
        Some(part) => combine(whole, part, |whole, part| (whole - part).max(whole.min(0.0))),
        None => whole.clone(),
    }
}

fn combine(a: &Texels, b: &Texels, of: impl Fn(f32, f32) -> f32) -> Texels {
    a.iter().zip(b).map(|(a, b)| std::array::from_fn(|i| of(a[i], b[i]))).collect()
}
