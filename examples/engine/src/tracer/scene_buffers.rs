//! The scene on the device: what is written once, and what is written for each frame.

use ash::vk;
use glam::Affine3A;

use super::bvh::{self, Bvh};
use super::layout::{rows, with, FrameConstants, InstanceData, LightData, MaterialData, Rows, TriangleAttributes, TEXTURE_LIMIT};
use super::lights;
use crate::error::{Error, Result};
use crate::gpu::{Bound, Gpu, Upload};
use crate::scene::{Mesh, Moment, Scene};

/// The buffers of descriptor set 0 and the two tables of transforms.
pub struct SceneBuffers {
    frame: Upload,
    nodes: Upload,
    triangles: Upload,
    attributes: Upload,
    instances: Upload,
    materials: Upload,
    lights: Upload,
    textures: Upload,
    pub previous_from_current: Upload,
    pub current_from_previous: Upload,
    first_triangles: Vec<u32>,
    built_for: Vec<Affine3A>,
    diagonal: f32,
}

/// What the frame's constants need of the lights and of the tree.
pub struct SceneState {
    pub light_count: u32,
    /// Index of the first lamp.
    pub first_lamp: u32,
    pub total_weight: f32,
    pub diagonal: f32,
}

impl SceneBuffers {
    pub fn new(gpu: &Gpu, scene: &Scene) -> Result<Self> {
        let transforms = scene.transforms(0.0);
        let tree = bvh::build(scene, &transforms, false)?;
        let light_count = emissive_triangles(scene) + scene.lamps.len();
        let texture_words = texture_words(scene)?;
        let (attributes, first_triangles) = attributes(&scene.meshes);
        let table = (scene.instances.len() as u64 + 1) * size::<Rows>();
        let instances = scene.instances.len();
        let mut buffers = Self {
            frame: Upload::new(gpu, "frame constants", size::<FrameConstants>())?,
            nodes: Upload::texels::<[f32; 8]>(gpu, "BVH nodes", 2 * tree.triangles.len() + 1)?,
            triangles: Upload::texels::<[f32; 12]>(gpu, "BVH triangles", tree.triangles.len())?,
            attributes: Upload::texels::<TriangleAttributes>(gpu, "triangle attributes", attributes.len())?,
            instances: Upload::texels::<InstanceData>(gpu, "instances", instances)?,
            materials: Upload::texels::<MaterialData>(gpu, "materials", scene.materials.len())?,
            lights: Upload::texels::<LightData>(gpu, "lights", light_count)?,
            textures: Upload::new(gpu, "textures", texture_words.len() as u64 * 4)?,
            previous_from_current: Upload::new(gpu, "previous_from_current", table)?,
            current_from_previous: Upload::new(gpu, "current_from_previous", table)?,
            first_triangles,
            built_for: transforms,
            diagonal: 0.0,
        };
        buffers.attributes.write(&attributes);
        buffers.textures.write(&texture_words);
        buffers.set_tree(&tree);
        Ok(buffers)
    }

    /// The buffers in the order of the bindings of set 0.
    pub fn bindings(&self) -> [Bound; 8] {
        [
            Bound::Storage(self.frame.buffer.handle),
            self.nodes.bound(),
            self.triangles.bound(),
            self.attributes.bound(),
            self.instances.bound(),
            self.materials.bound(),
            self.lights.bound(),
            self.textures.bound(),
        ]
    }

    /// Writes what differs between frames, except for the frame's constants. Motion is from `before` to `now`.
    pub fn animate(&mut self, scene: &Scene, now: &Moment, before: &Moment) -> Result<SceneState> {
        let transforms = scene.transforms(now.object_time);
        let previous = scene.transforms(before.object_time);
        if transforms != self.built_for {
            let tree = bvh::build(scene, &transforms, true)?;
            self.set_tree(&tree);
            self.built_for.clone_from(&transforms);
        }
        let lights = lights::lights(scene, &transforms, &self.first_triangles, now, self.diagonal);
        self.lights.write(&lights.data);
        self.materials.write(&lights::materials(scene, now.light_frame));
        self.write_transforms(scene, &transforms, &previous);
        Ok(SceneState {
            light_count: lights.data.len() as u32,
            first_lamp: lights.first_lamp,
            total_weight: lights.total_weight,
            diagonal: self.diagonal,
        })
    }

