//! Surfaces that move along the line of sight as the still world does not, such as a weapon that the
//! camera carries. Without a depth in the motion, each of their pixels seems uncovered.

use crate::error::Result;
use crate::frame::FrameInputs;
use crate::loader::{previous_depths, StillWorld};
use crate::motion;
use crate::roles::Role;
use crate::setup::Setup;
use atrous::config::MotionDepth;

/// The relative difference of depths that the history does not forgive.
const DIFFERS: f32 = 0.05;
/// The share of the picture that is worth it.
const WORTH: f32 = 0.001;

/// Has depths of the frame before looked up, where surfaces need it.
///
/// # Errors
/// None that the setup did not have.
pub fn check([before, now]: &[FrameInputs; 2], setup: &mut Setup) -> Result<()> {
    let has_all = setup.sequence.is_some() && setup.mapping.has(Role::Motion);
    let lacks_depth = setup.config.conventions.motion_depth == MotionDepth::None;
    if !has_all || !lacks_depth || now.params.reset.is_some() {
        return Ok(());
    }
    let c = &setup.config.conventions;
    let (surface, previous) = (motion::of_frame(now, &before.params, c), motion::of_frame(before, &before.params, c));
    let still = StillWorld::of(now, &before.params, setup);
    let looked_up = previous_depths(&surface, &still, Some(&previous), now.params.render_extent);
    let differs = |i: &usize| {
        let expected = surface.previous_depth[*i];
        surface.is_surface[*i] && (looked_up[*i] - expected).abs() > DIFFERS * expected.abs()
    };
    let count = (0..looked_up.len()).filter(differs).count();
    if count as f32 > WORTH * looked_up.len() as f32 {
        setup.carry_depth()?;
        setup.note(format!(
            "  note: {count} pixels move towards the camera or with it, and the motion has no depth: it is looked up in the frame before"
        ));
    }
    Ok(())
}
