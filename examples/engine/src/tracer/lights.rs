//! Materials and the list of lights at one time: each light is chosen with a probability in proportion to its power.
//!
//! It is the power that the light has in the scene's description, not that of the moment: a lamp that flickers would change which light
//! every random number chooses, and a sample that is shaded again would change where its light did not.

use std::f32::consts::PI;

use glam::{Affine3A, Vec3};

use super::layout::{with, LightData, MaterialData, CHECKER_TEXTURE, NO_TEXTURE};
use crate::scene::{Lamp, Material, Moment, Pattern, Scene};

const KIND_TRIANGLE: u32 = 0;
const KIND_SUN: u32 = 1;
const KIND_POINT: u32 = 2;

/// The lights, and the sum of their weights.
pub struct Lights {
    pub data: Vec<LightData>,
    pub total_weight: f32,
    /// Index of the first lamp: all behind it are lamps in the order of the scene.
    pub first_lamp: u32,
}

/// The materials, with what they emit at a frame.
pub fn materials(scene: &Scene, frame: u32) -> Vec<MaterialData> {
    scene.materials.iter().zip(scene.emissions(frame)).map(|(material, emission)| material_data(material, emission)).collect()
}

fn material_data(material: &Material, emission: Vec3) -> MaterialData {
    let side = if material.two_sided_emission { -1.0 } else { 1.0 };
    let (texture, other, squares) = match material.pattern {
        Pattern::Plain => (NO_TEXTURE, Vec3::ZERO, 0.0),
        Pattern::Checker { other, scale } => (CHECKER_TEXTURE, other, scale),
        Pattern::Texture(index) => (index as u32, Vec3::ZERO, 0.0),
    };
    MaterialData {
        base_color_roughness: with(material.base_color, material.roughness),
        checker_color_scale: with(other, squares),
        emission_weight: with(emission, side * luminance(material.emission) * PI),
        metallic: material.metallic,
        specular: material.specular,
        base_color_texture: texture,
        emission_texture: material.emission_texture.map_or(NO_TEXTURE, |index| index as u32),
    }
}

/// All lights at a moment. `first_triangles` says where each mesh begins among the attributes; `diagonal` gives a sun its power.
pub fn lights(scene: &Scene, transforms: &[Affine3A], first_triangles: &[u32], now: &Moment, diagonal: f32) -> Lights {
    let (materials, scale) = (materials(scene, now.light_frame), scene.light_scale(now.light_frame));
    let mut data = Vec::new();
    let mut weights = Vec::new();
    for ((instance, transform), id) in scene.instances.iter().zip(transforms).zip(1u32..) {
        let material = &materials[instance.material];
        let weight = material.emission_weight[3].abs();
        if weight <= 0.0 {
            continue;
        }
        let mesh = &scene.meshes[instance.mesh];
        // A mirrored instance turns its winding round; the shader's normals do the same.
        let mirrored = transform.matrix3.determinant() < 0.0;
        for (number, triangle) in mesh.triangles.iter().enumerate() {
            let [a, b, c] = mesh.corners(*triangle).map(|corner| transform.transform_point3(corner));
            let area = 0.5 * (b - a).cross(c - a).length();
            if area <= 0.0 {
                continue;
            }
            let tag = KIND_TRIANGLE | (first_triangles[instance.mesh] + number as u32) << 2;
            weights.push(area * weight);
            data.push(LightData {
                position_kind: with(a, f32::from_bits(tag)),
                edge1_cdf: with(b - a, 0.0),
                edge2_probability: with(c - a, 0.0),
                radiance_material: [
                    if mirrored { -1.0 } else { 1.0 },
                    f32::from_bits(id),
                    0.0,
                    f32::from_bits(instance.material as u32),
                ],
            });
        }
    }
    let first_lamp = data.len() as u32;
    for lamp in scene.lamps_at(now.object_time) {
        let (light, weight) = lamp_data(&lamp, scale, diagonal);
        data.push(light);
        // One without light is still one of them.
        weights.push(weight.max(1.0e-20));
    }
    let total_weight = fill_distribution(&mut data, &weights);
    Lights { data, total_weight, first_lamp }
}

fn lamp_data(lamp: &Lamp, scale: f32, diagonal: f32) -> (LightData, f32) {
    match *lamp {
        Lamp::Sun { direction, irradiance, radius } => {
            let light = LightData {
                position_kind: with(direction, f32::from_bits(KIND_SUN)),
                edge2_probability: [radius, 0.0, 0.0, 0.0],
                radiance_material: with(irradiance * scale, 0.0),
                ..Default::default()
            };
            (light, luminance(irradiance) * 0.25 * PI * diagonal * diagonal)
        }
        Lamp::Point { position, radius, intensity, spot } => {
            let (direction, inner, outer) = spot.unwrap_or((Vec3::NEG_Y, 1.0, -1.0));
            let light = LightData {
                position_kind: with(position, f32::from_bits(KIND_POINT)),
                edge1_cdf: with(direction, 0.0),
                edge2_probability: [inner, outer, radius, 0.0],
                radiance_material: with(intensity * scale, 0.0),
            };
            (light, luminance(intensity) * 4.0 * PI)
        }
    }
}

/// Writes probabilities and cumulated probabilities; gives the sum of the weights.
fn fill_distribution(data: &mut [LightData], weights: &[f32]) -> f32 {
    let total: f64 = weights.iter().map(|weight| f64::from(*weight)).sum();
    let mut sum = 0.0;
    let last = data.len().saturating_sub(1);
    for (index, (light, weight)) in data.iter_mut().zip(weights).enumerate() {
        sum += f64::from(*weight) / total;
        // The last bound is 1 whatever the rounding, so that every number finds a light.
        light.edge1_cdf[3] = if index == last { 1.0 } else { sum as f32 };
        light.edge2_probability[3] = (f64::from(*weight) / total) as f32;
    }
    total as f32
}

fn luminance(radiance: Vec3) -> f32 {
    radiance.dot(glam::vec3(0.2126, 0.7152, 0.0722))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lamp_that_flickers_changes_no_choice_of_a_light() {
        let scene = Scene::load("lamps", &Default::default()).expect("a scene");
        let (transforms, triangles) = (scene.transforms(0.0), vec![0; scene.meshes.len()]);
        let at = |frame| lights(&scene, &transforms, &triangles, &scene.moment(frame), 10.0);
        let (bright, dim) = (at(0), at(6));
        assert_ne!(
            materials(&scene, 0).iter().map(|m| m.emission_weight[0]).sum::<f32>(),
            materials(&scene, 6).iter().map(|m| m.emission_weight[0]).sum::<f32>()
        );
        let choices = |lights: &Lights| lights.data.iter().map(|l| [l.edge1_cdf[3], l.edge2_probability[3]]).collect::<Vec<_>>();
        assert_eq!((choices(&bright), bright.total_weight), (choices(&dim), dim.total_weight));
    }
}
