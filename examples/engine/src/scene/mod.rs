//! Worlds to look at: meshes, materials, lights and a camera, all of them functions of the frame index.

mod chapel;
mod cornell;
mod door;
mod fog;
mod glossy;
mod gltf_bounds;
mod gltf_file;
mod gltf_nodes;
mod gltf_parts;
mod gltf_sources;
mod hall;
mod lamp;
mod lamps;
mod leaves;
mod material;
mod medium;
mod mesh;
mod mirror;
pub mod mirror_moving;
mod pillars;
mod shapes;
mod tiles;
pub mod vitrine;

pub use lamp::{Environment, Lamp};
pub use material::{Glass, Material, Pattern, Texture};
pub use medium::Medium;
pub use mesh::Mesh;

use glam::{Affine3A, Vec3};

use crate::error::{Error, Result};

/// Frames in one second of animation.
pub const FRAMES_PER_SECOND: f32 = 30.0;

/// The built-in scenes' names.
pub const BUILT_IN: [&str; 15] = [
    "cornell",
    "pillars",
    "glossy",
    "mirror",
    "mirror_moving",
    "hall",
    "hall_railings",
    "hall_sun",
    "fog",
    "leaves",
    "lamps",
    "tiles",
    "door",
    "chapel",
    "vitrine",
];

/// Parts of the animation that stand still.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SceneOptions {
    /// Lights keep the intensity that they have in frame 0.
    pub static_light: bool,
    /// The camera stays where it is in frame 0.
    pub static_camera: bool,
    /// Objects stay where they are in frame 0.
    pub static_objects: bool,
}

/// A movement as a function of time; must depend on nothing else.
type Path = Box<dyn Fn(f32) -> Affine3A + Send + Sync>;

/// Where a thing is at a time in seconds.
pub enum Placement {
    /// It never moves.
    Fixed(Affine3A),
    /// `world_from_object` as a function of time; must depend on nothing else.
    Animated(Path),
}

/// A mesh in the world. Its `surface_id` is its index plus one.
pub struct Instance {
    /// Index into [`Scene::meshes`].
    pub mesh: usize,
    /// Index into [`Scene::materials`].
    pub material: usize,
    /// Where it is.
    pub placement: Placement,
}

/// A perspective camera at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Where it is.
    pub eye: Vec3,
    /// A point that it looks at, in the middle of the picture.
    pub target: Vec3,
    /// Roughly upwards.
    pub up: Vec3,
    /// Vertical field of view in radians.
    pub vertical_fov: f32,
}

/// A world at one time: who draws decides how time passes for the camera, the objects and the lights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment {
    /// The camera.
    pub view: View,
    /// Where the objects are on their ways, seconds.
    pub object_time: f32,
    /// Frame that the intensity of lights and emitters is of.
    pub light_frame: u32,
}

/// The intensity of one material over the frames.
struct EmissionScale {
    material: usize,
    scale: Box<dyn Fn(u32) -> f32 + Send + Sync>,
}

/// A world, as a function of the frame index.
pub struct Scene {
    /// What to call it.
    pub name: String,
    /// Triangles in object space.
    pub meshes: Vec<Mesh>,
    /// What they are made of.
    pub materials: Vec<Material>,
    /// Pictures on them.
    pub textures: Vec<Texture>,
    /// Where they are.
    pub instances: Vec<Instance>,
    /// Lights that are not meshes.
    pub lamps: Vec<Lamp>,
    lamp_paths: Vec<(usize, Path)>,
    /// Light from everywhere.
    pub environment: Environment,
    /// What lies between the surfaces, if anything.
    pub medium: Option<Medium>,
    camera: Box<dyn Fn(f32) -> View + Send + Sync>,
    light_scale: Box<dyn Fn(u32) -> f32 + Send + Sync>,
    emission_scales: Vec<EmissionScale>,
    options: SceneOptions,
}

