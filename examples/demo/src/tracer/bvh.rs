//! One BVH over the world-space triangles of all instances, as the shaders read it.

use glam::Affine3A;
use obvhs::bvh2::builder::build_bvh2_from_tris;
use obvhs::triangle::Triangle;
use obvhs::BvhBuildParams;

use super::layout::BVH_DEPTH_LIMIT;
use crate::error::{Error, Result};
use crate::scene::Scene;

/// Nodes of two `vec4` and triangles of three, in the order of the leaves.
pub struct Bvh {
    /// Lower corner and count, upper corner and first child or triangle.
    pub nodes: Vec<[f32; 8]>,
    /// First corner and instance, first edge and triangle of the instance's mesh, second edge.
    pub triangles: Vec<[f32; 12]>,
    /// Length of the diagonal of everything, in scene units.
    pub diagonal: f32,
}

/// Builds the tree; `moving` chooses a fast build over a good one.
pub fn build(scene: &Scene, transforms: &[Affine3A], moving: bool) -> Result<Bvh> {
    let mut triangles = Vec::new();
    let mut names = Vec::new();
    for (index, (instance, transform)) in scene.instances.iter().zip(transforms).enumerate() {
        let mesh = &scene.meshes[instance.mesh];
        let world: Vec<_> = mesh.positions.iter().map(|p| transform.transform_point3a((*p).into())).collect();
        for (number, [a, b, c]) in mesh.triangles.iter().enumerate() {
            triangles.push(Triangle { v0: world[*a as usize], v1: world[*b as usize], v2: world[*c as usize] });
            names.push((index as u32, number as u32));
        }
    }
    if triangles.is_empty() {
        return Err(Error::EmptyScene);
    }
    let params = if moving { BvhBuildParams::fast_build() } else { BvhBuildParams::medium_build() };
    // Small leaves: a triangle costs the shaders about as much as a pair of boxes.
    let params = BvhBuildParams { max_prims_per_leaf: 4, collapse_traversal_cost: 1.0, ..params };
    let tree = build_bvh2_from_tris(&triangles, params, &mut Default::default());
    let depth = tree.depth(0);
    if depth > BVH_DEPTH_LIMIT {
        return Err(Error::SceneLimit { what: "levels in its BVH", given: depth, limit: BVH_DEPTH_LIMIT });
    }
    let nodes = tree
        .nodes
        .iter()
        .map(|n| {
            let (count, first) = (f32::from_bits(n.prim_count), f32::from_bits(n.first_index));
            [n.min.x, n.min.y, n.min.z, count, n.max.x, n.max.y, n.max.z, first]
        })
        .collect();
    let ordered = tree.primitive_indices.iter().map(|&index| packed(&triangles[index as usize], names[index as usize])).collect();
    let diagonal = tree.nodes.first().map_or(0.0, |root| (root.max - root.min).length());
    Ok(Bvh { nodes, triangles: ordered, diagonal })
}

fn packed(triangle: &Triangle, (instance, number): (u32, u32)) -> [f32; 12] {
    let (a, u, v) = (triangle.v0, triangle.v1 - triangle.v0, triangle.v2 - triangle.v0);
    [a.x, a.y, a.z, f32::from_bits(instance), u.x, u.y, u.z, f32::from_bits(number), v.x, v.y, v.z, 0.0]
}
