//! Memory that a declaration needs.

use super::{alias, Declaration, Lifetime, ResourceDecl, ResourceId, Span};

/// Bytes of one resource.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ResourceMemory {
    /// Name of the resource.
    pub name: String,
    /// Life of its content.
    pub lifetime: Lifetime,
    /// Bytes of all its copies; 0 for an input, which is yours.
    pub bytes: u64,
}

/// Bytes of texels and buffers, before a device's own alignment.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Memory {
    /// Survives the frame.
    pub history: u64,
    /// Transients, aliased by lifetime as the built-in executor does.
    pub transient: u64,
    /// Transients if none is aliased.
    pub transient_unaliased: u64,
    /// Outputs, which are yours.
    pub output: u64,
    /// Each resource.
    pub resources: Vec<ResourceMemory>,
}

impl Declaration {
    /// Bytes, known before you allocate any.
    pub fn memory(&self) -> Memory {
        let bytes = |r: &ResourceDecl| r.bytes(self.allocated_extent()) * r.lifetime.copies() as u64;
        let sum = |want: fn(Lifetime) -> bool| self.resources.iter().filter(|r| want(r.lifetime)).map(bytes).sum();
        let spans: Vec<Span> = self.transients().map(|(id, first, last)| self.span(id, first, last)).collect();
        Memory {
            history: sum(Lifetime::is_history),
            transient: alias(&spans).1,
            transient_unaliased: sum(|l| l == Lifetime::Transient),
            output: sum(|l| l == Lifetime::Output),
            resources: self
                .resources
                .iter()
                .map(|r| ResourceMemory { name: r.name.clone(), lifetime: r.lifetime, bytes: bytes(r) })
                .collect(),
        }
    }

    fn span(&self, id: ResourceId, first: usize, last: usize) -> Span {
        Span { first, last, size: self.resource(id).bytes(self.allocated_extent()), alignment: 1 }
    }
}
