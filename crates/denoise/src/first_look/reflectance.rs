//! Albedos above 1. For rough metal Mitsuba writes the value of its lobe, from 0 at the rim of a ball to
//! 10 in the middle: divided by that, even light is not.

use crate::error::Result;
use crate::frame::FrameInputs;
use crate::roles::Role;
use crate::setup::Setup;

/// A little more is rounding, or a painter's colour.
const ABOVE: f32 = 1.05;
/// The share of the picture from which on it is left out.
const WORTH: f32 = 0.005;

const ALBEDOS: [(&str, &[Role]); 2] =
    [("albedo", &[Role::Albedo, Role::DiffuseColour]), ("specular_albedo", &[Role::SpecularAlbedo])];

/// Leaves out albedos that reflect more light than there is.
///
/// # Errors
/// Light that cannot be filtered without them.
pub fn check(frame: &FrameInputs, setup: &mut Setup) -> Result<()> {
    for (name, roles) in ALBEDOS {
        let is_open = roles.iter().any(|role| setup.mapping.has(*role) && !setup.is_named(*role));
        let Some(texels) = frame.images.get(name).filter(|_| is_open) else { continue };
        let count = texels.iter().filter(|t| t[..3].iter().any(|v| *v > ABOVE)).count();
        let share = count as f32 / texels.len().max(1) as f32;
        if share > WORTH {
            setup.leave_out(roles)?;
            setup.note(format!(
                "  note: {name} is above 1 in {:.0} % of the picture, so it is no reflectance: left out",
                100.0 * share
            ));
        }
    }
    Ok(())
}
