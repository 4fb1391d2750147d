//! The stage `rendered_guide`: the guide of every rendered pixel.

use crate::nodes::import::twin::{surface_of, ImportInputs, GUIDE};
use crate::reference::bindings::Bindings;
use crate::reference::compare::Rule;
use crate::reference::guide::pack_guide;
use crate::reference::projection::Projections;
use crate::reference::Image;
use crate::Error;

/// How what it writes is compared with the GPU.
pub(crate) const RULES: &[Rule] = &[Rule { binding: "rendered_guide", ..GUIDE }];

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let inputs = ImportInputs {
        surface_id: b.optional_uint("surface_id")?,
        albedo: b.optional_colour("albedo")?,
        ..ImportInputs::new(b.colour("depth")?, b.colour("normal")?)
    };
    let frame = b.frame.of_guides();
    let projections = Projections::new(&frame);
    let guide = Image::compute(b.extent_of("rendered_guide")?, frame.render_extent, |p| {
        pack_guide(&surface_of(&frame, &inputs, &projections, p).0)
    });
    b.write("rendered_guide", guide)
}
