//! glTF 2.0 files as scenes: triangles, base colour, metallic-roughness, emission, punctual lights, the first camera.
//!
//! Left out: animation, skins, morph targets, normal maps, transparency, sparse accessors. What has neither a light nor
//! an emitter gets a sun and a sky; what has no camera gets one that sees all of it.

use std::collections::HashMap;
use std::path::Path;

use glam::{vec3, Mat4, Vec3};

use super::gltf_bounds::{check_amount, check_positions, check_primitive, check_views};
use super::gltf_nodes::check_trees;
use super::gltf_parts::{lamp, material, mesh, view};
use super::gltf_sources;
use super::{Environment, Lamp, Placement, Scene, View};
use crate::error::{Error, Result};

const WHOLE_FILE: &str = "It must be a whole glTF 2.0 file (.glb or .gltf): export or download it again";

/// Deepest tree of nodes: it is walked by recursion.
const NODE_DEPTH_LIMIT: usize = 128;

/// What goes wrong inside a file: the problem, and what to do about it.
pub type Problem = (String, &'static str);

/// Reads a `.gltf` or `.glb` file.
pub fn load(path: &Path) -> Result<Scene> {
    read(path).map_err(|(problem, remedy)| Error::SceneFile { path: path.to_path_buf(), problem, remedy })
}

fn read(path: &Path) -> std::result::Result<Scene, Problem> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let (document, buffers) = import(path, folder)?;
    let name = path.file_stem().and_then(|stem| stem.to_str()).unwrap_or("gltf");
    let mut scene = Scene::new(name, View { eye: Vec3::Z, target: Vec3::ZERO, up: Vec3::Y, vertical_fov: 0.8 });
    scene.textures = gltf_sources::textures(&document, folder, &buffers)?;
    // glTF's default material stands last.
    for source in document.materials() {
        scene.add_material(material(&source)?);
    }
    let default_material = scene.add_material(super::Material::plastic(Vec3::splat(0.8), 0.6));
    let mut reader = Reader { buffers: &buffers, scene, default_material, camera: None, read: HashMap::new() };
    let root = document.default_scene().or_else(|| document.scenes().next());
    let root = root.ok_or(("it has no scene".to_string(), "Export it again with at least one scene"))?;
    for node in root.nodes() {
        reader.node(&node, Mat4::IDENTITY, 0)?;
    }
    reader.finish()
}

/// What `gltf::import` does, but for pictures, with checks before its validation, which indexes without looking, and before it reads
/// other files.
fn import(path: &Path, folder: &Path) -> std::result::Result<(gltf::Document, Vec<gltf::buffer::Data>), Problem> {
    let bytes =
        atrous_files::read_regular(path, gltf_sources::MOST_BYTES).map_err(|error| import_problem(gltf::Error::Io(error)))?;
    let parsed = gltf::Gltf::from_slice_without_validation(&bytes).map_err(import_problem)?;
    let json = parsed.document.into_json();
    check_positions(&json).map_err(|problem| (problem, WHOLE_FILE))?;
    check_trees(&json).map_err(|problem| (problem, "Export it again, with every node in one place of its scene"))?;
    let document = gltf::Document::from_json(json).map_err(import_problem)?;
    check_amount(&document).map_err(|problem| (problem, "Choose a simpler scene"))?;
    gltf_sources::check(&document, folder)?;
    let buffers = gltf::import_buffers(&document, Some(folder), parsed.blob).map_err(import_problem)?;
    check_views(&document, &buffers).map_err(|problem| (problem, WHOLE_FILE))?;
    Ok((document, buffers))
}

struct Reader<'a> {
    buffers: &'a [gltf::buffer::Data],
    scene: Scene,
    default_material: usize,
    camera: Option<View>,
    /// Meshes of ours by mesh and primitive of the file: nodes share them. None for points and lines.
    read: HashMap<(usize, usize), Option<usize>>,
}

