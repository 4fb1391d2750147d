//! Triangles in object space.

use glam::{Vec2, Vec3};

/// An indexed triangle mesh. Counter-clockwise triangles face the viewer.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// Corners.
    pub positions: Vec<Vec3>,
    /// Shading normals, as many as corners.
    pub normals: Vec<Vec3>,
    /// Texture coordinates, as many as corners.
    pub uvs: Vec<Vec2>,
    /// Three corners for each triangle.
    pub triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// Adds all of `other`.
    pub fn append(&mut self, other: &Mesh) {
        let base = self.positions.len() as u32;
        self.positions.extend(&other.positions);
        self.normals.extend(&other.normals);
        self.uvs.extend(&other.uvs);
        self.triangles.extend(other.triangles.iter().map(|triangle| triangle.map(|corner| base + corner)));
    }

    /// Moves every corner.
    pub fn translated(mut self, offset: Vec3) -> Self {
        self.positions.iter_mut().for_each(|position| *position += offset);
        self
    }

    /// The corners of one triangle.
    pub fn corners(&self, triangle: [u32; 3]) -> [Vec3; 3] {
        triangle.map(|corner| self.positions[corner as usize])
    }

    /// Normals from the faces, each corner the mean of its triangles weighted by area.
    pub fn compute_normals(&mut self) {
        self.normals = vec![Vec3::ZERO; self.positions.len()];
        for &triangle in &self.triangles {
            let [a, b, c] = self.corners(triangle);
            let face = (b - a).cross(c - a);
            triangle.iter().for_each(|&corner| self.normals[corner as usize] += face);
        }
        self.normals.iter_mut().for_each(|normal| *normal = normal.normalize_or(Vec3::Y));
    }
}
