//! Whether the bindings of a host fit the uses of a pass, and the descriptor that each becomes.

use crate::contract::{Binding, Declaration, Dispatch, Lifetime, PassDecl, Shape, Slot};
use crate::error::Error;
use crate::shaders::MAX_BINDINGS;

/// Inputs without which a graph with gradients has none.
const GRADIENT_INPUTS: [&str; 2] = ["reshaded_radiance", "sparse_gradient"];

/// Whether a pass can be recorded with them.
pub(crate) fn check_bindings(declaration: &Declaration, pass: &PassDecl, bindings: &[Binding]) -> Result<(), Error> {
    if bindings.len() != pass.uses.len() || bindings.len() > MAX_BINDINGS {
        return Err(Error::Bindings { pass: pass.name.clone(), given: bindings.len(), needed: pass.uses.len() });
    }
    for (u, binding) in pass.uses.iter().zip(bindings) {
        let resource = declaration.resource(u.resource);
        let name = || resource.name.clone();
        match (binding, resource.shape) {
            (Binding::Absent, _) if resource.lifetime == Lifetime::Input { optional: true } => {}
            (Binding::Absent, _) => return Err(Error::NotBound(name())),
            (Binding::Image { .. }, Shape::Image { .. }) => {}
            (Binding::Buffer { .. }, Shape::Buffer { .. }) => {}
            (Binding::Buffer { .. }, _) => return Err(Error::WrongKind { resource: name(), needed: "a buffer" }),
            (Binding::Image { .. }, _) => return Err(Error::WrongKind { resource: name(), needed: "an image" }),
        }
    }
    Ok(())
}

/// Bit i: the host gives binding number i something this frame.
pub(crate) fn present(dispatch: &Dispatch, bindings: &[Binding]) -> u32 {
    let slots = dispatch.slots.iter().zip(dispatch.shader.bindings.iter());
    let bound = slots.filter(|(slot, _)| given(**slot, bindings).is_some());
    bound.fold(0, |bits, (_, binding)| bits | 1 << binding.number)
}

/// The binding of the host for a slot.
fn given(slot: Slot, bindings: &[Binding]) -> Option<Binding> {
    slot.wired.and_then(|i| bindings.get(i)).copied().filter(|binding| *binding != Binding::Absent)
}

/// The binding that a descriptor points at. For an absent binding it is a different one of its
/// kind, which the shader does not read then.
pub(crate) fn descriptor(slot: Slot, bindings: &[Binding]) -> Binding {
    given(slot, bindings).or_else(|| bindings.get(slot.stand_in).copied()).unwrap_or(Binding::Absent)
}

/// The input that gradients come from, where the pass needs it and it is absent.
pub(crate) fn absent_gradients(declaration: &Declaration, pass: usize, bindings: &[Binding]) -> Option<String> {
    let uses = &declaration.passes.get(pass)?.uses;
    let absent = uses.iter().zip(bindings).filter(|(_, b)| **b == Binding::Absent);
    absent.map(|(u, _)| &declaration.resource(u.resource).name).find(|name| GRADIENT_INPUTS.contains(&name.as_str())).cloned()
}
