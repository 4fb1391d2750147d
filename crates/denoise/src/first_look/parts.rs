//! Do the parts of the light add up to the picture? Where a renderer leaves one out of it, as Blender
//! does with the sky behind a transparent film, or where the picture was changed, the parts are no help.

use crate::frame_images::{Channels, Texels};
use crate::layouts::Layout;
use crate::roles::Role;
use crate::setup::Setup;

/// A part is above the whole where it is so by this share of it.
const SLACK: f32 = 0.02;
/// The same of a sum that may be on either side, of parts that were rounded each by itself.
const SUM_SLACK: f32 = 0.05;
/// Values below this share of the mean are no evidence.
const DARK: f32 = 0.01;
/// The share of the pixels with a part, above the whole in which it is no part of it.
const CONTRADICTS: f32 = 0.02;

/// Parts that are not in the picture.
pub struct Finding {
    /// Their channels.
    pub roles: Vec<Role>,
    /// The finding in a line.
    pub note: String,
}

/// Looks for parts that are not in the picture of a frame.
pub fn look(mut channels: Channels<'_>, setup: &Setup) -> Vec<Finding> {
    let has = |role: Role| setup.mapping.has(role);
    let noisy = channels.vectors(Role::Noisy).filter(|_| !has(Role::Lighting));
    let Some(noisy) = noisy else { return Vec::new() };
    let floor = DARK * mean(&noisy);
    let mut findings = Vec::new();
    let mut add = |name: &str, share: f32, roles: &[Role]| {
        if share > CONTRADICTS && !roles.iter().any(|role| setup.is_named(*role)) {
            let note = format!(
                "  note: {name} does not add up with the picture in {:.0} % of its pixels (a transparent film, or a picture that was changed after it was rendered): the picture is filtered whole, without it",
                100.0 * share
            );
            findings.push(Finding { roles: roles.to_vec(), note });
        }
    };
    // Light of fewer pixels stands for pixels that it was not traced for, whose parts are others.
    let is_of_all = setup.config.light_extent.is_none();
    let above = |part: Option<Texels>| part.filter(|_| is_of_all).map_or(0.0, |part| share_above(&part, &noisy, floor));
    add("environment", above(channels.vectors(Role::Environment)), &[Role::Environment]);
    add("emission", above(channels.vectors(Role::Emission)), &[Role::Emission]);
    if has(Role::DemodulatedDirect) {
        add("direct", above(channels.direct()), &[Role::DemodulatedDirect]);
    }
    if has(Role::DemodulatedSpecularDirect) {
        let roles = [Role::DemodulatedSpecularDirect, Role::DemodulatedSpecularIndirect];
        add("specular", above(channels.specular()), &roles);
    }
    if setup.mapping.layout == Layout::Blender {
        add("volume", above(channels.volume()), &[Role::Volume, Role::VolumeIndirect]);
    }
    for pair in [[Role::Direct, Role::Indirect], [Role::Diffuse, Role::Specular]] {
        if let [Some(a), Some(b)] = pair.map(|role| channels.vectors(role)) {
            let share = share_beside([&a, &b], channels.emission(), &noisy, floor);
            add(&format!("{} and {}", pair[0].name(), pair[1].name()), share, &pair);
        }
    }
    findings
}

fn mean(texels: &Texels) -> f32 {
    texels.iter().flat_map(|t| &t[..3]).sum::<f32>() / (3 * texels.len().max(1)) as f32
}

/// The share of a part's pixels in which it is more than the whole.
fn share_above(part: &Texels, whole: &Texels, floor: f32) -> f32 {
    let is_lit = |p: &[f32; 4]| p[..3].iter().any(|v| *v > floor);
    let lit = part.iter().zip(whole).filter(|(part, _)| is_lit(part));
    let (mut pixels, mut above) = (0usize, 0usize);
    for (part, whole) in lit {
        pixels += 1;
        above += usize::from((0..3).any(|c| part[c] > whole[c] * (1.0 + SLACK) + floor));
    }
    above as f32 / pixels.max(1) as f32
}

/// The share of the pixels in which the sum of parts is not the whole.
fn share_beside(parts: [&Texels; 2], emission: Option<Texels>, whole: &Texels, floor: f32) -> f32 {
    let emitted = |i: usize, c: usize| emission.as_ref().map_or(0.0, |e| e[i][c]);
    let differs = |i: &usize| {
        (0..3).any(|c| {
            let sum = parts[0][*i][c] + parts[1][*i][c] + emitted(*i, c);
            (sum - whole[*i][c]).abs() > SUM_SLACK * whole[*i][c].abs() + floor
        })
    };
    (0..whole.len()).filter(differs).count() as f32 / whole.len().max(1) as f32
}