impl Scene {
    /// An empty world.
    pub fn new(name: &str, view: View) -> Self {
        Self {
            name: name.to_string(),
            meshes: Vec::new(),
            materials: Vec::new(),
            textures: Vec::new(),
            instances: Vec::new(),
            lamps: Vec::new(),
            lamp_paths: Vec::new(),
            environment: Environment::default(),
            medium: None,
            camera: Box::new(move |_| view),
            light_scale: Box::new(|_| 1.0),
            emission_scales: Vec::new(),
            options: SceneOptions::default(),
        }
    }

    /// A built-in scene by name (see [`BUILT_IN`]), or a glTF 2.0 file by path.
    ///
    /// # Errors
    /// An unknown name, or a file that cannot be used.
    pub fn load(name: &str, options: &SceneOptions) -> Result<Self> {
        let lower = name.to_lowercase();
        let mut scene = match lower.as_str() {
            "cornell" => cornell::scene(),
            "pillars" => pillars::scene(),
            "glossy" => glossy::scene(),
            "mirror" => mirror::scene(),
            "mirror_moving" => mirror_moving::scene(),
            "hall" => hall::scene(),
            "hall_railings" => hall::railings_moving(),
            "hall_sun" => hall::sun_moving(),
            "fog" => fog::scene(),
            "leaves" => leaves::scene(),
            "lamps" => lamps::scene(),
            "tiles" => tiles::scene(),
            "door" => door::scene(),
            "chapel" => chapel::scene(),
            "vitrine" => vitrine::scene(),
            _ if lower.ends_with(".gltf") || lower.ends_with(".glb") => gltf_file::load(name.as_ref())?,
            _ => return Err(Error::UnknownScene { given: name.to_string() }),
        };
        scene.options = *options;
        Ok(scene)
    }

    /// The view at a frame.
    pub fn view(&self, frame: u32) -> View {
        (self.camera)(seconds(if self.options.static_camera { 0 } else { frame }))
    }

    /// Factor of all lights and emitters (not of the environment) at a frame.
    pub fn light_scale(&self, frame: u32) -> f32 {
        (self.light_scale)(self.lit_frame(frame))
    }

    /// Emission of each material at a frame, with the factor of all lights in it.
    pub fn emissions(&self, frame: u32) -> Vec<Vec3> {
        let (all, lit) = (self.light_scale(frame), self.lit_frame(frame));
        let mut emissions: Vec<_> = self.materials.iter().map(|material| material.emission * all).collect();
        for own in &self.emission_scales {
            emissions[own.material] *= (own.scale)(lit);
        }
        emissions
    }

    /// Frame that lights are of.
    fn lit_frame(&self, frame: u32) -> u32 {
        if self.options.static_light {
            0
        } else {
            frame
        }
    }

    /// The world at a frame.
    pub fn moment(&self, frame: u32) -> Moment {
        let object_time = seconds(if self.options.static_objects { 0 } else { frame });
        Moment { view: self.view(frame), object_time, light_frame: frame }
    }

    /// The view at a time in seconds, whatever the options say.
    pub fn view_at(&self, time: f32) -> View {
        (self.camera)(time)
    }

    /// `world_from_object` of each instance at a time in seconds.
    pub fn transforms(&self, time: f32) -> Vec<Affine3A> {
        self.instances
            .iter()
            .map(|instance| match &instance.placement {
                Placement::Fixed(transform) => *transform,
                Placement::Animated(path) => path(time),
            })
            .collect()
    }

    /// The lights that are not meshes at a time in seconds.
    pub fn lamps_at(&self, time: f32) -> Vec<Lamp> {
        let mut lamps = self.lamps.clone();
        for (lamp, path) in &self.lamp_paths {
            lamps[*lamp] = lamps[*lamp].moved(&path(time));
        }
        lamps
    }

