//! Simple shapes. Texture coordinates are in scene units where the shape is flat.

use std::f32::consts::TAU;

use glam::{vec2, vec3, Vec3};

use super::mesh::Mesh;

/// A parallelogram from `corner`, facing along `u` x `v`.
pub fn quad(corner: Vec3, u: Vec3, v: Vec3) -> Mesh {
    let normal = u.cross(v).normalize();
    let (width, height) = (u.length(), v.length());
    Mesh {
        positions: vec![corner, corner + u, corner + u + v, corner + v],
        normals: vec![normal; 4],
        uvs: vec![vec2(0.0, 0.0), vec2(width, 0.0), vec2(width, height), vec2(0.0, height)],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
    }
}

/// A box with opposite corners `low` and `high`.
pub fn cuboid(low: Vec3, high: Vec3) -> Mesh {
    let size = high - low;
    let (x, y, z) = (Vec3::X * size.x, Vec3::Y * size.y, Vec3::Z * size.z);
    let mut mesh = Mesh::default();
    for side in [
        quad(low + z, x, y),
        quad(high - y - z, -x, y),
        quad(high - y, -z, y),
        quad(low, z, y),
        quad(low + y + z, x, -z),
        quad(low, x, z),
    ] {
        mesh.append(&side);
    }
    mesh
}

/// A sphere about the origin with smooth normals.
pub fn sphere(radius: f32, rings: u32, segments: u32) -> Mesh {
    let profile: Vec<_> = (0..=rings)
        .map(|ring| {
            let angle = std::f32::consts::PI * ring as f32 / rings as f32;
            let normal = vec2(angle.sin(), -angle.cos());
            (normal * radius, normal)
        })
        .collect();
    lathe(&profile, segments)
}

/// An upright closed cylinder that stands on the origin.
pub fn cylinder(radius: f32, height: f32, segments: u32) -> Mesh {
    let (side, up, down) = (vec2(1.0, 0.0), vec2(0.0, 1.0), vec2(0.0, -1.0));
    let mut mesh = lathe(&[(vec2(radius, 0.0), side), (vec2(radius, height), side)], segments);
    mesh.append(&lathe(&[(vec2(0.0, 0.0), down), (vec2(radius, 0.0), down)], segments));
    mesh.append(&lathe(&[(vec2(radius, height), up), (vec2(0.0, height), up)], segments));
    mesh
}

/// A profile of (radius, height) points with its normals, upwards, turned about the y axis.
pub fn lathe(profile: &[(glam::Vec2, glam::Vec2)], segments: u32) -> Mesh {
    let mut mesh = Mesh::default();
    let rows = profile.len() as u32;
    for segment in 0..=segments {
        let (sine, cosine) = (TAU * segment as f32 / segments as f32).sin_cos();
        for (row, (point, normal)) in profile.iter().enumerate() {
            mesh.positions.push(vec3(point.x * sine, point.y, point.x * cosine));
            mesh.normals.push(vec3(normal.x * sine, normal.y, normal.x * cosine).normalize());
            mesh.uvs.push(vec2(segment as f32 / segments as f32, row as f32 / (rows - 1).max(1) as f32));
        }
    }
    for segment in 0..segments {
        for row in 0..rows - 1 {
            let low = segment * rows + row;
            let next = low + rows;
            // A point on the axis makes one of the two triangles empty.
            if profile[row as usize].0.x > 1e-6 {
                mesh.triangles.push([low, next, next + 1]);
            }
            if profile[row as usize + 1].0.x > 1e-6 {
                mesh.triangles.push([low, next + 1, low + 1]);
            }
        }
    }
    mesh
}
