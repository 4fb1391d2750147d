//! Turns your guides into ours. The only stage that knows your encodings.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::pass;
use crate::contract::{Lifetime, Phase};
use crate::graph::{Graph, Guides, HOST_COLOUR, HOST_ID, HOST_SCALAR, PACKED_32, PACKED_64};
use crate::shaders;

/// Parameters of the node `import`. [`Graph::conventions`] has the encodings of your images.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Import {
    /// Whether you have an image `surface_id`. Default: true.
    pub surface_id: bool,
    /// Whether you have an image `object_normal`, by which a turning object keeps its history.
    /// Costs 8 bytes per pixel. Default: false.
    pub object_normal: bool,
}

impl Default for Import {
    fn default() -> Self {
        Self { surface_id: true, object_normal: false }
    }
}

impl Graph {
    /// Packs your depth, normal, roughness, id and motion.
    ///
    /// Inputs: `depth`, `normal`; optional `motion`, `roughness`, `instance_transforms`; as [`Import`] says `surface_id`,
    /// `object_normal`.
    pub fn import(&mut self, import: Import) -> Guides {
        let node = self.node("import", "");
        let guide = self.named_image("guide", "", PACKED_64, 1, Lifetime::Transient);
        let surface_motion = self.named_image("surface_motion", "", PACKED_64, 1, Lifetime::Transient);
        let depth_gradient = self.named_image("depth_gradient", "", PACKED_32, 1, Lifetime::Transient);
        let object_normal =
            import.object_normal.then(|| self.named_image("object_normal_guide", "", PACKED_32, 1, Lifetime::Transient));
        let module = [&shaders::IMPORT_SURFACE_ID_0, &shaders::IMPORT_SURFACE_ID_1][usize::from(import.surface_id)];
        let mut pass = pass(&node, module)
            .phase(Phase::BeforeLighting)
            .bind("depth", self.input("depth", HOST_SCALAR, 1, false))
            .bind("normal", self.input("normal", HOST_COLOUR, 1, false))
            .bind("motion", self.input("motion", HOST_COLOUR, 1, true))
            .bind("roughness", self.input("roughness", HOST_SCALAR, 1, true))
            .bind("instance_transforms", self.instance_transforms())
            .bind("guide", guide)
            .bind("surface_motion", surface_motion)
            .bind("depth_gradient", depth_gradient)
            .bind_some("object_normal_guide", object_normal);
        if import.surface_id {
            pass = pass.bind("surface_id", self.input("surface_id", HOST_ID, 1, false));
        }
        if import.object_normal {
            pass = pass.bind("object_normal", self.input("object_normal", HOST_COLOUR, 1, false));
        }
        self.add(pass);
        Guides {
            guide: self.refreshed(guide),
            surface_motion: self.refreshed(surface_motion),
            depth_gradient: self.refreshed(depth_gradient),
            object_normal: object_normal.map(|image| self.refreshed(image)),
        }
    }
}
