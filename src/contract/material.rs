//! Classes of materials, each with numbers of its own.

use crate::error::Error;

/// Numbers of a class of materials, which stand in [`crate::FrameParams::materials`]. Where [`crate::Config::material_class`] is on, a
/// pixel of the class is filtered with them: three are factors of those in [`crate::Tuning`], each 0.01 to 100.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(default, deny_unknown_fields))]
pub struct Material {
    /// Factor of `depth_tolerance` and `sigma_z`. Raising it keeps more history and blurs across steps. Default: 1.
    pub depth: f32,
    /// Factor of the tolerated difference of normals, 1 − cosine: of `normal_tolerance` and `sigma_n`. Raising it makes normals matter
    /// less, for example of hair. Default: 1.
    pub normal: f32,
    /// Factor of `sigma_l`. Raising it blurs light more; at 0.01 nearly nothing is blurred, for example a screen. Default: 1.
    pub light: f32,
    /// Longest history in frames, 1 to 1024; at most `max_history_length`. Lowering it follows changes faster and leaves more noise.
    /// Default: 1024.
    pub longest_history: f32,
}

impl Default for Material {
    fn default() -> Self {
        Self { depth: 1.0, normal: 1.0, light: 1.0, longest_history: 1024.0 }
    }
}

/// In the order of the fields, as shaders, C and files have them.
impl From<Material> for [f32; 4] {
    fn from(Material { depth, normal, light, longest_history }: Material) -> Self {
        [depth, normal, light, longest_history]
    }
}

impl From<[f32; 4]> for Material {
    fn from([depth, normal, light, longest_history]: [f32; 4]) -> Self {
        Self { depth, normal, light, longest_history }
    }
}

impl Material {
    /// Classes that there can be.
    pub const CLASSES: usize = 16;

    /// Checks the numbers of a class.
    pub(crate) fn validate(&self, class: usize) -> Result<(), Error> {
        let numbers = ["depth", "normal", "light", "longest_history"].into_iter().zip(<[f32; 4]>::from(*self));
        for (name, given) in numbers {
            let (min, max) = if name == "longest_history" { (1.0, 1024.0) } else { (0.01, 100.0) };
            if !(min..=max).contains(&given) {
                return Err(Error::Material { class, name, given, min, max });
            }
        }
        Ok(())
    }
}
