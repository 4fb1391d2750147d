//! A short sequence of noisy frames with guides: a slanted card before a checkered wall, a sky above, seen by a camera that slides.
//!
//! Every host that is compared denoises these frames. Only operations that IEEE 754 rounds exactly are used, in a fixed order, so
//! that `examples/host_cpp/synthetic.hpp`, which says the same in C++, gives the same bits. [`scene`] has a larger choice for tests
//! alone, [`moving`] frames of any size for benchmarks.

#![forbid(unsafe_code)]

pub mod moving;
pub mod scene;

/// Width and height in pixels: not a multiple of a workgroup.
pub const EXTENT: [u32; 2] = [76, 44];
/// Frames of the sequence.
pub const FRAMES: u32 = 4;

const FOCAL: f32 = 1.25;
const WALL: f32 = 6.0;
const SPEED: f32 = 0.0625;
const ASPECT: f32 = EXTENT[0] as f32 / EXTENT[1] as f32;

/// The names of the inputs, in the order of [`Frame::images`]. All hold four floats a texel.
pub const NAMES: [&str; 5] = ["depth", "normal", "motion", "albedo", "noisy_radiance"];

/// The inputs of one frame, row by row.
pub struct Frame {
    /// Images in the order of [`NAMES`].
    pub images: [Vec<[f32; 4]>; 5],
    /// `surface_id`.
    pub surface_id: Vec<u32>,
}

impl Frame {
    /// The inputs of frame `index`.
    pub fn new(index: u32) -> Self {
        let count = (EXTENT[0] * EXTENT[1]) as usize;
        let mut frame = Self { images: std::array::from_fn(|_| Vec::with_capacity(count)), surface_id: Vec::new() };
        for y in 0..EXTENT[1] {
            for x in 0..EXTENT[0] {
                let (texels, id) = texel(index, x, y);
                for (image, texel) in frame.images.iter_mut().zip(texels) {
                    image.push(texel);
                }
                frame.surface_id.push(id);
            }
        }
        frame
    }
}

fn texel(index: u32, x: u32, y: u32) -> ([[f32; 4]; 5], u32) {
    let camera = SPEED * index as f32;
    let dx = ((x as f32 + 0.5) / EXTENT[0] as f32 * 2.0 - 1.0) * ASPECT / FOCAL;
    let dy = (1.0 - (y as f32 + 0.5) / EXTENT[1] as f32 * 2.0) / FOCAL;
    let card = (3.2 + 0.6 * camera) / (0.8 - 0.6 * dx);
    let (card_x, card_y) = (camera + dx * card, dy * card);
    let (wall_x, wall_y) = (camera + dx * WALL, dy * WALL);
    let is_card = card > 0.0 && card < WALL && card_x > -0.9 && card_x < 0.7 && card_y > -0.8 && card_y < 0.6;
    let odd = ((wall_x.floor() as i32 + wall_y.floor() as i32) & 1) as f32;
    let (depth, normal, albedo, light, id) = if is_card {
        (card, [0.6, 0.0, 0.8, 0.0], [0.8, 0.3, 0.2, 1.0], 0.5 + 0.25 * card_y, 2)
    } else if wall_y > 2.0 {
        (0.0, [0.0; 4], [1.0; 4], 0.4, 0)
    } else {
        (WALL, [0.0, 0.0, 1.0, 0.0], [0.2 + 0.6 * odd, 0.5, 0.7 - 0.4 * odd, 1.0], 0.75 + 0.125 * wall_x, 1)
    };
    let motion = if id == 0 { 0.0 } else { SPEED * FOCAL / (ASPECT * depth) * 0.5 };
    let noise = if id == 0 { 1.0 } else { 2.0 * random(x, y, index) };
    let radiance = [albedo[0] * light * noise, albedo[1] * light * noise, albedo[2] * light * noise, 1.0];
    ([[depth, 0.0, 0.0, 0.0], normal, [motion, 0.0, 0.0, 0.0], albedo, radiance], id)
}

/// Uniform in 0..1.
fn random(x: u32, y: u32, index: u32) -> f32 {
    let mut h = x.wrapping_mul(0x9e37_79b9) ^ y.wrapping_mul(0x85eb_ca6b) ^ index.wrapping_mul(0xc2b2_ae35);
    for _ in 0..2 {
        h = (h ^ h >> 16).wrapping_mul(0x7feb_352d);
        h = (h ^ h >> 15).wrapping_mul(0x846c_a68b);
    }
    (h >> 8) as f32 / 16_777_216.0
}

/// World to view of frame `index`, column-major; the camera looks along −z.
pub fn view_from_world(index: u32) -> [[f32; 4]; 4] {
    [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [-SPEED * index as f32, 0.0, 0.0, 1.0]]
}

/// View to Vulkan clip space, column-major.
pub fn clip_from_view() -> [[f32; 4]; 4] {
    [[FOCAL / ASPECT, 0.0, 0.0, 0.0], [0.0, -FOCAL, 0.0, 0.0], [0.0, 0.0, -1.0, -1.0], [0.0, 0.0, -0.125, 0.0]]
}

/// Bytes of texels, as they are uploaded.
pub fn bytes(texels: &[[f32; 4]]) -> Vec<u8> {
    texels.iter().flatten().flat_map(|v| v.to_le_bytes()).collect()
}

/// FNV-1a: two images with equal checksums are taken to be equal bit for bit.
pub fn checksum(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, &byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

/// The line that a host prints per frame, from which the tests compare.
pub fn report(frame: u32, output: &[u8]) -> String {
    format!("frame {frame} checksum {:016x}", checksum(output))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_has_card_wall_and_sky() {
        for index in 0..FRAMES {
            let frame = Frame::new(index);
            for id in 0..3 {
                assert!(frame.surface_id.iter().filter(|&&i| i == id).count() > 100, "surface {id}, frame {index}");
            }
            assert!(frame.images.iter().flatten().flatten().all(|v| v.is_finite()));
        }
        assert_ne!(Frame::new(0).images[4], Frame::new(1).images[4]);
    }
}
