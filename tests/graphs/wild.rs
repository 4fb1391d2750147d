//! Inputs as no host should give them, and some do: values that are not finite or far out of range, data in components that nothing
//! reads, neighbourhoods of sky or of bright and even light alone, points of a volume on the surfaces.

use super::inputs::Inputs;
use crate::support::scene::hash;

/// One texel in so many has a wild value.
const ONE_IN: u32 = 40;
/// Pixels a side of a neighbourhood that may be sky, or of bright and even light.
const SIDE: u32 = 8;
/// Light of which the square leaves no room in a float for the square of its differences.
const BRIGHT: f32 = 64.0;
const EVEN: f32 = 0.0625;

/// No denormals, which a device may take for 0.
const VALUES: [f32; 14] =
    [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e20, -1e20, f32::MAX, f32::MIN, 65504.0, 65536.0, -0.0, 0.0, -1.0, 1e-6, 300.0];

impl Inputs {
    /// Makes them wild in a frame of `width` pixels a row.
    pub fn make_wild(&mut self, seed: u32, index: u32, width: u32) {
        let depth = self.image("depth").cloned();
        for (k, (name, texels)) in (0..).zip(&mut self.images) {
            let used = components(name, is_octahedral(seed));
            for (i, texel) in (0..).zip(texels.iter_mut().flatten()) {
                let dice = |number| hash(seed + 1000 * index, i, 100 * k + number);
                let is_wild = dice(0).is_multiple_of(ONE_IN);
                if name.starts_with("noisy_") && is_one_of_four(seed + 1, i, width) {
                    *texel = [BRIGHT + EVEN * (dice(8) % 3) as f32; 4];
                }
                for (c, value) in (0..).zip(texel.iter_mut()) {
                    if c >= used || (is_wild && dice(1) % used == c) {
                        *value = VALUES[dice(2 + c) as usize % VALUES.len()];
                    }
                }
                match name.as_str() {
                    "depth" if is_one_of_four(seed, i, width) => texel[0] = if i % 2 == 0 { 0.0 } else { f32::INFINITY },
                    "scattering_depth" if dice(9) % 2 == 0 => texel[0] = depth.as_ref().map_or(1.0, |depth| depth[i as usize][0]),
                    _ => {}
                }
            }
        }
        for (i, id) in (0..).zip(self.surface_id.iter_mut().flatten()) {
            if hash(seed, i, 300 + index).is_multiple_of(ONE_IN) {
                *id = [0, 255, 256, u32::MAX][i as usize % 4];
            }
        }
        for (k, row) in (0..).zip(self.transforms.iter_mut().flatten().flatten()) {
            if hash(seed, k, 400 + index).is_multiple_of(9) {
                row[k as usize % 4] = VALUES[hash(seed, k, 401 + index) as usize % VALUES.len()];
            }
        }
    }

    fn image(&self, name: &str) -> Option<&Vec<[f32; 4]>> {
        self.images.iter().find(|image| image.0 == name)?.1.as_ref()
    }
}

/// Whole neighbourhoods, so that a pixel has nothing else around it.
fn is_one_of_four(seed: u32, i: u32, width: u32) -> bool {
    hash(seed, i % width / SIDE, i / width / SIDE).is_multiple_of(4)
}

/// Whether normals of a seed are octahedral, so that their z is not read.
pub fn is_octahedral(seed: u32) -> bool {
    seed % 2 == 1
}

/// Components of an input that are read.
fn components(name: &str, is_octahedral: bool) -> u32 {
    match name {
        "normal" if is_octahedral => 2,
        "depth"
        | "roughness"
        | "scattering_depth"
        | "specular_hit_distance"
        | "noisy_ambient"
        | "ambient_distance"
        | "occluder_distance"
        | "occluder_distance_1"
        | "occluder_distance_2"
        | "occluder_distance_3"
        | "confidence" => 1,
        "motion" | "sparse_gradient" => 2,
        _ => 3,
    }
}
