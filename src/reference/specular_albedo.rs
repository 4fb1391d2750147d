//! Reflectance of a coat or metal under light from everywhere: the fit of Karis 2014 to the split sum of Karis 2013.

use super::bindings::Bindings;
use super::conventions::roughness_channel;
use super::guide::Surface;
use super::projection::view_position;
use super::reflection::roughness_of;
use super::Image;
use crate::{Error, FrameConstants};
use glam::{IVec2, Mat3, Mat4, Vec3};

/// What the divisor of specular light is computed from, where the host does not give it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SpecularF0<'a> {
    /// rgb: reflectance at normal incidence.
    pub image: &'a Image<[f32; 4]>,
    /// Roughness of the host.
    pub roughness: Option<&'a Image<[f32; 4]>>,
}

impl<'a> SpecularF0<'a> {
    /// That a pass binds.
    pub(crate) fn of(b: &Bindings<'a>) -> Result<Option<Self>, Error> {
        let roughness = b.optional_colour("roughness")?;
        Ok(b.optional_colour("specular_f0")?.map(|image| Self { image, roughness }))
    }

    /// The divisor of the pixel `p`, which was traced for the pixel `traced` of the guides.
    pub(crate) fn albedo(&self, frame: &FrameConstants, traced: IVec2, p: IVec2, surface: &Surface) -> [f32; 4] {
        let roughness = self.roughness.map_or(1.0, |image| roughness_of(frame, image.at(traced)[roughness_channel(frame)]));
        specular_albedo_from(frame, self.image.at(traced), roughness, p, surface)
    }
}

/// The divisor of specular light by the reflectance at normal incidence; 1 where that is not finite.
fn specular_albedo_from(frame: &FrameConstants, f0: [f32; 4], roughness: f32, p: IVec2, surface: &Surface) -> [f32; 4] {
    let [r, g, b, _] = f0;
    if ![r, g, b].iter().all(|c| c.is_finite()) {
        return [1.0; 4];
    }
    let sight = (view_position(frame, p, 1.0) - view_position(frame, p, 0.0)).normalize();
    let towards_eye = Mat3::from_mat4(Mat4::from_cols_array_2d(&frame.world_from_view)) * -sight;
    let cosine = towards_eye.dot(surface.unit_normal()).clamp(0.0, 1.0);
    let (scale, bias) = scale_and_bias(roughness, cosine);
    let [r, g, b] = (Vec3::new(r, g, b) * scale + bias).max(Vec3::ZERO).to_array();
    [r, g, b, 0.0]
}

fn scale_and_bias(roughness: f32, cosine: f32) -> (f32, f32) {
    let fade = 1.0 - roughness;
    let bias_of_fade = 0.0425 - 0.0275 * roughness;
    let a = (fade * fade).min((-9.28 * cosine).exp2()) * fade + bias_of_fade;
    (-1.04 * a + 1.04 - 0.572 * roughness, 1.04 * a + 0.022 * roughness - 0.04)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mirror_seen_from_the_front_reflects_its_f0() {
        let (scale, bias) = scale_and_bias(0.0, 1.0);
        assert!((scale - 1.0).abs() < 0.01 && bias.abs() < 0.01, "{scale} {bias}");
    }

    #[test]
    fn what_is_seen_at_a_grazing_angle_reflects_more_and_what_is_rough_less() {
        let of = |roughness, cosine| {
            let (scale, bias) = scale_and_bias(roughness, cosine);
            0.04 * scale + bias
        };
        assert!(of(0.1, 0.05) > 5.0 * of(0.1, 1.0), "{} {}", of(0.1, 0.05), of(0.1, 1.0));
        assert!(of(0.9, 0.05) < 0.5 * of(0.1, 0.05), "{} {}", of(0.9, 0.05), of(0.1, 0.05));
    }
}
