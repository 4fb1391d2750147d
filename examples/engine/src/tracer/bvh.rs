//! One BVH over the world-space triangles of all instances, as the shaders read it.

use glam::Affine3A;
use obvhs::bvh2::builder::build_bvh2_from_tris;
use obvhs::bvh2::Bvh2;
use obvhs::triangle::Triangle;
use obvhs::BvhBuildParams;

use crate::error::{Error, Result};
use crate::scene::{Glass, Material, Scene};

/// Nodes of two `vec4` and triangles of three, in the order of the leaves.
pub struct Bvh {
    /// Depth first. Lower corner, and the node after the subtree; upper corner, and in leaves the first triangle and the number of triangles.
    pub nodes: Vec<[f32; 8]>,
    /// First corner and instance, first edge and triangle of the instance's mesh, second edge and what it is beside a closed surface.
    pub triangles: Vec<[f32; 12]>,
    /// Length of the diagonal of everything, in scene units.
    pub diagonal: f32,
}

/// Triangles up to which a tree for one frame alone is the best one: that takes some 5 µs a triangle, for rays that are 11 to 15 % faster.
const MOVING_TRIANGLES: usize = 1 << 11;
/// Triangles up to which a tree that stays is the best one.
const STILL_TRIANGLES: usize = 1 << 17;

/// Builds the tree; `moving`: for one frame alone.
pub fn build(scene: &Scene, transforms: &[Affine3A], moving: bool) -> Result<Bvh> {
    let mut triangles = Vec::new();
    let mut names = Vec::new();
    for (index, (instance, transform)) in scene.instances.iter().zip(transforms).enumerate() {
        let mesh = &scene.meshes[instance.mesh];
        let world: Vec<_> = mesh.positions.iter().map(|p| transform.transform_point3a((*p).into())).collect();
        for (number, [a, b, c]) in mesh.triangles.iter().enumerate() {
            triangles.push(Triangle { v0: world[*a as usize], v1: world[*b as usize], v2: world[*c as usize] });
            names.push(Name { instance: index as u32, number: number as u32, mask: mask(&scene.materials[instance.material]) });
        }
    }
    if triangles.is_empty() {
        return Err(Error::EmptyScene);
    }
    let params = match moving {
        true if triangles.len() > MOVING_TRIANGLES => BvhBuildParams::fast_build(),
        false if triangles.len() > STILL_TRIANGLES => BvhBuildParams::medium_build(),
        _ => BvhBuildParams::very_slow_build(),
    };
    // Small leaves: a triangle costs the shaders about as much as a pair of boxes.
    let params = BvhBuildParams { max_prims_per_leaf: 4, collapse_traversal_cost: 1.0, ..params };
    let tree = build_bvh2_from_tris(&triangles, params, &mut Default::default());
    let nodes = depth_first(&tree);
    let ordered = tree.primitive_indices.iter().map(|&index| packed(&triangles[index as usize], names[index as usize])).collect();
    let diagonal = tree.nodes.first().map_or(0.0, |root| (root.max - root.min).length());
    Ok(Bvh { nodes, triangles: ordered, diagonal })
}

const COUNT_SHIFT: u32 = 25;
/// After the last node.
const END: u32 = u32::MAX;

enum Step {
    Enter(u32),
    /// The subtree of the node in this slot is written.
    Leave(usize),
}

fn depth_first(tree: &Bvh2) -> Vec<[f32; 8]> {
    let mut nodes = Vec::with_capacity(tree.nodes.len());
    let mut steps = vec![Step::Enter(0)];
    while let Some(step) = steps.pop() {
        match step {
            Step::Enter(index) => {
                let node = &tree.nodes[index as usize];
                let leaf = if node.is_leaf() { node.first_index | node.prim_count << COUNT_SHIFT } else { 0 };
                steps.push(Step::Leave(nodes.len()));
                nodes.push([node.min.x, node.min.y, node.min.z, 0.0, node.max.x, node.max.y, node.max.z, f32::from_bits(leaf)]);
                if !node.is_leaf() {
                    steps.extend([Step::Enter(node.first_index + 1), Step::Enter(node.first_index)]);
                }
            }
            Step::Leave(slot) => {
                let is_last = nodes.len() == tree.nodes.len();
                nodes[slot][3] = f32::from_bits(if is_last { END } else { nodes.len() as u32 });
            }
        }
    }
    nodes
}

/// As the shaders' `MASK_*`.
fn mask(material: &Material) -> u32 {
    match material.glass {
        Some(Glass::Pane) => 2,
        Some(Glass::Body) => 3,
        None => material.leaves.into(),
    }
}

/// What a triangle is called, and what it is.
#[derive(Clone, Copy)]
struct Name {
    instance: u32,
    number: u32,
    mask: u32,
}

fn packed(triangle: &Triangle, name: Name) -> [f32; 12] {
    let (a, u, v) = (triangle.v0, triangle.v1 - triangle.v0, triangle.v2 - triangle.v0);
    let [instance, number, mask] = [name.instance, name.number, name.mask].map(f32::from_bits);
    [a.x, a.y, a.z, instance, u.x, u.y, u.z, number, v.x, v.y, v.z, mask]
}
