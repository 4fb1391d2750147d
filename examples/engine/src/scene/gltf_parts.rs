//! The parts of a glTF file, each turned into ours.

use glam::{Mat4, Vec2, Vec3};
use gltf::image::Format;
use gltf::khr_lights_punctual::Kind;
use gltf::mesh::Mode;

use super::gltf_file::Problem;
use super::{Lamp, Material, Mesh, Pattern, Texture, View};

type Parsed<T> = Result<T, Problem>;

/// A picture as 8-bit sRGB.
pub fn image(data: &gltf::image::Data) -> Parsed<Texture> {
    let channels = match data.format {
        Format::R8 => 1,
        Format::R8G8 => 2,
        Format::R8G8B8 => 3,
        Format::R8G8B8A8 => 4,
        other => {
            let problem = format!("a picture has the format {other:?}, where 8 bits for each channel are allowed");
            return Err((problem, "Save its pictures with 8 bits for each channel"));
        }
    };
    let texel = |bytes: &[u8]| {
        let [r, g, b] = if channels < 3 { [bytes[0]; 3] } else { [bytes[0], bytes[1], bytes[2]] };
        u32::from_le_bytes([r, g, b, 255])
    };
    let texels: Vec<u32> = data.pixels.chunks_exact(channels).map(texel).collect();
    if texels.is_empty() || texels.len() != data.width as usize * data.height as usize {
        return Err(("a picture is empty or cut short".to_string(), "Export the file again"));
    }
    Ok(Texture { width: data.width, height: data.height, texels })
}

/// Metallic-roughness with a dielectric coat of 0.04.
pub fn material(source: &gltf::Material<'_>) -> Parsed<Material> {
    let pbr = source.pbr_metallic_roughness();
    let [r, g, b, _] = pbr.base_color_factor();
    let strength = source.emissive_strength().unwrap_or(1.0);
    let emission = Vec3::from(source.emissive_factor()) * strength;
    let numbers = [r, g, b, pbr.roughness_factor(), pbr.metallic_factor(), emission.x, emission.y, emission.z];
    if numbers.iter().any(|number| !number.is_finite() || *number < 0.0) {
        let index = source.index().unwrap_or_default();
        return Err((format!("material {index} has a factor that is negative or not finite"), "Correct the material's factors"));
    }
    let pattern = pbr.base_color_texture().map_or(Pattern::Plain, |info| Pattern::Texture(info.texture().source().index()));
    Ok(Material {
        base_color: Vec3::new(r, g, b).min(Vec3::ONE),
        pattern,
        roughness: pbr.roughness_factor().min(1.0),
        metallic: pbr.metallic_factor().min(1.0),
        specular: 0.04,
        emission,
        emission_texture: source.emissive_texture().map(|info| info.texture().source().index()),
        two_sided_emission: source.double_sided(),
        leaves: false,
        glass: None,
    })
}

/// The triangles of a primitive; none for points and lines.
pub fn mesh(label: &str, primitive: &gltf::Primitive<'_>, buffers: &[gltf::buffer::Data]) -> Parsed<Option<Mesh>> {
    let reader = primitive.reader(|buffer| buffers.get(buffer.index()).map(|data| &data.0[..]));
    let positions: Vec<Vec3> = reader.read_positions().into_iter().flatten().map(Vec3::from).collect();
    if positions.iter().any(|position| !position.is_finite()) {
        return Err((format!("{label}: a position is not finite"), "Export the file again"));
    }
    let indices: Vec<u32> = match reader.read_indices() {
        Some(indices) => indices.into_u32().collect(),
        None => (0..positions.len() as u32).collect(),
    };
    if let Some(bad) = indices.iter().find(|index| **index as usize >= positions.len()) {
        let problem = format!("{label}: index {bad} is out of range, where indices below {} are allowed", positions.len());
        return Err((problem, "The file is damaged: export or download it again"));
    }
    let triangles = match primitive.mode() {
        Mode::Triangles => indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect(),
        Mode::TriangleStrip => {
            indices.windows(3).enumerate().map(|(i, t)| if i % 2 == 0 { [t[0], t[1], t[2]] } else { [t[1], t[0], t[2]] }).collect()
        }
        Mode::TriangleFan => indices.get(1..).unwrap_or_default().windows(2).map(|t| [indices[0], t[0], t[1]]).collect(),
        _ => return Ok(None),
    };
    let count = positions.len();
    let uvs: Vec<Vec2> = match reader.read_tex_coords(0) {
        Some(uvs) => uvs.into_f32().map(|uv| finite_or_zero(Vec2::from(uv))).collect(),
        None => vec![Vec2::ZERO; count],
    };
    let mesh = Mesh { positions, normals: Vec::new(), uvs, triangles };
    Ok(Some(match reader.read_normals() {
        Some(normals) => {
            let normals = normals.map(|normal| Vec3::from(normal).try_normalize().unwrap_or(Vec3::Y)).collect();
            Mesh { normals, ..mesh }
        }
        None => flat(&mesh),
    }))
}

fn finite_or_zero(uv: Vec2) -> Vec2 {
    if uv.is_finite() {
        uv
    } else {
        Vec2::ZERO
    }
}

/// Every triangle with corners of its own and its face's normal, as glTF wants where there are no normals.
fn flat(mesh: &Mesh) -> Mesh {
    let mut result = Mesh::default();
    for triangle in &mesh.triangles {
        let base = result.positions.len() as u32;
        result.positions.extend(mesh.corners(*triangle));
        result.uvs.extend(triangle.map(|corner| mesh.uvs[corner as usize]));
        result.triangles.push([base, base + 1, base + 2]);
    }
    result.compute_normals();
    result
}

/// A punctual light; it shines along its node's -Z. Lux and candela are taken for irradiance and intensity.
pub fn lamp(light: &gltf::khr_lights_punctual::Light<'_>, world: Mat4) -> Lamp {
    let strength = Vec3::from(light.color()) * light.intensity();
    let direction = world.transform_vector3(Vec3::NEG_Z).normalize_or(Vec3::NEG_Y);
    let position = world.transform_point3(Vec3::ZERO);
    match light.kind() {
        Kind::Directional => Lamp::Sun { direction: -direction, irradiance: strength, radius: 0.005 },
        Kind::Point => Lamp::Point { position, radius: 0.0, intensity: strength, spot: None },
        Kind::Spot { inner_cone_angle, outer_cone_angle } => Lamp::Point {
            position,
            radius: 0.0,
            intensity: strength,
            spot: Some((direction, inner_cone_angle.cos(), outer_cone_angle.cos())),
        },
    }
}

/// A perspective camera; none for an orthographic one, or one that cannot be used.
pub fn view(camera: &gltf::Camera<'_>, world: Mat4) -> Option<View> {
    let gltf::camera::Projection::Perspective(perspective) = camera.projection() else {
        return None;
    };
    let vertical_fov = perspective.yfov();
    let eye = world.transform_point3(Vec3::ZERO);
    let forward = world.transform_vector3(Vec3::NEG_Z).try_normalize()?;
    let up = world.transform_vector3(Vec3::Y).try_normalize()?;
    (0.01..3.1).contains(&vertical_fov).then_some(View { eye, target: eye + forward, up, vertical_fov })
}
