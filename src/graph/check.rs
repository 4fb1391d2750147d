//! Checks of a whole graph that types cannot do: reads of unwritten content, cycles, two writers,
//! histories without an end.

use super::Graph;
use crate::contract::{Access, Lifetime, PassDecl, ResourceId, UseFrame};

impl Graph {
    /// Puts the passes in the order of their phases, and notes everything that is wrong with the whole.
    pub(super) fn check(&mut self) {
        self.sort_by_phase();
        for index in 0..self.resources.len() {
            let id = ResourceId(index as u32);
            self.check_reads(id);
            self.check_writers(id);
            self.check_history(id);
        }
    }

    /// A stable order: nodes of a phase stay as they were added.
    fn sort_by_phase(&mut self) {
        let mut passes: Vec<_> = std::mem::take(&mut self.passes).into_iter().zip(std::mem::take(&mut self.owners)).collect();
        passes.sort_by_key(|(pass, _)| pass.phase);
        (self.passes, self.owners) = passes.into_iter().unzip();
    }

    fn touches(&self, id: ResourceId, frame: UseFrame, want: fn(Access) -> bool) -> Vec<usize> {
        let touches = |pass: &PassDecl| pass.uses.iter().any(|u| u.resource == id && u.frame == frame && want(u.access));
        (0..self.passes.len()).filter(|&i| touches(&self.passes[i])).collect()
    }

    /// Checks that everything that is read in a frame was written earlier in it, or is the host's.
    fn check_reads(&mut self, id: ResourceId) {
        let resource = &self.resources[id.0 as usize];
        if matches!(resource.lifetime, Lifetime::Input { .. }) {
            return;
        }
        let name = resource.name.clone();
        let reads = self.touches(id, UseFrame::Current, Access::reads);
        let writes = self.touches(id, UseFrame::Current, Access::writes);
        let Some(&read) = reads.iter().find(|&&read| !writes.iter().any(|&write| write < read)) else { return };
        let reader = self.owners[read].clone();
        let problem = match writes.iter().copied().find(|&write| write > read) {
            None => "nothing writes it; give it what another node returned, or read the previous frame's".to_owned(),
            Some(write) if self.depends(write, read) => {
                let writer = &self.owners[write];
                format!("a cycle: `{writer}` writes it and itself reads what follows from `{reader}`; one of them has to read the previous frame's")
            }
            Some(write) => format!("`{}` writes it later in the frame; add that node first", self.owners[write]),
        };
        self.fail(&reader, &name, problem);
    }

    /// Whether a pass reads the output of an earlier one, directly or through others.
    fn depends(&self, later: usize, earlier: usize) -> bool {
        let mut reached = vec![false; self.passes.len()];
        reached[earlier] = true;
        for index in earlier + 1..=later {
            // Every pass may count bad values, in any order.
            let reads =
                |u: &&crate::contract::Use| u.frame == UseFrame::Current && u.access.reads() && u.resource != self.statistics;
            reached[index] = self.passes[index].uses.iter().filter(reads).any(|u| {
                let writers = self.touches(u.resource, UseFrame::Current, Access::writes);
                writers.iter().any(|&writer| writer < index && reached[writer])
            });
        }
        reached[later]
    }

    /// Checks that whole contents come from one node; others may work in place behind it.
    fn check_writers(&mut self, id: ResourceId) {
        let whole = |access: Access| access.writes() && !access.reads();
        let mut owners: Vec<_> =
            self.touches(id, UseFrame::Current, whole).into_iter().map(|pass| self.owners[pass].clone()).collect();
        owners.dedup();
        if let [first, second, ..] = owners.as_slice() {
            let problem = format!("`{first}` writes it, too; give each node an image of its own, or name one scope for each");
            let (second, name) = (second.clone(), self.resources[id.0 as usize].name.clone());
            self.fail(&second, &name, problem);
        }
    }

    /// A history is written in every frame; one with a single copy after its last read.
    fn check_history(&mut self, id: ResourceId) {
        let resource = &self.resources[id.0 as usize];
        let previous = self.touches(id, UseFrame::Previous, |_| true);
        let writes = self.touches(id, UseFrame::Current, Access::writes);
        let (name, lifetime) = (resource.name.clone(), resource.lifetime);
        let Some(&reader) = previous.last() else { return };
        let node = self.owners[reader].clone();
        match (lifetime, writes.first()) {
            (Lifetime::History | Lifetime::HistoryInPlace, None) => {
                let writer = self.states[id.0 as usize].writer.unwrap_or("let a node write it");
                self.fail(&node, &name, format!("nothing writes this history; {writer}"));
            }
            (Lifetime::HistoryInPlace, Some(&write)) if write <= reader => {
                let problem = format!(
                    "`{}` overwrites this history, which has one copy, before it is read; add the reader first",
                    self.owners[write]
                );
                self.fail(&node, &name, problem);
            }
            (Lifetime::History | Lifetime::HistoryInPlace, Some(_)) => {}
            (lifetime, _) => {
                let problem = format!("the previous frame's was asked for, but it is {lifetime:?}, of which there is one; keep a copy by a node that writes a transient");
                self.fail(&node, &name, problem);
            }
        }
    }
}
