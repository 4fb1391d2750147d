//! Guides with noise in them: fog, depth of field and motion blur mix what several surfaces have. A
//! guide like that draws edges where there are none, and light that passes the filter by keeps its noise.

use super::tiles::Pair;
use crate::error::Result;
use crate::frame::FrameInputs;
use crate::motion;
use crate::roles::Role;
use crate::setup::Setup;
use crate::unfiltered::{self, ALBEDO, EMISSION};

/// The share of the tiles from which on a guide is left out.
const NOISY: f32 = 0.35;
/// The same where the place of a surface in the frame before is not known: without its motion, or with jitter, by which a fine
/// texture differs from frame to frame.
const NOISY_UNKNOWN: f32 = 0.6;

/// What is done about noise in a guide.
#[derive(Clone, Copy, PartialEq)]
enum Remedy {
    /// Its average still steers the filter.
    Smooth,
    /// Light would be divided by it, or pass with its noise.
    LeaveOut,
}

/// An image, the roles that it is made of, its value for comparison, between −1 and 1 or nearly so, and
/// the remedy.
type Guide = (&'static str, &'static [Role], fn([f32; 4]) -> f32, Remedy);

const GUIDES: &[Guide] = &[
    (ALBEDO, &[Role::Albedo, Role::DiffuseColour], mean, Remedy::LeaveOut),
    ("specular_albedo", &[Role::SpecularAlbedo], mean, Remedy::Smooth),
    (EMISSION, &[Role::Emission, Role::Environment], compressed, Remedy::LeaveOut),
    ("normal", &[Role::Normal], slanted, Remedy::Smooth),
];
/// Averages of depths are of no surface.
const DEPTH: [Role; 2] = [Role::Depth, Role::Position];

fn mean([r, g, b, _]: [f32; 4]) -> f32 {
    (r + g + b) / 3.0
}

fn compressed(light: [f32; 4]) -> f32 {
    let v = mean(light).max(0.0);
    v / (1.0 + v)
}

/// One number for a direction: no axis is left out, and none is opposite to another.
fn slanted([x, y, z, _]: [f32; 4]) -> f32 {
    0.5 * x + 0.7 * y + 0.3 * z
}

/// Leaves noisy guides out.
///
/// # Errors
/// What cannot be filtered without them.
pub fn check(pair: &[FrameInputs; 2], setup: &mut Setup) -> Result<()> {
    let [before, now] = pair;
    if now.params.reset.is_some() {
        return Ok(());
    }
    let surface = motion::of_frame(now, &before.params, &setup.config.conventions);
    let is_jittered = pair.iter().any(|frame| frame.params.jitter != [0.0; 2]);
    let limit = if setup.knows_motion() && !is_jittered { NOISY } else { NOISY_UNKNOWN };
    let averages = unfiltered::is_averaged(now, setup);
    let share = |values: [Vec<f32>; 2], skipped: Option<&[bool]>| {
        let values = values.each_ref().map(Vec::as_slice);
        Pair { extent: now.params.render_extent, values, motion_px: &surface.motion_px, skipped }.noisy_share()
    };
    let images = |name: &str, of: fn([f32; 4]) -> f32| {
        let [a, b] = [before, now].map(|frame| frame.images.get(name));
        a.zip(b).map(|(a, b)| [a, b].map(|texels| texels.iter().map(|t| of(*t)).collect()))
    };
    let is_open = |role: &Role| setup.mapping.has(*role) && !setup.is_named(*role);
    let depth = if DEPTH.iter().any(is_open) { share([before, now].map(|frame| nearness(frame, setup)), None) } else { 0.0 };
    // What is averaged over frames may be noisy: outlines, and an albedo as far as depths say whose it is.
    let outlines = averages.then(|| unfiltered::are_borders(&surface, now.params.render_extent));
    let has_mean = |name: &str| name == ALBEDO && averages && setup.has_means && depth <= limit;
    let mut found = Vec::new();
    for (name, roles, of, remedy) in GUIDES.iter().filter(|(name, roles, ..)| roles.iter().any(is_open) && !has_mean(name)) {
        let skipped = outlines.as_deref().filter(|_| *name == EMISSION);
        found.push((*name, *roles, images(name, *of).map_or(0.0, |values| share(values, skipped)), *remedy));
    }
    found.push(("depth", &DEPTH, depth, Remedy::LeaveOut));
    for (name, roles, noisy, remedy) in found.into_iter().filter(|(_, _, noisy, _)| *noisy > limit) {
        let done = match remedy {
            Remedy::Smooth => {
                setup.smoothed.insert(name);
                "smoothed"
            }
            Remedy::LeaveOut => {
                setup.leave_out(roles)?;
                "left out"
            }
        };
        setup.note(format!(
            "  note: {name} is noisy in {:.0} % of where it is, as it is behind fog and out of focus: {done}",
            100.0 * noisy
        ));
    }
    Ok(())
}

/// Depths between 0 and 1, the background at 1.
fn nearness(frame: &FrameInputs, setup: &Setup) -> Vec<f32> {
    let far = setup.config.conventions.background_depth;
    let depths = frame.images.get("depth").map(Vec::as_slice).unwrap_or_default();
    let is_surface = |z: f32| z.is_finite() && z > 0.0 && z < far;
    let mut surfaces: Vec<f32> = depths.iter().map(|t| t[0]).filter(|z| is_surface(*z)).collect();
    surfaces.sort_by(f32::total_cmp);
    let middle = surfaces.get(surfaces.len() / 2).copied().unwrap_or(1.0);
    depths.iter().map(|t| if is_surface(t[0]) { t[0] / (t[0] + middle) } else { 1.0 }).collect()
}
