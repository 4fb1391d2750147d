//! Turns the host's guides into ours. The only stage that knows the host's encodings.

use super::{Builder, Frame, HOST_COLOUR, HOST_ID, HOST_SCALAR, PACKED_32, PACKED_64};
use crate::config::Config;
use crate::contract::{Lifetime, Phase, ResourceId};
use crate::shaders;

/// Packed guides: see `docs/stages.md` for the bits.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Guides {
    pub guide: ResourceId,
    pub surface_motion: ResourceId,
    pub depth_gradient: ResourceId,
    pub object_normal: Option<ResourceId>,
}

pub(crate) fn import(b: &mut Builder, frame: Frame, config: &Config) -> Guides {
    // A filter without history has no use for the guide of the previous frame.
    let guide_lifetime = if config.has_history() { Lifetime::History } else { Lifetime::Transient };
    let guides = Guides {
        guide: b.image("guide", PACKED_64, guide_lifetime),
        surface_motion: b.image("surface_motion", PACKED_64, Lifetime::Transient),
        depth_gradient: b.image("depth_gradient", PACKED_32, Lifetime::Transient),
        object_normal: config.object_normal.then(|| b.image("object_normal_guide", PACKED_32, Lifetime::History)),
    };
    let depth = b.input("depth", HOST_SCALAR, false);
    let normal = b.input("normal", HOST_COLOUR, false);
    let motion = b.input("motion", HOST_COLOUR, true);
    let roughness = b.input("roughness", HOST_SCALAR, true);
    let transforms = b.instance_transforms();
    let mut uses = vec![
        frame.constants.uniform(),
        frame.statistics.updated(),
        depth.sampled(),
        normal.sampled(),
        motion.sampled(),
        roughness.sampled(),
        transforms.storage(),
        guides.guide.written(),
        guides.surface_motion.written(),
        guides.depth_gradient.written(),
    ];
    if config.surface_id {
        uses.push(b.input("surface_id", HOST_ID, false).sampled());
    }
    if let Some(packed) = guides.object_normal {
        uses.push(b.input("object_normal", HOST_COLOUR, false).sampled());
        uses.push(packed.written());
    }
    let shader = match (config.surface_id, config.object_normal) {
        (false, false) => &shaders::IMPORT_SURFACE_ID_0_OBJECT_NORMAL_0,
        (true, false) => &shaders::IMPORT_SURFACE_ID_1_OBJECT_NORMAL_0,
        (false, true) => &shaders::IMPORT_SURFACE_ID_0_OBJECT_NORMAL_1,
        (true, true) => &shaders::IMPORT_SURFACE_ID_1_OBJECT_NORMAL_1,
    };
    b.dispatch("import", Phase::BeforeLighting, shader, 0, uses);
    guides
}
