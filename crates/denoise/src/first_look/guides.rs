//! Guides with noise in them: fog, depth of field and motion blur mix what several surfaces have. A
//! guide like that draws edges where there are none, and light that passes the filter by keeps its noise.

use super::comparison::Comparison;
use crate::error::Result;
use crate::frame::FrameInputs;
use crate::frame_images::Texels;
use crate::gaps;
use crate::raster::Raster;
use crate::roles::Role;
use crate::setup::Setup;
use crate::unfiltered::{self, ALBEDO, EMISSION};
use atrous::config::DepthEncoding;

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
/// Light of a medium.
const MEDIUM: [Role; 3] = [Role::Volume, Role::VolumeIndirect, Role::ScatteringDepth];

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

/// Has the gaps of depths filled where they are all their noise. Returns whether they are.
///
/// # Errors
/// None that the setup did not have.
pub fn fill_gaps(pair: &[FrameInputs; 2], setup: &mut Setup) -> Result<bool> {
    let Some(comparison) = Comparison::new(pair, setup) else { return Ok(false) };
    let far = setup.config.conventions.background_depth;
    let beyond = pair[0].images.get("depth").and_then(|depths| gaps::beyond(depths, far));
    // Depths of a device's buffer do not grow with distance.
    let is_depth = setup.mapping.has(Role::Depth) && setup.config.conventions.depth != DepthEncoding::Device;
    let Some(beyond) = beyond.filter(|_| is_depth && !setup.is_named(Role::Depth)) else { return Ok(false) };
    let given = comparison.share("depth", |depths| nearness(depths, far), None);
    let filled = |depths: &Texels| {
        let mut depths = depths.clone();
        gaps::fill(&mut depths, None, Raster::new(pair[1].params.render_extent), far, beyond);
        nearness(&depths, far)
    };
    let is_fog = given > comparison.limit && comparison.share("depth", filled, None) <= comparison.limit;
    if is_fog {
        setup.beyond = Some(beyond);
        let roles: Vec<Role> = MEDIUM.into_iter().filter(|role| !setup.is_named(*role)).collect();
        setup.leave_out(&roles)?;
        setup.note(format!(
            "  note: depth has gaps that change in {:.0} % of the picture, as it has in fog: they are filled from beside, and light of the fog is filtered with that of surfaces",
            100.0 * given
        ));
    }
    Ok(is_fog)
}

/// Leaves noisy guides out.
///
/// # Errors
/// What cannot be filtered without them.
pub fn check(pair: &[FrameInputs; 2], setup: &mut Setup) -> Result<()> {
    let Some(comparison) = Comparison::new(pair, setup) else { return Ok(()) };
    let now = &pair[1];
    let averages = unfiltered::is_averaged(now, setup);
    let is_open = |role: &Role| setup.mapping.has(*role) && !setup.is_named(*role);
    let far = setup.config.conventions.background_depth;
    let depth = if DEPTH.iter().any(is_open) { comparison.share("depth", |depths| nearness(depths, far), None) } else { 0.0 };
    // What is averaged over frames may be noisy: outlines, and an albedo as far as depths say whose it is.
    let outlines = averages.then(|| unfiltered::are_borders(&comparison.surface, now.params.render_extent));
    let is_foggy = setup.beyond.is_some() || depth > comparison.limit;
    let has_mean = |name: &str| name == ALBEDO && averages && setup.has_means && !is_foggy;
    let mut found = Vec::new();
    for (name, roles, of, remedy) in GUIDES.iter().filter(|(name, roles, ..)| roles.iter().any(is_open) && !has_mean(name)) {
        let skipped = outlines.as_deref().filter(|_| *name == EMISSION);
        let values = |texels: &Texels| texels.iter().map(|texel| of(*texel)).collect();
        found.push((*name, *roles, comparison.share(name, values, skipped), *remedy));
    }
    found.push(("depth", &DEPTH, depth, Remedy::LeaveOut));
    for (name, roles, noisy, remedy) in found.into_iter().filter(|(_, _, noisy, _)| *noisy > comparison.limit) {
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
fn nearness(depths: &Texels, far: f32) -> Vec<f32> {
    let is_surface = |z: f32| gaps::is_surface(z, far);
    let mut surfaces: Vec<f32> = depths.iter().map(|t| t[0]).filter(|z| is_surface(*z)).collect();
    surfaces.sort_by(f32::total_cmp);
    let middle = surfaces.get(surfaces.len() / 2).copied().unwrap_or(1.0);
    depths.iter().map(|t| if is_surface(t[0]) { t[0] / (t[0] + middle) } else { 1.0 }).collect()
}
