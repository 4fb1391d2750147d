//! What a host gives a random graph in a frame.

use crate::support::scene::{hash, random, Guides, Scene};
use atrous::executor::Session;
use atrous::reference::{Engine, InstanceTransform};
use atrous::{Declaration, Error, Lifetime, ResourceDecl, Shape};

/// Inputs of ids, beside that of surfaces, and of classes.
const HIT_IDS: [&str; 6] = ["material_class", "specular_hit_id", "occluder_id", "occluder_id_1", "occluder_id_2", "occluder_id_3"];

/// The inputs of one frame by name; those that are `None` are left out.
pub struct Inputs {
    pub(super) images: Vec<(String, Option<Vec<[f32; 4]>>)>,
    pub(super) surface_id: Option<Vec<u32>>,
    /// Ids of what rays met, and classes.
    hit_ids: Vec<(&'static str, Vec<u32>)>,
    pub(super) transforms: Option<Vec<InstanceTransform>>,
}

impl Inputs {
    /// What a declaration asks for; the seed says which of the optional ones there are.
    pub fn new(declaration: &Declaration, seed: u32, scene: &Scene, index: u32) -> Self {
        let mut guides = scene.frame(index, index);
        add_outliers(&mut guides);
        let before = scene.frame(index.saturating_sub(1), index.saturating_sub(1));
        let mut images = Vec::new();
        let is_input = |r: &&ResourceDecl| matches!(r.lifetime, Lifetime::Input { .. });
        for (k, resource) in (0..).zip(declaration.resources().iter().filter(is_input)) {
            let Shape::Image { .. } = resource.shape else { continue };
            if resource.name == "surface_id" || HIT_IDS.contains(&resource.name.as_str()) {
                continue;
            }
            let extent = resource.extent(declaration.setup()).expect("an image");
            let is_optional = resource.lifetime == Lifetime::Input { optional: true };
            let is_there = !is_optional || !hash(seed, k, 100 + index / 2).is_multiple_of(4);
            images.push((resource.name.clone(), is_there.then(|| texels(&resource.name, extent, &guides, &before, index))));
        }
        let identity = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
        let moved = [[0.96, -0.28, 0.0, 0.1], [0.28, 0.96, 0.0, -0.05], [0.0, 0.0, 1.0, 0.02]];
        let transforms = (hash(seed, 0, 200).is_multiple_of(2)).then(|| vec![identity, identity, moved]);
        let transforms = transforms.filter(|_| declaration.find("instance_transforms").is_some());
        let surface_id = declaration.find("surface_id").is_some().then_some(guides.surface_id);
        // One of them has no transform.
        let hit_id = |i| hash(seed, i / 7, 201) % 4;
        let hit_ids: Vec<u32> = (0..scene.allocated[0] * scene.allocated[1]).map(hit_id).collect();
        let declared = HIT_IDS.into_iter().filter(|name| declaration.find(name).is_some());
        Self { images, surface_id, hit_ids: declared.map(|name| (name, hit_ids.clone())).collect(), transforms }
    }

    /// What a host binds: texels of the images by name, `None` for one that is left out.
    pub fn images(&self) -> impl Iterator<Item = (&str, Option<Vec<u8>>)> {
        let bytes = |texels: &Option<Vec<[f32; 4]>>| texels.as_ref().map(|t| bytemuck::cast_slice(t).to_vec());
        let ids = self.surface_id.as_ref().map(|ids| ("surface_id", Some(bytemuck::cast_slice(ids).to_vec())));
        let hit_ids = self.hit_ids.iter().map(|(name, ids)| (*name, Some(bytemuck::cast_slice(ids).to_vec())));
        self.images.iter().map(move |(name, texels)| (name.as_str(), bytes(texels))).chain(ids).chain(hit_ids)
    }

    /// The buffer `instance_transforms`, where it is bound.
    pub fn transforms(&self) -> Option<Vec<u8>> {
        self.transforms.as_ref().map(|t| bytemuck::cast_slice(t).to_vec())
    }

    pub fn give_session(&self, s: &mut Session) -> Result<(), Error> {
        for (name, texels) in &self.images {
            match texels {
                Some(texels) => s.upload(name, texels)?,
                None => s.unbind(name)?,
            }
        }
        self.surface_id.as_ref().map_or(Ok(()), |ids| s.upload_ids("surface_id", ids))?;
        self.hit_ids.iter().try_for_each(|(name, ids)| s.upload_ids(name, ids))?;
        self.transforms.as_ref().map_or(Ok(()), |t| s.upload_buffer("instance_transforms", bytemuck::cast_slice(t)))
    }

    pub fn give_engine(&self, engine: &mut Engine) -> Result<(), Error> {
        for (name, texels) in &self.images {
            match texels {
                Some(texels) => engine.upload(name, texels)?,
                None => engine.unbind(name)?,
            }
        }
        self.surface_id.as_ref().map_or(Ok(()), |ids| engine.upload_ids("surface_id", ids))?;
        self.hit_ids.iter().try_for_each(|(name, ids)| engine.upload_ids(name, ids))?;
        self.transforms.as_ref().map_or(Ok(()), |t| engine.upload_buffer("instance_transforms", bytemuck::cast_slice(t)))
    }
}

/// Fireflies, and a few values that are not finite.
fn add_outliers(guides: &mut Guides) {
    let Guides { noisy_radiance, noisy_direct, noisy_indirect, noisy_volume, noisy_specular, .. } = guides;
    for images in [noisy_radiance, noisy_direct, noisy_indirect, noisy_volume, noisy_specular] {
        images.iter_mut().step_by(97).for_each(|t| *t = t.map(|c| 40.0 * c));
        images.iter_mut().skip(11).step_by(301).for_each(|t| t[0] = f32::NAN);
    }
}

fn texels(name: &str, [width, height]: [u32; 2], guides: &Guides, before: &Guides, index: u32) -> Vec<[f32; 4]> {
    if let Some((_, texels)) = guides.images().into_iter().find(|(other, _)| *other == name) {
        return texels.to_vec();
    }
    let make = |of: fn(u32, u32) -> [f32; 4]| (0..width * height).map(|i| of(i, index)).collect();
    match name {
        "noisy_ao" => make(|i, frame| [if random(i, frame, 5) < 0.6 { 1.0 } else { 0.0 }; 4]),
        "specular_f0" => make(|i, _| [0.04 + (i % 7) as f32 / 10.0; 4]),
        "emission" => make(|i, _| if i % 50 == 0 { [2.0, 1.0, 0.5, 0.0] } else { [0.0; 4] }),
        "confidence" => make(|i, frame| [if i % 31 == 0 { f32::NAN } else { 1.4 * random(i, frame, 6) - 0.2 }; 4]),
        "forward_motion" => make(|i, frame| [0.02 * random(i, frame, 7), -0.01, 5.0, 0.0]),
        "specular_motion" | "occluder_motion" | "occluder_motion_1" | "occluder_motion_2" | "occluder_motion_3" => {
            make(|i, frame| [if i % 37 == 0 { f32::NAN } else { 0.1 * random(i, frame, 10) }, 0.03, 0.0, 0.0])
        }
        "sparse_gradient" => make(|i, frame| [random(i, frame, 8) - 0.5, random(i, frame, 9), 0.0, 0.0]),
        "reshaded_radiance" => before.noisy_radiance.iter().map(|t| t.map(|c| 0.8 * c)).collect(),
        other => panic!("the tests have no image for the input `{other}`"),
    }
}
