//! Albedos above 1 that change from pixel to pixel. For rough metal Mitsuba writes the value of its lobe,
//! from 0 at the rim of a ball to 10 in the middle: divided by that, even light is not. An albedo that is
//! above 1 all over a surface is a wrong number, and counts as 1.

use crate::error::Result;
use crate::frame::{self, FrameInputs};
use crate::frame_files::FrameFiles;
use crate::lobes::{self, Shown, ABOVE, VARIED};
use crate::roles::Role;
use crate::setup::Setup;

/// The share of the picture from which on something is done about it.
const WORTH: f32 = 0.005;

const ALBEDOS: [(&str, &[Role]); 2] =
    [("albedo", &[Role::Albedo, Role::DiffuseColour]), ("specular_albedo", &[Role::SpecularAlbedo])];

/// Parts the light of surfaces without an albedo from that of others, or leaves albedos out that are lobes.
///
/// # Errors
/// Light that cannot be filtered without them.
pub fn check(files: &FrameFiles, frame: &FrameInputs, setup: &mut Setup) -> Result<()> {
    let share = without_albedo(files, frame, setup).unwrap_or(0.0);
    if share > WORTH {
        setup.part_lobes()?;
        setup.note(format!(
            "  note: {:.0} % of the picture has no albedo of its own, as mirrors, glass and metal have none: its light is filtered apart, as specular light",
            100.0 * share
        ));
        return Ok(());
    }
    for (name, roles) in ALBEDOS {
        let is_open = roles.iter().any(|role| setup.mapping.has(*role) && !setup.is_named(*role));
        let Some(texels) = frame.images.get(name).filter(|_| is_open) else { continue };
        let largest: Vec<f32> = texels.iter().map(|t| t[0].max(t[1]).max(t[2])).collect();
        let count = largest.iter().filter(|v| **v > ABOVE).count();
        let pairs = || largest.windows(2).filter(|pair| pair.iter().all(|v| *v > ABOVE));
        let varied = pairs().filter(|pair| (pair[0] - pair[1]).abs() > VARIED * pair[0]).count();
        let share = count as f32 / texels.len().max(1) as f32;
        if share > WORTH && 2 * varied > pairs().count() {
            setup.leave_out(roles)?;
            setup.note(format!(
                "  note: {name} is above 1 in {:.0} % of the picture and varies there, so it is no reflectance: left out",
                100.0 * share
            ));
        }
    }
    Ok(())
}

/// The share of the picture that has no albedo, where its light may be parted.
fn without_albedo(files: &FrameFiles, frame: &FrameInputs, setup: &Setup) -> Option<f32> {
    if !setup.may_have_lobes() {
        return None;
    }
    let (channels, _) = frame::channels(files, setup).ok()?;
    let shown = lobes::shown(&frame.images, frame::told(&channels, frame.through.as_ref()))?;
    Some(shown.iter().filter(|shown| **shown == Shown::Lobe).count() as f32 / shown.len().max(1) as f32)
}
