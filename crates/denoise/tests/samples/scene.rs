//! A small scene with exact guides: a chequered floor, a wall and a ball that moves, before a sky; a
//! camera that goes round. Its light has the noise of a path or two a pixel.

use super::{bounds, noise, Sample, Type};
use glam::{Mat4, Vec2, Vec3, Vec4};

/// Width and height.
pub const SIZE: [usize; 2] = [60, 36];
const RADIUS: f32 = 0.6;
const SKY: f32 = 0.6;
/// Where the fog before the sky ends.
const SKY_DEPTH: f32 = 12.0;
/// Light that the fog scatters.
const FOG: [f32; 3] = [0.35, 0.4, 0.5];

/// What a pixel shows.
#[derive(Clone, Copy, Debug, Default)]
pub struct Seen {
    pub albedo: [f32; 3],
    pub normal: [f32; 3],
    /// View depth; 0 for the sky.
    pub depth: f32,
    pub position: [f32; 3],
    pub id: u32,
    /// Radiance without noise, and with it.
    pub reference: [f32; 3],
    pub noisy: [f32; 3],
    /// What the fog scatters, and the sky as it is seen: parts of `noisy`.
    pub volume: [f32; 3],
    pub environment: [f32; 3],
    /// Pixels to the previous frame, y down.
    pub motion: [f32; 2],
}

/// The scene; what its fields say holds for every frame.
#[derive(Clone, Copy, Debug)]
pub struct Scene {
    /// Radians by which the camera goes round in a frame.
    pub speed: f32,
    /// Every frame has other noise.
    pub animates: bool,
    /// Paths a pixel.
    pub samples: u32,
    /// The ball is carried by the camera.
    pub is_carried: bool,
    /// Extinction of a fog, in 1 over the unit of depth. Where there is one, albedo, normal and depth
    /// are means over what the paths of a pixel met, as renderers write them.
    pub fog: f32,
}

impl Default for Scene {
    fn default() -> Self {
        Self { speed: 0.03, animates: true, samples: 2, is_carried: false, fog: 0.0 }
    }
}

impl Scene {
    pub fn view(&self, frame: u32) -> Mat4 {
        let angle = self.speed * frame as f32;
        let eye = Vec3::new(4.0 * angle.sin(), 1.6, 4.0 * angle.cos() - if self.is_carried { 0.2 * frame as f32 } else { 0.0 });
        Mat4::from_translation(eye).mul_mat4(&Mat4::from_rotation_y(angle)).mul_mat4(&Mat4::from_rotation_x(-0.2)).inverse()
    }

    pub fn projection() -> Mat4 {
        let (focal, aspect) = (2.1, SIZE[0] as f32 / SIZE[1] as f32);
        let (near, far) = (0.1_f32, 100.0_f32);
        Mat4::from_cols(
            Vec4::new(focal / aspect, 0.0, 0.0, 0.0),
            Vec4::new(0.0, -focal, 0.0, 0.0),
            Vec4::new(0.0, 0.0, far / (near - far), -1.0),
            Vec4::new(0.0, 0.0, far * near / (near - far), 0.0),
        )
    }

    fn ball(&self, frame: u32) -> Vec3 {
        match self.is_carried {
            true => self.view(frame).inverse().transform_point3(Vec3::new(0.5, -0.5, -2.2)),
            false => Vec3::new(-1.0 + 0.05 * frame as f32, RADIUS, 0.6),
        }
    }

    fn radius(&self) -> f32 {
        if self.is_carried {
            0.3
        } else {
            RADIUS
        }
    }

