//! Resources that a phase uses, for work of yours between two phases.

use super::{Access, Declaration, Phase, ResourceId, UseFrame};

/// First and last access of a resource inside one phase: for semaphores and queue ownership between phases.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BoundaryUse {
    /// The resource.
    pub resource: ResourceId,
    /// The copy.
    pub frame: UseFrame,
    /// First access of the phase.
    pub first: Access,
    /// Last access of the phase.
    pub last: Access,
    /// Whether the phase writes it.
    pub written: bool,
}

/// Resources that a phase uses.
pub type Boundary = Vec<BoundaryUse>;

impl Declaration {
    /// First and last access of every resource that a phase uses, in order of first use.
    pub fn boundary(&self, phase: Phase) -> Boundary {
        let mut boundary: Boundary = Vec::new();
        for u in self.passes.iter().filter(|p| p.phase == phase).flat_map(|p| &p.uses) {
            match boundary.iter_mut().find(|b| b.resource == u.resource && b.frame == u.frame) {
                Some(b) => {
                    b.last = u.access;
                    b.written |= u.access.writes();
                }
                None => boundary.push(BoundaryUse {
                    resource: u.resource,
                    frame: u.frame,
                    first: u.access,
                    last: u.access,
                    written: u.access.writes(),
                }),
            }
        }
        boundary
    }
}
