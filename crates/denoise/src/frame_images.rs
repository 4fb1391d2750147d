//! The images of a frame, from the channels of its file.

use crate::camera::Camera;
use crate::exr_read::Samples;
use crate::layouts::Layout;
use crate::roles::Role;
use crate::setup::Setup;
use atrous::config::{MotionDepth, NormalSpace, Signals, ViewForward};
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
                let is_distance = matches!(role, Role::Depth | Role::OccluderDistance) && !value.is_nan();
                let usable = self.setup.is_verbatim() || value.is_finite() || is_distance || role == Role::Visibility;
                *bad |= !usable;
                texel[component] = if usable { *value } else { 0.0 };
            }
        }
        let count = bad.iter().filter(|b| **b).count();
        if count > 0 {
            self.replaced.insert(role, count);
        }
        Some(texels)
    }

    pub fn scalars(&mut self, role: Role) -> Option<Vec<f32>> {
        self.vectors(role).map(|texels| texels.into_iter().map(|t| t[0]).collect())
    }

    fn emission(&mut self) -> Option<Texels> {
        let (emission, environment) = (self.vectors(Role::Emission), self.vectors(Role::Environment));
        match (emission, environment) {
            (Some(a), Some(b)) => Some(combine(&a, &b, |a, b| a + b)),
            (a, b) => a.or(b),
        }
    }

    /// Direct light: as it is, or from its demodulated form.
    fn direct(&mut self) -> Option<Texels> {
        if self.setup.mapping.has(Role::Direct) {
            return self.vectors(Role::Direct);
        }
        let (light, colour) = (self.vectors(Role::DemodulatedDirect)?, self.vectors(Role::DiffuseColour)?);
        Some(combine(&light, &colour, |a, b| a * b))
    }

    /// Specular light: as it is, or from its demodulated form.
    fn specular(&mut self) -> Option<Texels> {
        if self.setup.mapping.has(Role::Specular) {
            return self.vectors(Role::Specular);
        }
        let direct = self.vectors(Role::DemodulatedSpecularDirect)?;
        let (indirect, colour) = (self.vectors(Role::DemodulatedSpecularIndirect)?, self.vectors(Role::SpecularAlbedo)?);
        Some(combine(&combine(&direct, &indirect, |a, b| a + b), &colour, |a, b| a * b))
    }

    pub fn lighting(&mut self, images: &mut BTreeMap<&'static str, Texels>) {
        let emission = self.emission();
        let rest = |total: &Texels, part: &Option<Texels>| match part {
            Some(part) => combine(total, part, |a, b| (a - b).max(0.0)),
            None => total.clone(),
        };
        if self.setup.config.signals == Signals::Specular {
            let (noisy, specular) = (self.vectors(Role::Noisy), self.specular());
            let diffuse = self.vectors(Role::Diffuse).or_else(|| noisy.map(|noisy| rest(&rest(&noisy, &emission), &specular)));
            images.extend(diffuse.map(|d| ("noisy_diffuse", d)));
            images.extend(specular.map(|s| ("noisy_specular", s)));
            images.extend(emission.map(|e| ("emission", e)));
            return;
        }
        let both = self.setup.mapping.has(Role::Direct) && self.setup.mapping.has(Role::Indirect);
        match (self.setup.config.signals, both) {
            (Signals::Apart, true) => {
                images.extend(self.vectors(Role::Direct).map(|d| ("noisy_direct", d)));
                images.extend(self.vectors(Role::Indirect).map(|d| ("noisy_indirect", d)));
            }
            // What is neither emission nor direct is called indirect, so that nothing is lost.
            (Signals::Apart, false) => {
                let (noisy, direct) = (self.vectors(Role::Noisy), self.direct());
                images.extend(noisy.map(|n| ("noisy_indirect", rest(&rest(&n, &emission), &direct))));
                images.extend(direct.map(|d| ("noisy_direct", d)));
            }
            (_, true) => {
                let parts = (self.vectors(Role::Direct), self.vectors(Role::Indirect));
                if let (Some(direct), Some(indirect)) = parts {
                    images.insert("noisy_radiance", combine(&direct, &indirect, |a, b| a + b));
                }
            }
            (_, false) if self.setup.mapping.has(Role::Lighting) => {
                images.extend(self.vectors(Role::Lighting).map(|l| ("noisy_radiance", l)));
            }
            (_, false) => {
                let noisy = self.vectors(Role::Noisy);
                images.extend(noisy.map(|n| ("noisy_radiance", rest(&n, &emission))));
            }
        }
        images.extend(emission.map(|e| ("emission", e)));
    }

    pub fn guides(&mut self, camera: Option<&Camera>, images: &mut BTreeMap<&'static str, Texels>) {
        let pixels = self.setup.pixels();
        // A renderer's albedo for denoisers has the coat in it, which specular light apart has no use for.
        let is_specular = self.setup.config.signals == Signals::Specular;
        let base = if is_specular { self.vectors(Role::DiffuseColour) } else { None };
        images.extend(base.or_else(|| self.vectors(Role::Albedo)).map(|a| ("albedo", a)));
        images.extend(self.vectors(Role::Roughness).map(|r| ("roughness", r)));
        if is_specular {
            images.extend(self.vectors(Role::SpecularAlbedo).map(|a| ("specular_albedo", a)));
            images.extend(self.vectors(Role::HitDistance).map(|d| ("specular_hit_distance", d)));
        }
        let normal = self.vectors(Role::Normal).unwrap_or_else(|| vec![[0.0, 0.0, 1.0, 0.0]; pixels]);
        images.insert("normal", normal);
        images.extend(self.vectors(Role::ObjectNormal).map(|n| ("object_normal", n)));
        let depth = self.vectors(Role::Depth).or_else(|| self.depth_of_positions(camera));
        images.insert("depth", depth.unwrap_or_else(|| vec![[1.0; 4]; pixels]));
        if let Some(motion) = self.motion(camera.is_some()) {
            images.insert("motion", motion);
        }
    }

    /// The previous frame's samples in the scene of this frame; absent in the first frame.
    pub fn reshaded(&mut self, images: &mut BTreeMap<&'static str, Texels>) {
        let parts = (self.vectors(Role::ReshadeDirect), self.vectors(Role::ReshadeIndirect));
        let sum = match parts {
            (Some(direct), Some(indirect)) => Some(combine(&direct, &indirect, |a, b| a + b)),
            (direct, indirect) => direct.or(indirect).or_else(|| self.vectors(Role::Reshaded)),
        };
        images.extend(sum.map(|s| ("reshaded_radiance", s)));
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

    /// Ids with 0 for the background. Only this project's data sets keep 0 free for it.
    pub fn ids(&mut self, images: &BTreeMap<&'static str, Texels>) -> Option<Vec<u32>> {
        let name = self.setup.mapping.roles.get(&Role::Id)?.first()?;
        let mut ids = match self.samples.remove(name)? {
            Samples::Uint(ids) => ids,
            Samples::Float(ids) => {
                let bad = ids.iter().filter(|v| !v.is_finite()).count();
                if bad > 0 {
                    self.replaced.insert(Role::Id, bad);
                }
                // The cast saturates, and NaN becomes 0.
                ids.into_iter().map(|v| v.round() as u32).collect()
            }
        };
        if self.setup.mapping.layout != Layout::Atrous {
            let far = self.setup.config.conventions.background_depth;
            for (id, depth) in ids.iter_mut().zip(images.get("depth")?) {
                *id = if depth[0] > 0.0 && depth[0] < far { id.saturating_add(1) } else { 0 };
            }
        }
        Some(ids)
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
        if let (Some(seen), Some(light)) = (images.get("noisy_visibility"), images.get("unshadowed_direct")) {
            let seen: Vec<_> = seen.iter().map(|v| [v[0].clamp(0.0, 1.0).max(0.0); 4]).collect();
            sum = combine(&sum, &combine(&seen, light, |v, l| v * l), |a, b| a + b);
        }
        rgb(sum)
    }
}

fn combine(a: &Texels, b: &Texels, of: impl Fn(f32, f32) -> f32) -> Texels {
    a.iter().zip(b).map(|(a, b)| std::array::from_fn(|i| of(a[i], b[i]))).collect()
}
