//! Memory that a declaration needs.

use super::{alias, Declaration, Lifetime, ResourceDecl, ResourceId, Span};
use crate::error::Error;

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

/// A transient that you place in memory of your own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Placement {
    /// The transient.
    pub resource: ResourceId,
    /// Bytes that its image needs, as `vkGetImageMemoryRequirements` tells.
    pub size: u64,
    /// Alignment that its image needs.
    pub alignment: u64,
    /// Where it goes: set by [`Declaration::place`].
    pub offset: u64,
}

impl Declaration {
    /// Bytes, known before you allocate any.
    pub fn memory(&self) -> Memory {
        let bytes = |r: &ResourceDecl| r.bytes(self.setup()) * r.lifetime.copies() as u64;
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

    /// Places transients in memory of yours, so that those share it whose lives do not overlap: fills
    /// in each offset, and returns the bytes needed in all. Tell a [`Tracker`](crate::Tracker) of
    /// each pair that overlaps.
    ///
    /// # Errors
    /// [`Error::WrongKind`] for a resource that is no transient, [`Error::Size`] for a size beyond
    /// 2^48 bytes or an alignment that is no power of two.
    pub fn place(&self, transients: &mut [Placement]) -> Result<u64, Error> {
        const MOST: u64 = 1 << 48;
        let mut spans = Vec::with_capacity(transients.len());
        for &Placement { resource, size, alignment, .. } in transients.iter() {
            let decl = self.resource(resource);
            let life = self.life(resource).filter(|_| decl.lifetime == Lifetime::Transient);
            let Some((first, last)) = life else {
                return Err(Error::WrongKind { resource: decl.name.clone(), needed: "a transient" });
            };
            if size > MOST || alignment > MOST || !alignment.is_power_of_two() {
                let given = format!("{size} bytes with an alignment of {alignment}");
                let needed = format!("at most {MOST} bytes and a power of two, as vkGetImageMemoryRequirements tells");
                return Err(Error::Size { resource: decl.name.clone(), given, needed });
            }
            spans.push(Span { first, last, size, alignment });
        }
        let (offsets, total) = alias(&spans);
        transients.iter_mut().zip(offsets).for_each(|(placement, offset)| placement.offset = offset);
        Ok(total)
    }

    fn span(&self, id: ResourceId, first: usize, last: usize) -> Span {
        Span { first, last, size: self.resource(id).bytes(self.setup()), alignment: 1 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::Config;

    /// The transients of a preset, each of as many bytes.
    fn transients(declaration: &Declaration, size: u64, alignment: u64) -> Vec<Placement> {
        declaration.transients().map(|(resource, ..)| Placement { resource, size, alignment, offset: u64::MAX }).collect()
    }

    #[test]
    fn transients_that_live_together_are_apart() {
        let declaration = Config::new([64, 64]).declare().expect("valid");
        let mut placed = transients(&declaration, 1000, 256);
        let total = declaration.place(&mut placed).expect("good sizes");
        assert!(total < 1000 * placed.len() as u64, "{total} bytes for {}", placed.len());
        for (i, a) in placed.iter().enumerate() {
            assert!(a.offset % 256 == 0 && a.offset + a.size <= total, "{a:?} of {total}");
            for b in &placed[..i] {
                let lives = [a, b].map(|p| declaration.life(p.resource).expect("used"));
                let together = lives[0].0 <= lives[1].1 && lives[1].0 <= lives[0].1;
                let apart = a.offset + a.size <= b.offset || b.offset + b.size <= a.offset;
                assert!(apart || !together, "{a:?} and {b:?}");
            }
        }
    }

    #[test]
    fn sizes_that_no_image_has_are_refused() {
        let declaration = Config::new([64, 64]).declare().expect("valid");
        for (size, alignment, word) in
            [(u64::MAX, 1, "18446744073709551615 bytes"), (8, 3, "alignment of 3"), (8, 0, "alignment of 0")]
        {
            let error = declaration.place(&mut transients(&declaration, size, alignment)).expect_err("no such image").to_string();
            assert!(error.contains(word), "{error}");
        }
        let resource = declaration.find("depth").expect("an input");
        let error = declaration.place(&mut [Placement { resource, size: 8, alignment: 1, offset: 0 }]).expect_err("no transient");
        assert!(error.to_string().contains("`depth` is not a transient"), "{error}");
    }
}