    /// The pixel at a place of a frame.
    pub fn pixel(&self, frame: u32, x: i32, y: i32) -> Seen {
        let view = self.view(frame);
        let camera = view.inverse();
        let p = Self::projection();
        let at = Vec2::new((x as f32 + 0.5) / SIZE[0] as f32, (y as f32 + 0.5) / SIZE[1] as f32) * 2.0 - 1.0;
        let eye = camera.transform_point3(Vec3::ZERO);
        // The view depth of a point is its distance in these.
        let ray = camera.transform_vector3(Vec3::new(at.x / p.x_axis.x, at.y / p.y_axis.y, -1.0));
        let mut seen = self.trace(frame, eye, ray);
        let light = Vec3::new(0.4, 0.8, 0.45).normalize();
        let irradiance = 0.15 + 1.6 * Vec3::from(seen.normal).dot(light).max(0.0);
        let factor = self.noise(frame, x, y);
        if seen.id == 0 {
            seen.albedo = [1.0; 3];
            (seen.reference, seen.noisy) = ([SKY * 0.5, SKY * 0.7, SKY], [SKY * 0.5, SKY * 0.7, SKY]);
        } else {
            seen.reference = seen.albedo.map(|a| a * irradiance);
            seen.noisy = seen.reference.map(|v| v * factor);
        }
        seen.environment = if seen.id == 0 { seen.noisy } else { [0.0; 3] };
        seen.motion = self.motion(frame, &seen, ray, at);
        if self.fog > 0.0 {
            self.in_fog(&seen, |i| noise(x, y, 1_000_000 + frame * 256 + i))
        } else {
            seen
        }
    }

    /// The pixel behind fog: each path either ends in it, or reaches the surface.
    fn in_fog(&self, behind: &Seen, random: impl Fn(u32) -> f32) -> Seen {
        let length = if behind.id == 0 { SKY_DEPTH } else { behind.depth };
        let through = (-self.fog * length).exp();
        let reference = std::array::from_fn(|c| through * behind.reference[c] + (1.0 - through) * FOG[c]);
        let clear = Seen { albedo: [0.0; 3], normal: [0.0; 3], depth: 0.0, noisy: [0.0; 3], environment: [0.0; 3], ..*behind };
        let mut seen = Seen { reference, ..clear };
        let share = 1.0 / self.samples as f32;
        let add = |sum: &mut [f32; 3], value: [f32; 3], weight: f32| {
            sum.iter_mut().zip(value).for_each(|(sum, v)| *sum += share * weight * v);
        };
        for i in 0..self.samples {
            let [distance, light] = [3 * i, 3 * i + 1].map(|i| -(1.0 - random(i)).max(1e-6).ln());
            let distance = distance / self.fog;
            if distance < length {
                add(&mut seen.volume, FOG, light);
                add(&mut seen.noisy, FOG, light);
                seen.depth += share * distance;
                continue;
            }
            let light = if behind.id == 0 { 1.0 } else { light };
            add(&mut seen.noisy, behind.reference, light);
            add(&mut seen.normal, behind.normal, 1.0);
            seen.depth += share * length;
            match behind.id {
                0 => add(&mut seen.environment, behind.reference, 1.0),
                _ => add(&mut seen.albedo, behind.albedo, 1.0),
            }
        }
        seen
    }

    fn trace(&self, frame: u32, eye: Vec3, ray: Vec3) -> Seen {
        let mut seen = Seen::default();
        let mut hit = |t: f32, normal: Vec3, albedo: [f32; 3], id: u32| {
            if t > 1e-3 && (seen.depth == 0.0 || t < seen.depth) {
                seen = Seen { depth: t, normal: normal.into(), albedo, id, position: (eye + ray * t).into(), ..Seen::default() };
            }
        };
        let floor = -eye.y / ray.y;
        let on = eye + ray * floor;
        if on.x.abs() < 6.0 && on.z.abs() < 6.0 {
            let is_dark = ((on.x * 2.0).floor() + (on.z * 2.0).floor()).rem_euclid(2.0) < 1.0;
            hit(floor, Vec3::Y, if is_dark { [0.25, 0.3, 0.35] } else { [0.8, 0.75, 0.7] }, 1);
        }
        let wall = (-2.0 - eye.z) / ray.z;
        let on = eye + ray * wall;
        if on.x.abs() < 3.0 && (0.0..2.2).contains(&on.y) {
            hit(wall, Vec3::Z, [0.7, 0.3, 0.25], 2);
        }
        let (ball, radius) = (self.ball(frame), self.radius());
        let (a, b, c) = (ray.length_squared(), ray.dot(eye - ball), (eye - ball).length_squared() - radius * radius);
        if b * b > a * c {
            let t = (-b - (b * b - a * c).sqrt()) / a;
            hit(t, (eye + ray * t - ball) / radius, [0.3, 0.6, 0.9], 3);
        }
        seen
    }

