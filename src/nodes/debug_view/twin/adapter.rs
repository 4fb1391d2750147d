//! The stage on the bindings of a pass.

use super::*;
use crate::reference::bindings::Bindings;
use crate::reference::compare::{Rule, Tolerance};
use crate::reference::luminance_history::luminance_histories;
use crate::reference::rules::{pixels, HALF};
use crate::reference::visibility::histories_of;
use crate::Error;

/// Colours go through a power, which devices round each in its own way.
const PICTURE: Tolerance = Tolerance { relative: 4e-3, absolute: 2e-4, ..HALF };

/// How what it writes is compared with the GPU.
pub(crate) const RULES: &[Rule] = &[pixels("debug_view", PICTURE)];

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let transforms = b.instance_transforms()?;
    let visible = b.has("visibility_history").then(|| histories_of(b, ["visibility_history", ""], 0)).transpose()?;
    let luminance_history = if b.has("luminance_history_0") { luminance_histories(b, "luminance_history")? } else { Vec::new() };
    let inputs = DebugViewInputs {
        guide: b.packed("guide")?,
        surface_motion: b.packed("surface_motion")?,
        statistics: &b.statistics()?,
        luminance_history: &luminance_history.iter().collect::<Vec<_>>(),
        irradiance_history: &if b.has("history_0") { b.colours("history")? } else { Vec::new() },
        history_confidence: b.optional_scalar("history_confidence")?,
        gradient: b.optional_colour("gradient")?,
        stratum_size: b.stratum_size()?,
        block_percentiles: &if b.has("block_percentiles_0") { b.uints("block_percentiles")? } else { Vec::new() },
        firefly_limits: &if b.has("firefly_limits_0") { b.uints("firefly_limits")? } else { Vec::new() },
        noisy: &b.colours("noisy")?,
        reflection: b.has("reflection").then(|| b.uint("reflection")).transpose()?,
        visibility_history: visible.as_ref(),
        albedo: b.optional_colour("albedo")?,
        instances: Instances {
            hit_id: b.optional_uint("specular_hit_id")?,
            motion: b.optional_colour("specular_motion")?,
            surface_id: b.optional_uint("surface_id")?,
            transforms: transforms.as_deref(),
        },
    };
    let picture = debug_view(b.frame, b.tuning, &inputs, b.view);
    b.write("debug_view", picture)
}
