//! Albedos above 1 that change from pixel to pixel. For rough metal Mitsuba writes the value of its lobe,
//! from 0 at the rim of a ball to 10 in the middle: divided by that, even light is not. An albedo that is
//! above 1 all over a surface is a wrong number, and counts as 1.

use crate::error::Result;
use crate::frame::FrameInputs;
use crate::roles::Role;
use crate::setup::Setup;

/// A little more is rounding, or a painter's colour.
const ABOVE: f32 = 1.05;
/// The share of the picture from which on it is left out.
const WORTH: f32 = 0.005;

/// The least relative difference of pixels beside each other in a lobe.
const VARIED: f32 = 0.01;

const ALBEDOS: [(&str, &[Role]); 2] =
    [("albedo", &[Role::Albedo, Role::DiffuseColour]), ("specular_albedo", &[Role::SpecularAlbedo])];

/// Leaves out albedos that are lobes.
///
/// # Errors
/// Light that cannot be filtered without them.
pub fn check(frame: &FrameInputs, setup: &mut Setup) -> Result<()> {
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