    /// Writes the frame's constants.
    pub fn set_constants(&mut self, constants: &FrameConstants) {
        self.frame.write(&[*constants]);
    }

    /// Records the copies to the device.
    pub fn record(&mut self, device: &ash::Device, cmd: vk::CommandBuffer) {
        for upload in [
            &mut self.frame,
            &mut self.nodes,
            &mut self.triangles,
            &mut self.attributes,
            &mut self.instances,
            &mut self.materials,
            &mut self.lights,
            &mut self.textures,
            &mut self.previous_from_current,
            &mut self.current_from_previous,
        ] {
            upload.record(device, cmd);
        }
    }

    fn set_tree(&mut self, tree: &Bvh) {
        self.nodes.write(&tree.nodes);
        self.triangles.write(&tree.triangles);
        self.diagonal = tree.diagonal;
    }

    fn write_transforms(&mut self, scene: &Scene, transforms: &[Affine3A], previous: &[Affine3A]) {
        let identity = rows(&Affine3A::IDENTITY);
        let (mut backward, mut forward, mut instances) = (vec![identity], vec![identity], Vec::new());
        for (index, (now, before)) in transforms.iter().zip(previous).enumerate() {
            let instance = &scene.instances[index];
            instances.push(InstanceData {
                world_from_object: rows(now),
                previous_world_from_object: rows(before),
                first_triangle: self.first_triangles[instance.mesh],
                material: instance.material as u32,
                surface_id: index as u32 + 1,
                unused: 0,
            });
            // What stands still gets the exact identity, not a product that is nearly one.
            let still = now == before;
            backward.push(if still { identity } else { rows(&(*before * now.inverse())) });
            forward.push(if still { identity } else { rows(&(*now * before.inverse())) });
        }
        self.instances.write(&instances);
        self.previous_from_current.write(&backward);
        self.current_from_previous.write(&forward);
    }
}

fn size<T>() -> u64 {
    std::mem::size_of::<T>() as u64
}

fn emissive_triangles(scene: &Scene) -> usize {
    let emits = |material: usize| scene.materials[material].emission.max_element() > 0.0;
    scene.instances.iter().filter(|i| emits(i.material)).map(|i| scene.meshes[i.mesh].triangles.len()).sum()
}

/// The attributes of all meshes, and where each mesh begins.
fn attributes(meshes: &[Mesh]) -> (Vec<TriangleAttributes>, Vec<u32>) {
    let mut all = Vec::new();
    let mut first = Vec::new();
    for mesh in meshes {
        first.push(all.len() as u32);
        all.extend(mesh.triangles.iter().map(|triangle| {
            let corners = triangle.map(|corner| corner as usize);
            TriangleAttributes {
                position_u: corners.map(|c| with(mesh.positions[c], mesh.uvs[c].x)),
                normal_v: corners.map(|c| with(mesh.normals[c], mesh.uvs[c].y)),
            }
        }));
    }
    (all, first)
}

/// The table of headers, then all texels.
fn texture_words(scene: &Scene) -> Result<Vec<u32>> {
    let given = scene.textures.len();
    if given > TEXTURE_LIMIT {
        return Err(Error::SceneLimit { what: "textures", given, limit: TEXTURE_LIMIT });
    }
    let mut headers = vec![[0u32; 4]; TEXTURE_LIMIT];
    let mut texels: Vec<u32> = Vec::new();
    for (header, texture) in headers.iter_mut().zip(&scene.textures) {
        *header = [texels.len() as u32, texture.width, texture.height, 0];
        texels.extend(&texture.texels);
    }
    let mut words: Vec<u32> = headers.into_iter().flatten().collect();
    words.extend(texels);
    Ok(words)
}
