//! The stage `clear_claims`.

use crate::reference::bindings::Bindings;
use crate::reference::compare::{Reading, Rule, Unit};
use crate::reference::rules::{rule, EXACT};
use crate::reference::Image;
use crate::Error;

/// How what it writes is compared with the GPU.
pub(crate) const RULES: &[Rule] = &[rule("claims", Unit::Stratum, Reading::Plain, EXACT)];

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let none = Image::new(b.extent_of("claims")?, 0_u32);
    b.write("claims", none)
}
