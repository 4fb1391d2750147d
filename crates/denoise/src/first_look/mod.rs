//! A look at the first frames, before any is filtered: what a renderer writes that is not as it seems.
//! Each finding is told in a line, and the setup is made to fit it.

mod comparison;
mod depth;
mod guides;
mod ids;
mod moves;
mod noise;
mod parts;
mod reflectance;
mod tiles;

use crate::check;
use crate::display_transform::DisplayTransform;
use crate::error::Result;
use crate::frame::{self, FrameInputs};
use crate::frame_files::FrameFiles;
use crate::range::{self, Range};
use crate::roles::Role;
use crate::setup::Setup;
use crate::unfiltered;
use atrous::config::Preset;

/// Alpha is called noisy where so many of its pixels are between 0 and 1, and differ from those beside.
const NOISY_ALPHA: f32 = 0.05;

/// Frames between two that are compared for slow motion.
const APART: usize = 3;

/// Looks at the first two frames, and at the last one for its range. Returns warnings. A frame that
/// cannot be read is not looked at: the run names it when it comes to it, and keeps those before.
///
/// # Errors
/// What cannot be filtered without what has to be left out.
pub fn take(frames: &[FrameFiles], setup: &mut Setup) -> Result<Vec<String>> {
    let mut warnings = Vec::new();
    if setup.is_verbatim() {
        return Ok(conventions(frames, setup));
    }
    let findings = match frames.first().map(|first| frame::channels(first, setup)) {
        Some(Ok((channels, _))) => parts::look(channels, setup),
        _ => Vec::new(),
    };
    for finding in findings {
        match finding.roles.as_slice() {
            [Role::Environment] => setup.hide_environment()?,
            roles => setup.leave_out(roles)?,
        }
        setup.note(finding.note);
    }
    if let Some((files, first)) = frames.first().and_then(|first| Some((first, frame::load(first, setup).ok()?))) {
        setup.has_means = unfiltered::are_means(&first, setup);
        reflectance::check(files, &first, setup)?;
    }
    let mut looked_at = pair(frames, setup);
    for finding in [ids::check, guides::fill_gaps] {
        if let Some(given) = &looked_at {
            if finding(given, setup)? {
                looked_at = pair(frames, setup);
            }
        }
    }
    if let Some([first, second]) = looked_at.as_ref().filter(|_| !setup.knows_motion() && setup.config.preset != Preset::Stabilize)
    {
        // Over several frames slow motion adds up.
        let later = frames.get(APART).or(frames.last()).and_then(|files| frame::load(files, setup).ok());
        moves::check([first, later.as_ref().unwrap_or(second)], setup);
    }
    // What moves in unknown ways cannot be told from noise.
    if let Some(pair) = looked_at.as_ref().filter(|_| !setup.stills) {
        guides::check(pair, setup)?;
    }
    range(frames, setup);
    if let Some(pair) = pair(frames, setup) {
        warnings.extend(noise::check(&pair, setup));
        depth::check(&pair, setup)?;
        alpha(&pair[0], setup);
    }
    warnings.extend(conventions(frames, setup));
    Ok(warnings)
}

/// The first two frames.
fn pair(frames: &[FrameFiles], setup: &Setup) -> Option<[FrameInputs; 2]> {
    let [first, second, ..] = frames else { return None };
    Some([frame::load(first, setup).ok()?, frame::load(second, setup).ok()?])
}

/// The range of the first, the second and the last frame.
fn range(frames: &[FrameFiles], setup: &mut Setup) {
    let (mut pictures, mut reference) = (Vec::new(), None);
    let looked_at = frames.iter().take(2).chain(frames.last().filter(|_| frames.len() > 2));
    for frame in looked_at.filter_map(|files| frame::load(files, setup).ok()) {
        reference = reference.or(frame.reference);
        pictures.push(frame.noisy);
    }
    let shown = reference.map_or_else(|| range::shown(pictures.iter().flatten()), |r| range::shown(r.iter()));
    setup.shown = DisplayTransform::new(&setup.header, shown);
    setup.range = Range::of(pictures.iter().flatten());
    let exponent = setup.range.exponent;
    if exponent != 0 {
        setup.note(format!(
            "  note: the light is multiplied by 2^{exponent} for the filter, whose half floats end at 65504, and the result by 2^{}",
            -exponent
        ));
    }
}

/// Says that noisy coverage is left as it is.
fn alpha(frame: &FrameInputs, setup: &mut Setup) {
    let Some(alpha) = &frame.alpha else { return };
    let width = setup.config.allocated_extent[0] as usize;
    let is_rough = |i: &usize| {
        let partly = alpha[*i] > 0.0 && alpha[*i] < 1.0;
        partly && alpha.get(i + 1).is_some_and(|next| (next - alpha[*i]).abs() > 0.1) && !(i + 1).is_multiple_of(width)
    };
    let share = (0..alpha.len()).filter(is_rough).count() as f32 / alpha.len().max(1) as f32;
    if share > NOISY_ALPHA {
        setup.note("  note: alpha is noisy; it is left as it is, since only light is filtered".into());
    }
}

/// Mistakes of the conventions in the first pair, where matrices and depth are there.
fn conventions(frames: &[FrameFiles], setup: &Setup) -> Vec<String> {
    let has_depth = setup.mapping.has(Role::Depth) || setup.mapping.has(Role::Position);
    if setup.sequence.is_none() || !has_depth || frames.len() < 2 {
        return Vec::new();
    }
    let reports = check::run(&frames[..2], setup).unwrap_or_default();
    reports.iter().flat_map(|(.., report)| check::mistakes(report, &check::declared(setup))).collect()
}
