//! A host's plan of a frame: which passes run between which barriers, and which transients share memory; and the check that it
//! respects the declared uses. Knows no device.

use crate::graphs::dice::Dice;
use atrous::{Declaration, Lifetime, ResourceId, Shape, Use};

/// Passes in batches, with a barrier between one batch and the next; and a place for each transient image.
#[derive(Clone)]
pub struct Plan {
    pub batches: Vec<Vec<usize>>,
    /// Offset and size of the memory of a transient image, by resource.
    pub places: Vec<Option<(u64, u64)>>,
}

/// Whether one use has to come after the other, in the order of the declaration.
fn conflict(declaration: &Declaration, a: &Use, b: &Use) -> bool {
    // The copies of a history are two resources; one that has a single copy is one.
    let is_pair = declaration.resource(a.resource).lifetime == Lifetime::History;
    let same = a.resource == b.resource && (!is_pair || a.frame == b.frame);
    same && (a.access.writes() || b.access.writes())
}

fn depends(declaration: &Declaration, later: usize, earlier: usize) -> bool {
    let uses = |pass: usize| &declaration.passes()[pass].uses;
    uses(later).iter().any(|a| uses(earlier).iter().any(|b| conflict(declaration, a, b)))
}

/// Whether a pass is recorded in frames without a view.
pub fn is_recorded(declaration: &Declaration, pass: usize) -> bool {
    !declaration.passes()[pass].name.starts_with("debug_view")
}

impl Plan {
    /// Passes in a random order that the uses allow, in batches that are as large as they may be or smaller; transients at random
    /// places. `size` gives bytes and alignment of an image.
    pub fn random(declaration: &Declaration, dice: &mut Dice, size: impl Fn(ResourceId) -> (u64, u64)) -> Self {
        let mut waiting: Vec<usize> = (0..declaration.passes().len()).filter(|&pass| is_recorded(declaration, pass)).collect();
        let mut batches = Vec::new();
        while !waiting.is_empty() {
            let free = |&pass: &usize| !waiting.iter().any(|&other| other < pass && depends(declaration, pass, other));
            let mut ready: Vec<usize> = waiting.iter().copied().filter(free).collect();
            let mut batch = vec![ready.swap_remove(dice.below(ready.len() as u32) as usize)];
            while !ready.is_empty() && dice.coin() {
                batch.push(ready.swap_remove(dice.below(ready.len() as u32) as usize));
            }
            waiting.retain(|pass| !batch.contains(pass));
            batches.push(batch);
        }
        let mut plan = Self { batches, places: vec![None; declaration.resources().len()] };
        plan.place(declaration, dice, size);
        plan
    }

    /// Gives each transient image the first offset, from a random one on or from 0, at which nothing lives meanwhile.
    fn place(&mut self, declaration: &Declaration, dice: &mut Dice, size: impl Fn(ResourceId) -> (u64, u64)) {
        let ids = (0..declaration.resources().len() as u32).map(ResourceId);
        for id in ids.filter(|&id| is_transient_image(declaration, id)) {
            let Some(life) = self.life(declaration, id) else { continue };
            let (bytes, alignment) = size(id);
            let mut offset = if dice.below(4) == 0 { (bytes / 2).next_multiple_of(alignment) } else { 0 };
            let busy: Vec<_> = (0..self.places.len())
                .filter(|&other| self.life(declaration, ResourceId(other as u32)).is_some_and(|l| l.0 <= life.1 && life.0 <= l.1))
                .filter_map(|other| self.places[other])
                .collect();
            while let Some((start, length)) = busy.iter().find(|(start, length)| offset < start + length && *start < offset + bytes)
            {
                offset = (start + length).next_multiple_of(alignment);
            }
            self.places[id.0 as usize] = Some((offset, bytes));
        }
    }

    /// First and last batch that use a resource.
    pub fn life(&self, declaration: &Declaration, id: ResourceId) -> Option<(usize, usize)> {
        let touches = |batch: &Vec<usize>| batch.iter().any(|&p| declaration.passes()[p].uses.iter().any(|u| u.resource == id));
        Some((self.batches.iter().position(touches)?, self.batches.iter().rposition(touches)?))
    }

    /// What is wrong with the plan: reads after writes, writes after reads and writes after writes that no barrier orders as the
    /// declaration does, and images that live in the same memory at once.
    pub fn hazards(&self, declaration: &Declaration) -> Vec<String> {
        let mut hazards = Vec::new();
        let batch_of = |pass: usize| self.batches.iter().position(|batch| batch.contains(&pass));
        let name = |pass: usize| &declaration.passes()[pass].name;
        for later in (0..declaration.passes().len()).filter(|&pass| is_recorded(declaration, pass)) {
            for earlier in (0..later).filter(|&earlier| is_recorded(declaration, earlier) && depends(declaration, later, earlier)) {
                if batch_of(earlier).zip(batch_of(later)).is_none_or(|(a, b)| a >= b) {
                    hazards.push(format!("{} is not ordered after {}", name(later), name(earlier)));
                }
            }
        }
        for (i, a) in self.places.iter().enumerate() {
            for (j, b) in self.places.iter().enumerate().take(i) {
                let (Some(a), Some(b)) = (a, b) else { continue };
                let lives = [i, j].map(|k| self.life(declaration, ResourceId(k as u32)).unwrap_or_default());
                let meet = lives[0].0 <= lives[1].1 && lives[1].0 <= lives[0].1;
                if meet && a.0 < b.0 + b.1 && b.0 < a.0 + a.1 {
                    let [a, b] = [i, j].map(|k| &declaration.resources()[k].name);
                    hazards.push(format!("{a} and {b} live in the same memory at once"));
                }
            }
        }
        hazards
    }
}

pub fn is_transient_image(declaration: &Declaration, id: ResourceId) -> bool {
    let resource = declaration.resource(id);
    resource.lifetime == Lifetime::Transient && matches!(resource.shape, Shape::Image { .. })
}
