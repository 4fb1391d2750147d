//! Sharing of an output's image: a transient of the same shape that is dead before the output is written needs no memory of its own.

use super::Graph;
use crate::contract::{alias, life, Lifetime, ResourceId, Shape, Span};

impl Graph {
    /// Gives transients the images of outputs: those of the same format and size whose last use
    /// comes before the output's first, in the same phase, since until then the host may still read
    /// the output of the previous frame.
    pub(super) fn put_transients_into_outputs(&mut self) {
        let (back, front) = (self.placed(true), self.placed(false));
        // Either order may leave less to place elsewhere.
        let given = if self.bytes_apart(&front) < self.bytes_apart(&back) { front } else { back };
        self.replace(&given);
    }

    /// The output in which each transient lies, filled from the back of the frame or from its front.
    fn placed(&self, from_back: bool) -> Vec<Option<ResourceId>> {
        let ids = (0..self.resources.len() as u32).map(ResourceId);
        let mut given = vec![None; self.resources.len()];
        for output in ids.clone().filter(|id| self.is_image(*id, Lifetime::Output)) {
            let Some((written, _)) = life(&self.passes, output) else { continue };
            let (phase, shape) = (self.passes[written].phase, self.resources[output.0 as usize].shape);
            let mut transients: Vec<_> = ids
                .clone()
                .filter(|id| self.is_image(*id, Lifetime::Transient) && given[id.0 as usize].is_none())
                .filter(|id| self.resources[id.0 as usize].shape == shape)
                .filter_map(|id| life(&self.passes, id).map(|(first, last)| (last, first, id)))
                .filter(|&(last, first, _)| last < written && self.passes[first].phase == phase)
                .collect();
            transients.sort_unstable_by(|a, b| if from_back { b.cmp(a) } else { (a.1, a.0, a.2).cmp(&(b.1, b.0, b.2)) });
            let mut taken: Vec<(usize, usize)> = Vec::new();
            for (last, first, id) in transients {
                if taken.iter().all(|&(begin, end)| last < begin || end < first) {
                    given[id.0 as usize] = Some(output);
                    taken.push((first, last));
                }
            }
        }
        given
    }

    /// Bytes of the transients that lie in no output.
    fn bytes_apart(&self, given: &[Option<ResourceId>]) -> u64 {
        let ids = (0..self.resources.len() as u32).map(ResourceId);
        let apart =
            ids.filter(|id| given[id.0 as usize].is_none() && self.resources[id.0 as usize].lifetime == Lifetime::Transient);
        let span = |id: ResourceId| {
            let (first, last) = life(&self.passes, id)?;
            Some(Span { first, last, size: self.resources[id.0 as usize].bytes(&self.setup), alignment: 1 })
        };
        alias(&apart.filter_map(span).collect::<Vec<_>>()).1
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