    /// Whether the world looks alike at two moments: time may pass where nothing moves and no light changes.
    pub fn looks_alike(&self, a: &Moment, b: &Moment) -> bool {
        let lit = |moment: &Moment| (self.light_scale(moment.light_frame), self.emissions(moment.light_frame));
        let placed = |time: f32| (self.transforms(time), self.lamps_at(time));
        a.view == b.view
            && (a.object_time == b.object_time || placed(a.object_time) == placed(b.object_time))
            && (a.light_frame == b.light_frame || lit(a) == lit(b))
    }

    /// Sets the camera's path.
    pub fn set_camera(&mut self, path: impl Fn(f32) -> View + Send + Sync + 'static) {
        self.camera = Box::new(path);
    }

    /// Sets the path of one of [`Self::lamps`].
    pub fn set_lamp_path(&mut self, lamp: usize, path: impl Fn(f32) -> Affine3A + Send + Sync + 'static) {
        self.lamp_paths.push((lamp, Box::new(path)));
    }

    /// Whether light passes through some of it.
    pub fn has_glass(&self) -> bool {
        self.materials.iter().any(|material| material.glass.is_some())
    }

    /// Sets the lights' intensity over the frames.
    pub fn set_light_scale(&mut self, scale: impl Fn(u32) -> f32 + Send + Sync + 'static) {
        self.light_scale = Box::new(scale);
    }

    /// Sets the emission of one material over the frames, as a factor of its own.
    pub fn set_emission_scale(&mut self, material: usize, scale: impl Fn(u32) -> f32 + Send + Sync + 'static) {
        self.emission_scales.push(EmissionScale { material, scale: Box::new(scale) });
    }

    /// Adds a mesh, a material and one fixed instance of them.
    pub fn place(&mut self, mesh: Mesh, material: Material, transform: Affine3A) {
        let mesh = self.add_mesh(mesh);
        let material = self.add_material(material);
        self.add_instance(mesh, material, Placement::Fixed(transform));
    }

    /// Adds a mesh and gives its index.
    pub fn add_mesh(&mut self, mesh: Mesh) -> usize {
        self.meshes.push(mesh);
        self.meshes.len() - 1
    }

    /// Adds a material and gives its index.
    pub fn add_material(&mut self, material: Material) -> usize {
        self.materials.push(material);
        self.materials.len() - 1
    }

    /// Adds an instance.
    pub fn add_instance(&mut self, mesh: usize, material: usize, placement: Placement) {
        self.instances.push(Instance { mesh, material, placement });
    }
}

/// Time on a way that ends at `turn` and goes back as it came, again and again: a window is open for longer than a way is long.
fn to_and_fro(time: f32, turn: f32) -> f32 {
    turn - (time.rem_euclid(2.0 * turn) - turn).abs()
}

fn seconds(frame: u32) -> f32 {
    frame as f32 / FRAMES_PER_SECOND
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_world_looks_alike_while_nothing_moves_and_no_light_changes() {
        let view = View { eye: Vec3::ZERO, target: Vec3::NEG_Z, up: Vec3::Y, vertical_fov: 0.8 };
        let mut scene = Scene::new("test", view);
        scene.set_light_scale(|frame| if frame < 8 { 1.0 } else { 0.1 });
        let at = |object_time, light_frame| Moment { view, object_time, light_frame };
        assert!(scene.looks_alike(&at(0.0, 0), &at(9.0, 7)), "nothing is there that could move");
        assert!(!scene.looks_alike(&at(0.0, 7), &at(0.0, 8)));
        assert!(!scene.looks_alike(&at(0.0, 0), &Moment { view: View { eye: Vec3::X, ..view }, ..at(0.0, 0) }));
        let placement = Placement::Animated(Box::new(|time| Affine3A::from_translation(Vec3::X * (time - 1.0).max(0.0))));
        scene.add_instance(0, 0, placement);
        assert!(scene.looks_alike(&at(0.0, 0), &at(1.0, 0)), "it has not started yet");
        assert!(!scene.looks_alike(&at(1.0, 0), &at(1.5, 0)));
    }
}
