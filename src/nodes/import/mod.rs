//! Turns your guides into ours. The only stage that knows your encodings.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::pass;
use crate::contract::{Grid, Input, Lifetime, Phase, TexelGrid};
use crate::graph::{Graph, Guides, RenderedGuides, PACKED_32, PACKED_64};
use crate::shaders;

/// Parameters of the node `import`. [`Graph::conventions`] has the encodings of your images.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Import {
    /// Whether you have an image `surface_id`. Default: true.
    pub surface_id: bool,
    /// Whether you have an image `object_normal`, by which a turning object keeps its history.
    /// Costs 8 bytes per pixel. Default: false.
    pub object_normal: bool,
    /// Whether light is divided by your image `albedo`, so that surfaces too dark to divide it are kept apart. Default: true.
    pub albedo: bool,
}

impl Default for Import {
    fn default() -> Self {
        Self { surface_id: true, object_normal: false, albedo: true }
    }
}

impl Graph {
    /// Packs your depth, normal, roughness, id and motion.
    ///
    /// Inputs: `depth`, `normal`; optional `motion`, `roughness`, `instance_transforms`; as [`Import`] says `surface_id`,
    /// `object_normal`, optional `albedo`.
    pub fn import(&mut self, import: Import) -> Guides {
        let node = self.node("import", "");
        // The names without it are those of the light, which the filters read.
        let prefix = if self.has_light_extent() { "rendered_" } else { "" };
        let made = self.guide_images(prefix, TexelGrid::Rendered(1), import.object_normal);
        let module = [&shaders::IMPORT_SURFACE_ID_0, &shaders::IMPORT_SURFACE_ID_1][usize::from(import.surface_id)];
        let mut pass = pass(&node, module)
            .phase(Phase::BeforeLighting)
            .grid(Grid::Guides)
            .bind("depth", self.input(Input::DEPTH))
            .bind("normal", self.input(Input::NORMAL))
            .bind("motion", self.input(Input::MOTION))
            .bind("roughness", self.input(Input::ROUGHNESS))
            .bind("instance_transforms", self.input(Input::INSTANCE_TRANSFORMS))
            .bind("guide", made.guide)
            .bind("surface_motion", made.surface_motion)
            .bind("depth_gradient", made.depth_gradient)
            .bind_some("object_normal_guide", made.object_normal);
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
        let rendered = self.refreshed_guides(made);
        self.light_guides(rendered)
    }

    /// Images of guides, which are those of every rendered pixel.
    pub(super) fn guide_images(&mut self, prefix: &str, texels: impl Into<TexelGrid>, object_normal: bool) -> Guides {
        let texels = texels.into();
        let mut image = |name: &str, format| self.named_image(&format!("{prefix}{name}"), "", format, texels, Lifetime::Transient);
        let guide = image("guide", PACKED_64);
        let surface_motion = image("surface_motion", PACKED_64);
        let depth_gradient = image("depth_gradient", PACKED_32);
        let object_normal = object_normal.then(|| image("object_normal_guide", PACKED_32));
        let rendered = RenderedGuides { guide, surface_motion };
        Guides { guide, surface_motion, depth_gradient, object_normal, rendered }
    }

    /// Guides with the content that they have now.
    pub(super) fn refreshed_guides(&self, made: Guides) -> Guides {
        let [guide, surface_motion, depth_gradient] =
            [made.guide, made.surface_motion, made.depth_gradient].map(|image| self.refreshed(image));
        let object_normal = made.object_normal.map(|image| self.refreshed(image));
        let rendered = RenderedGuides { guide, surface_motion };
        Guides { guide, surface_motion, depth_gradient, object_normal, rendered }
    }
}