    /// The mean of as many exponential samples as there are paths.
    fn noise(&self, frame: u32, x: i32, y: i32) -> f32 {
        let seed = if self.animates { frame } else { 0 };
        let sample = |i: u32| -(1.0 - noise(x, y, 1 + seed * 64 + i)).max(1e-6).ln();
        (0..self.samples).map(sample).sum::<f32>() / self.samples as f32
    }

    fn motion(&self, frame: u32, seen: &Seen, ray: Vec3, at: Vec2) -> [f32; 2] {
        let before = frame.saturating_sub(1);
        let (view, clip) = (self.view(before), Self::projection());
        let point = match seen.id {
            0 => view.transform_vector3(ray),
            3 => {
                // The point of the ball: it turns with the camera that carries it.
                let point = Vec3::from(seen.position);
                match self.is_carried {
                    true => self.view(frame).transform_point3(point),
                    false => view.transform_point3(point - self.ball(frame) + self.ball(before)),
                }
            }
            _ => view.transform_point3(seen.position.into()),
        };
        let there = clip * point.extend(if seen.id == 0 { 0.0 } else { 1.0 });
        let pixels = (Vec2::new(there.x, there.y) / there.w - at) * 0.5 * Vec2::new(SIZE[0] as f32, SIZE[1] as f32);
        if pixels.is_finite() {
            pixels.into()
        } else {
            [0.0; 2]
        }
    }

    /// `sequence.json` with the cameras of the frames.
    pub fn cameras(&self, frames: std::ops::Range<u32>) -> String {
        let rows = |m: Mat4| {
            let rows = m.transpose().to_cols_array_2d().map(|row| format!("[{},{},{},{}]", row[0], row[1], row[2], row[3]));
            format!("[{}]", rows.join(","))
        };
        let frame = |i| format!(r#"{{"i": {i}, "view": {}, "proj": {}}}"#, rows(self.view(i)), rows(Self::projection()));
        format!(r#"{{"frames": [{}]}}"#, frames.map(frame).collect::<Vec<_>>().join(","))
    }

    /// A frame's pixels, once for all channels.
    pub fn frame(&self, number: u32) -> Frame {
        let [width, height] = SIZE.map(|side| side as i32);
        let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| self.pixel(number, x, y));
        Frame { pixels: std::rc::Rc::new(pixels.collect()) }
    }
}

/// The pixels of a frame.
#[derive(Clone)]
pub struct Frame {
    pub pixels: std::rc::Rc<Vec<Seen>>,
}

impl Frame {
    /// A sample without channels, of the size of the scene.
    pub fn sample() -> Sample {
        let window = bounds(0, 0, SIZE[0], SIZE[1]);
        Sample { display: window, data: window, ..Sample::new(1, 1) }
    }

    /// Adds channels `layer.X/Y/Z` or the like, one for each letter, of what `value` says of a pixel.
    pub fn add<const N: usize>(
        &self,
        sample: Sample,
        layer: &str,
        letters: &str,
        value: impl Fn(&Seen) -> [f32; N] + Clone + 'static,
    ) -> Sample {
        let dot = if layer.is_empty() { "" } else { "." };
        letters.chars().enumerate().fold(sample, |sample, (i, letter)| {
            let (pixels, value) = (self.pixels.clone(), value.clone());
            sample.channel(&format!("{layer}{dot}{letter}"), Type::Float, move |x, y| {
                pixels.get(y as usize * SIZE[0] + x as usize).map_or(0.0, |seen| value(seen)[i])
            })
        })
    }

    /// Colour, reference, albedo, normal, depth, motion and ids under plain names.
    pub fn plain(&self) -> Sample {
        let sample = self.add(Self::sample(), "", "RGB", |s| s.noisy);
        self.guides(sample)
    }

    /// All of it but the colour.
    pub fn guides(&self, sample: Sample) -> Sample {
        let sample = self.add(sample, "ref", "RGB", |s| s.reference);
        let sample = self.add(sample, "albedo", "RGB", |s| s.albedo);
        let sample = self.add(sample, "normal", "XYZ", |s| s.normal);
        let sample = self.add(sample, "depth", "Z", |s| [s.depth]);
        let sample = self.add(sample, "motion", "XY", |s| s.motion);
        let pixels = self.pixels.clone();
        sample.channel("id.I", Type::Uint, move |x, y| pixels[y as usize * SIZE[0] + x as usize].id as f32)
    }
}