impl Reader<'_> {
    fn node(&mut self, node: &gltf::Node<'_>, parent: Mat4, depth: usize) -> std::result::Result<(), Problem> {
        if depth > NODE_DEPTH_LIMIT {
            let problem = format!("its nodes are nested deeper than {NODE_DEPTH_LIMIT} levels");
            return Err((problem, "Export it again with a flatter tree of nodes"));
        }
        let world = parent * Mat4::from_cols_array_2d(&node.transform().matrix());
        if !world.is_finite() {
            let problem = format!("node {} has a transform that is not finite", node.index());
            return Err((problem, "Export it again, or correct the node's matrix, rotation, translation or scale"));
        }
        if let Some(source) = node.mesh() {
            for primitive in source.primitives() {
                self.primitive(&source, &primitive, world)?;
            }
        }
        if let Some(light) = node.light() {
            self.scene.lamps.push(lamp(&light, world));
        }
        if let (Some(camera), None) = (node.camera(), self.camera) {
            self.camera = view(&camera, world);
        }
        node.children().try_for_each(|child| self.node(&child, world, depth + 1))
    }

    fn primitive(
        &mut self,
        source: &gltf::Mesh<'_>,
        primitive: &gltf::Primitive<'_>,
        world: Mat4,
    ) -> std::result::Result<(), Problem> {
        let key = (source.index(), primitive.index());
        let mesh = match self.read.get(&key) {
            Some(mesh) => *mesh,
            None => {
                let mesh = self.mesh(source, primitive)?;
                *self.read.entry(key).or_insert(mesh)
            }
        };
        let Some(mesh) = mesh else { return Ok(()) };
        let material = primitive.material().index().unwrap_or(self.default_material);
        self.scene.add_instance(mesh, material, Placement::Fixed(glam::Affine3A::from_mat4(world)));
        Ok(())
    }

    /// Reads a primitive for the first of its nodes.
    fn mesh(&mut self, source: &gltf::Mesh<'_>, primitive: &gltf::Primitive<'_>) -> std::result::Result<Option<usize>, Problem> {
        let label = format!("mesh {}, primitive {}", source.index(), primitive.index());
        check_primitive(primitive, self.buffers).map_err(|problem| {
            (format!("{label}: {problem}"), "The file is damaged or was cut short: export or download it again")
        })?;
        Ok(mesh(&label, primitive, self.buffers)?.map(|mesh| self.scene.add_mesh(mesh)))
    }

    fn finish(mut self) -> std::result::Result<Scene, Problem> {
        if self.scene.meshes.iter().all(|mesh| mesh.triangles.is_empty()) {
            return Err(("it has no triangles to show".to_string(), "Choose a file whose scene has triangle meshes"));
        }
        let emits = self.scene.instances.iter().any(|i| self.scene.materials[i.material].emission.max_element() > 0.0);
        if self.scene.lamps.is_empty() && !emits {
            self.scene.lamps.push(Lamp::Sun {
                direction: vec3(0.45, 0.8, 0.4).normalize(),
                irradiance: vec3(9.0, 8.4, 7.5),
                radius: 0.01,
            });
            self.scene.environment =
                Environment { zenith: vec3(0.5, 0.75, 1.2), horizon: vec3(0.9, 0.95, 1.0), ground: vec3(0.25, 0.23, 0.2) };
        }
        let view = self.camera.unwrap_or_else(|| framing_view(&self.scene));
        self.scene.set_camera(move |_| view);
        Ok(self.scene)
    }
}

/// Looks at everything, a little from above and from the side.
fn framing_view(scene: &Scene) -> View {
    let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    for (instance, transform) in scene.instances.iter().zip(scene.transforms(0.0)) {
        for position in &scene.meshes[instance.mesh].positions {
            let world = transform.transform_point3(*position);
            low = low.min(world);
            high = high.max(world);
        }
    }
    let target = 0.5 * (low + high);
    let radius = (0.5 * (high - low).length()).max(1e-3);
    let vertical_fov: f32 = 0.7;
    let distance = radius / (0.5 * vertical_fov).sin();
    View { eye: target + distance * vec3(0.5, 0.35, 0.8).normalize(), target, up: Vec3::Y, vertical_fov }
}

pub(super) fn import_problem(error: gltf::Error) -> Problem {
    let remedy = match &error {
        gltf::Error::Io(io) if io.kind() != std::io::ErrorKind::UnexpectedEof => {
            "Check the path, and that the files it refers to are beside it"
        }
        gltf::Error::Image(_) | gltf::Error::UnsupportedImageEncoding | gltf::Error::UnsupportedImageFormat(_) => {
            "Use PNG or JPEG pictures"
        }
        gltf::Error::UnsupportedScheme | gltf::Error::ExternalReferenceInSliceImport => {
            "Put buffers and pictures beside the file or inside it"
        }
        _ => WHOLE_FILE,
    };
    // The crate's message for a failed validation is a list; one line is enough for a person.
    let problem = match &error {
        gltf::Error::Io(io) => format!("it cannot be read ({io})"),
        gltf::Error::Validation(errors) => {
            let first = errors.first().map(|(path, error)| format!("{}: {error}", path.as_str())).unwrap_or_default();
            format!("it is not valid glTF ({first})")
        }
        other => format!("it is not usable glTF ({other})"),
    };
    (problem, remedy)
}
