//! A ball under a lamp, one shadow ray a pixel, denoised: what a path tracer hands over, and what it gets back.

use atrous::executor::{HeadlessDevice, HeadlessOptions, Session, SessionOptions};
use atrous::{Config, FrameParams, Tuning};

const SIZE: [u32; 2] = [480, 270];
const ASPECT: f32 = SIZE[0] as f32 / SIZE[1] as f32;
/// 1 / tan(half of the vertical field of view).
const FOCAL: f32 = 1.6;
const BALL: Vec3 = [0.0, 0.7, -4.0];
const RADIUS: f32 = 0.7;

type Vec3 = [f32; 3];

fn add(a: Vec3, b: Vec3, scale: f32) -> Vec3 {
    [0, 1, 2].map(|i| a[i] + scale * b[i])
}

fn dot(a: Vec3, b: Vec3) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// How far along a ray the ball is, in lengths of `way`.
fn ball(from: Vec3, way: Vec3) -> Option<f32> {
    let to = add(from, BALL, -1.0);
    let (a, b) = (dot(way, way), dot(to, way));
    let root = b * b - a * (dot(to, to) - RADIUS * RADIUS);
    Some((-b - root.max(0.0).sqrt()) / a).filter(|t| root > 0.0 && *t > 1e-3)
}

/// Depth, normal, albedo and id of what a ray meets: the ball, the floor, or nothing.
fn trace(eye: Vec3, way: Vec3) -> Option<(f32, Vec3, Vec3, u32)> {
    if let Some(t) = ball(eye, way) {
        return Some((t, add(add(eye, way, t), BALL, -1.0).map(|c| c / RADIUS), [0.9, 0.4, 0.2], 2));
    }
    let t = -eye[1] / way[1];
    let tile = |i: usize| (eye[i] + t * way[i]).floor() as i32;
    let albedo = if (tile(0) + tile(2)) % 2 == 0 { [0.7; 3] } else { [0.3, 0.4, 0.5] };
    (way[1] < 0.0 && t < 40.0).then_some((t, [0.0, 1.0, 0.0], albedo, 1))
}

/// Light of a square lamp, by a ray to one point of it.
fn light(at: Vec3, normal: Vec3, random: &mut impl FnMut() -> f32) -> f32 {
    let lamp = [1.5 + 1.6 * (random() - 0.5), 3.0, -2.5 + 1.6 * (random() - 0.5)];
    let way = add(lamp, at, -1.0);
    let lit = ball(add(at, normal, 1e-2), way).is_none_or(|t| t > 1.0);
    let squared = dot(way, way);
    if lit {
        14.0 * (dot(normal, way) * way[1]).max(0.0) / (squared * squared)
    } else {
        0.0
    }
}

fn write(path: &str, texels: &[[f32; 4]]) -> std::io::Result<()> {
    let byte = |c: f32| (255.0 * (c / (1.0 + c)).powf(1.0 / 2.2)) as u8;
    let pixels = texels.iter().flat_map(|t| [t[0], t[1], t[2]]).map(byte);
    std::fs::write(path, format!("P6 {} {} 255\n", SIZE[0], SIZE[1]).into_bytes().into_iter().chain(pixels).collect::<Vec<_>>())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let gpu = HeadlessDevice::new(&HeadlessOptions::default())?;
    println!("{}", gpu.name());
    let config = Config::new(SIZE);
    let tuning = Tuning::for_preset(config.preset);
    let mut session = Session::new(gpu.into(), config.declare()?, SessionOptions::default())?;
    let mut seed = 1_u32;
    let mut random = || {
        seed = seed.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        (seed >> 8) as f32 / 16_777_216.0
    };
    for frame in 0..16 {
        let eye = [0.03 * frame as f32, 1.3, 0.0];
        // By columns. The camera looks along −z; y of clip space points down, depth goes from 0 to 1.
        let camera = FrameParams {
            view_from_world: [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [-eye[0], -eye[1], -eye[2], 1.0]],
            clip_from_view: [
                [FOCAL / ASPECT, 0.0, 0.0, 0.0],
                [0.0, -FOCAL, 0.0, 0.0],
                [0.0, 0.0, -1.0, -1.0],
                [0.0, 0.0, -0.1, 0.0],
            ],
            ..FrameParams::new(SIZE)
        };
        let (mut depth, mut normal, mut albedo, mut ids, mut noisy) = (vec![], vec![], vec![], vec![], vec![]);
        for (y, x) in (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (y, x))) {
            let ndc = [(x, SIZE[0]), (y, SIZE[1])].map(|(p, side)| 2.0 * (p as f32 + 0.5) / side as f32 - 1.0);
            // −1 along z, so that lengths along the ray are linear depths.
            let way = [ndc[0] * ASPECT / FOCAL, -ndc[1] / FOCAL, -1.0];
            let (z, n, a, id) = trace(eye, way).unwrap_or((0.0, [0.0; 3], [1.0; 3], 0));
            let l = if id == 0 { 0.3 } else { light(add(eye, way, z), n, &mut random) };
            depth.push([z, 0.0, 0.0, 0.0]);
            normal.push([n[0], n[1], n[2], 0.0]);
            albedo.push([a[0], a[1], a[2], 1.0]);
            ids.push(id);
            noisy.push([a[0] * l, a[1] * l, a[2] * l, 1.0]);
        }
        session.upload("depth", &depth)?;
        session.upload("normal", &normal)?;
        session.upload("albedo", &albedo)?;
        session.upload_ids("surface_id", &ids)?;
        session.upload("noisy_radiance", &noisy)?;
        session.run(&camera, &tuning)?;
        write("noisy.ppm", &noisy)?;
    }
    write("denoised.ppm", &session.download("denoised_radiance")?)?;
    Ok(())
}
