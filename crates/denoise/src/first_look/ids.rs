//! Ids that change from frame to frame: Mitsuba numbers shapes in the order in which its threads happen to load them.

use super::comparison::Comparison;
use crate::error::Result;
use crate::frame::FrameInputs;
use crate::raster::Raster;
use crate::roles::Role;
use crate::setup::Setup;

/// The share of pixels that have to find their id again where motion leads.
const FOUND: f32 = 0.5;

/// Takes ids that change for numbers that tell surfaces apart within a frame. Returns whether they do.
///
/// # Errors
/// None that the setup did not have.
pub fn check(pair: &[FrameInputs; 2], setup: &mut Setup) -> Result<bool> {
    let is_open = setup.mapping.has(Role::Id) && !setup.is_named(Role::Id) && setup.knows_motion();
    let [Some(before), Some(now)] = pair.each_ref().map(|frame| frame.surface_id.as_deref().filter(|_| is_open)) else {
        return Ok(false);
    };
    let Some(comparison) = Comparison::new(pair, setup) else { return Ok(false) };
    let (raster, surface) = (Raster::new(pair[1].params.render_extent), &comparison.surface);
    let is_found = |i: usize| {
        let ([x, y], [dx, dy]) = (raster.place(i), surface.motion_px[i]);
        let at = raster.at([x as f32 + dx, y as f32 + dy])?;
        // Depth may have gaps.
        (before[at] != 0).then(|| before[at] == now[i])
    };
    let found: Vec<bool> = (0..raster.pixels()).filter(|i| surface.is_surface[*i]).filter_map(is_found).collect();
    let share = found.iter().filter(|found| **found).count() as f32 / found.len().max(1) as f32;
    let changes = !found.is_empty() && share < FOUND;
    if changes {
        setup.number_shapes()?;
        setup.note(format!(
            "  note: {:.0} % of the ids are others in the next frame: they tell surfaces apart within a frame alone",
            100.0 * (1.0 - share)
        ));
    }
    Ok(changes)
}
