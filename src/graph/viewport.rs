//! Pictures that are a part of the host's images.

use super::Graph;
use crate::contract::{PassDecl, ResourceDecl, Setup};
use crate::error::Error;
use crate::shaders::OF_HOST;

impl Graph {
    /// Tells each shader which of its bindings have such an image.
    pub(super) fn mark_parts_of_images(&mut self) {
        if self.setup.image_extent.is_none() {
            return;
        }
        let Self { passes, resources, setup, owners, errors, .. } = self;
        for (pass, owner) in passes.iter_mut().zip(owners) {
            let bindings = bindings_of_host(pass, resources, setup);
            let knows = pass.dispatch().is_none_or(|dispatch| dispatch.shader.constant(OF_HOST).is_some());
            if bindings != 0 && !knows {
                let problem = "the stage reads or writes the first pixels of an image; leave Config::image_extent out".to_owned();
                errors.push(Error::Graph { node: owner.clone(), port: OF_HOST.to_owned(), problem });
            }
            pass.set_constant(OF_HOST, bindings);
        }
    }
}

/// Bit i: binding i has an image of the host, in which the picture is a part.
fn bindings_of_host(pass: &PassDecl, resources: &[ResourceDecl], setup: &Setup) -> u32 {
    let is_part = |wired: usize| resources[pass.uses[wired].resource.0 as usize].is_part_of_image(setup);
    let slots = pass.dispatch().into_iter().flat_map(|dispatch| dispatch.shader.bindings.iter().zip(&dispatch.slots));
    let given = slots.filter(|(_, slot)| slot.wired.is_some_and(is_part));
    given.fold(0, |bits, (binding, _)| bits | 1 << binding.number)
}
