//! Sharing of an output's image: a transient of the same shape that is dead before the output is written needs no memory of its own.

use super::Graph;
use crate::contract::{life, Lifetime, ResourceId, Shape};

impl Graph {
    /// Gives transients the images of outputs: those of the same format and size whose last use
    /// comes before the output's first, in the same phase, since until then the host may still read
    /// the output of the previous frame.
    pub(super) fn put_transients_into_outputs(&mut self) {
        let ids = (0..self.resources.len() as u32).map(ResourceId);
        let mut given = vec![None; self.resources.len()];
        for output in ids.clone().filter(|id| self.is_image(*id, Lifetime::Output)) {
            let Some((mut free_until, _)) = life(&self.passes, output) else { continue };
            let (phase, shape) = (self.passes[free_until].phase, self.resources[output.0 as usize].shape);
            // From the back, so that what is written last, next to the output, comes first.
            let mut transients: Vec<_> = ids
                .clone()
                .filter(|id| self.is_image(*id, Lifetime::Transient) && given[id.0 as usize].is_none())
                .filter(|id| self.resources[id.0 as usize].shape == shape)
                .filter_map(|id| life(&self.passes, id).map(|(first, last)| (last, first, id)))
                .collect();
            transients.sort_unstable_by(|a, b| b.cmp(a));
            for (last, first, id) in transients {
                if last < free_until && self.passes[first].phase == phase {
                    given[id.0 as usize] = Some(output);
                    free_until = first;
                }
            }
        }
        self.replace(&given);
    }

    fn is_image(&self, id: ResourceId, lifetime: Lifetime) -> bool {
        let resource = &self.resources[id.0 as usize];
        resource.lifetime == lifetime && matches!(resource.shape, Shape::Image { .. })
    }

    /// Takes resources out, each for its replacement.
    fn replace(&mut self, by: &[Option<ResourceId>]) {
        let place = |id: ResourceId| by[..id.0 as usize].iter().filter(|by| by.is_none()).count() as u32;
        for (i, by) in by.iter().enumerate().filter_map(|(i, by)| Some((i, (*by)?))) {
            let usage = self.resources[i].image_usage;
            self.resources[by.0 as usize].image_usage |= usage;
        }
        for u in self.passes.iter_mut().flat_map(|pass| &mut pass.uses) {
            u.resource = ResourceId(place(by[u.resource.0 as usize].unwrap_or(u.resource)));
        }
        let mut stays = by.iter().map(Option::is_none);
        self.resources.retain(|_| stays.next().unwrap_or(true));
    }
}
