//! Turns your guides into ours. The only stage that knows your encodings.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::pass;
use crate::contract::{Input, Lifetime, Phase};
use crate::graph::{Graph, Guides, Rendered, PACKED_32, PACKED_64};
use crate::shaders;

/// Parameters of the node `import`. [`crate::Setup::conventions`] has the encodings of your images.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Import {
    /// Whether you have an image `surface_id`. Default: true.
    pub surface_id: bool,
    /// Whether you have an image `object_normal`, by which a turning object keeps its history.
    /// Costs 8 bytes per pixel. Default: false.
    pub object_normal: bool,
    /// Whether you have an image `material_class`, by whose numbers pixels are accumulated and filtered. Default: false.
    pub material_class: bool,
    /// Whether light is divided by your image `albedo`, so that surfaces too dark to divide it are kept apart. Default: true.
    pub albedo: bool,
}

impl Default for Import {
    fn default() -> Self {
        Self { surface_id: true, object_normal: false, material_class: false, albedo: true }
    }
}

impl Graph {
    /// Packs your depth, normal, id and motion, and counts what is bad of these and of your roughness.
    ///
    /// Inputs: `depth`, `normal`; optional `motion`, `roughness`, `instance_transforms`; as [`Import`] says `surface_id`,
    /// `object_normal`, `material_class`, optional `albedo`.
    pub fn import(&mut self, import: Import) -> Guides {
        let node = self.node("import", "");
        let guide = self.named_image("guide", "", PACKED_64, 1, Lifetime::Transient);
        let surface_motion = self.named_image("surface_motion", "", PACKED_64, 1, Lifetime::Transient);
        let object_normal =
            import.object_normal.then(|| self.named_image("object_normal_guide", "", PACKED_32, 1, Lifetime::Transient));
        let modules = [
            [&shaders::IMPORT_SURFACE_ID_0_OBJECT_NORMALS_0, &shaders::IMPORT_SURFACE_ID_1_OBJECT_NORMALS_0],
            [&shaders::IMPORT_SURFACE_ID_0_OBJECT_NORMALS_1, &shaders::IMPORT_SURFACE_ID_1_OBJECT_NORMALS_1],
        ];
        let module = modules[usize::from(import.object_normal)][usize::from(import.surface_id)];
        let mut pass = pass(&node, module)
            .phase(Phase::BeforeLighting)
            .bind("depth", self.input(Input::DEPTH))
            .bind("normal", self.input(Input::NORMAL))
            .bind("motion", self.input(Input::MOTION))
            .bind("roughness", self.input(Input::ROUGHNESS))
            .bind("instance_transforms", self.input(Input::INSTANCE_TRANSFORMS))
            .bind("guide", guide)
            .bind("surface_motion", surface_motion)
            .bind_some("object_normal_guide", object_normal);
        if import.surface_id {
            pass = pass.bind("surface_id", self.input(Input::SURFACE_ID));
        }
        if import.albedo {
            pass = pass.bind_some("albedo", self.dividing_albedo());
        }
        if import.object_normal {
            pass = pass.bind("object_normal", self.input(Input::OBJECT_NORMAL));
        }
        self.add(pass);
        let [guide, surface_motion] = [guide, surface_motion].map(|image| self.refreshed(image));
        let object_normal = object_normal.map(|image| self.refreshed(image));
        let material_class = import.material_class.then(|| self.input(Input::MATERIAL_CLASS));
        let rendered = match self.has_light_extent() {
            true => Rendered::Host { surface_id: import.surface_id, albedo: import.albedo },
            false => Rendered::Stored,
        };
        Guides { guide, surface_motion, object_normal, material_class, rendered }
    }
}
