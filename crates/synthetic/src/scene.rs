//! A synthetic scene with exact guides: a ball before a checkered wall, a sky above, seen by a camera that may slide.
//!
//! Rays are intersected analytically, so depth, normal, motion and the clean radiance have no error of their own.

use atrous::{Declaration, FrameParams};

/// The inputs of one frame, row by row, four floats a texel.
#[derive(Clone)]
pub struct Guides {
    /// x: linear; 0 is the sky.
    pub depth: Vec<[f32; 4]>,
    /// xyz, world.
    pub normal: Vec<[f32; 4]>,
    /// xy: `uv_previous − uv_current`.
    pub motion: Vec<[f32; 4]>,
    /// Albedo of the primary hit.
    pub albedo: Vec<[f32; 4]>,
    /// 0: sky, 1: wall, 2: ball.
    pub surface_id: Vec<u32>,
    /// Direct and indirect light together.
    pub noisy_radiance: Vec<[f32; 4]>,
    /// Three quarters of the light, with noise of its own.
    pub noisy_direct: Vec<[f32; 4]>,
    /// The other quarter.
    pub noisy_indirect: Vec<[f32; 4]>,
    /// Light that surfaces scatter, with noise of its own.
    pub noisy_diffuse: Vec<[f32; 4]>,
    /// What is mirrored in them, with noise of its own: stripes behind the camera, and the sky.
    pub noisy_specular: Vec<[f32; 4]>,
    /// Reflectance of the coat.
    pub specular_albedo: Vec<[f32; 4]>,
    /// Perceptual roughness: that of the wall rises to the right.
    pub roughness: Vec<[f32; 4]>,
    /// Distance from a surface to what is mirrored; 0: the sky.
    pub specular_hit_distance: Vec<[f32; 4]>,
    /// The mirrored light of a converged renderer.
    pub clean_specular: Vec<[f32; 4]>,
    /// The image that a converged renderer would give.
    pub clean: Vec<[f32; 4]>,
    /// One sample of the fog, mostly dark.
    pub noisy_volume: Vec<[f32; 4]>,
    /// Depth of that sample; some are 0, NaN or infinite, as hosts give them.
    pub scattering_depth: Vec<[f32; 4]>,
    /// The volume of a converged renderer.
    pub clean_volume: Vec<[f32; 4]>,
    /// One shadow ray to a lamp: 0 or 1; some are NaN or out of range, as hosts give them.
    pub noisy_visibility: Vec<[f32; 4]>,
    /// Distance of what is in its way; infinite for nothing.
    pub occluder_distance: Vec<[f32; 4]>,
    /// Light of that lamp where nothing is in the way.
    pub unshadowed_direct: Vec<[f32; 4]>,
    /// The visibility of a converged renderer.
    pub clean_visibility: Vec<[f32; 4]>,
    /// The same of three further lamps.
    pub further_lights: [Lamp; 3],
}

/// A lamp whose shadows are apart.
#[derive(Clone)]
pub struct Lamp {
    /// One shadow ray; in what is in the way light keeps some of its colour.
    pub noisy_visibility: Vec<[f32; 4]>,
    /// Distance of what is in its way; infinite for nothing.
    pub occluder_distance: Vec<[f32; 4]>,
    /// Light where nothing is in the way.
    pub unshadowed_direct: Vec<[f32; 4]>,
    /// The visibility of a converged renderer.
    pub clean_visibility: Vec<[f32; 4]>,
}

/// What the occluders of each lamp let through, of green and blue; of red nothing.
const THROUGH: [[f32; 2]; 4] = [[0.5, 0.125], [0.0, 0.0], [0.25, 1.0], [0.0, 0.75]];

/// Visibility in colour, of a visible share.
fn tinted(v: f32, lamp: usize) -> [f32; 4] {
    let [green, blue] = THROUGH[lamp].map(|through| v + (1.0 - v) * through);
    [v, green, blue, 0.0]
}

impl Guides {
    /// Every image of floats by the name of its input; the normals serve twice.
    pub fn images(&self) -> [(&'static str, &[[f32; 4]]); 29] {
        let [second, third, fourth] = &self.further_lights;
        [
            ("depth", &self.depth),
            ("normal", &self.normal),
            ("object_normal", &self.normal),
            ("motion", &self.motion),
            ("albedo", &self.albedo),
            ("noisy_radiance", &self.noisy_radiance),
            ("noisy_direct", &self.noisy_direct),
            ("noisy_indirect", &self.noisy_indirect),
            ("noisy_diffuse", &self.noisy_diffuse),
            ("noisy_specular", &self.noisy_specular),
            ("specular_albedo", &self.specular_albedo),
            ("roughness", &self.roughness),
            ("specular_hit_distance", &self.specular_hit_distance),
            ("noisy_volume", &self.noisy_volume),
            ("scattering_depth", &self.scattering_depth),
            ("noisy_visibility", &self.noisy_visibility),
            ("occluder_distance", &self.occluder_distance),
            ("unshadowed_direct", &self.unshadowed_direct),
            ("noisy_ambient", &third.noisy_visibility),
            ("ambient_distance", &third.occluder_distance),
            ("noisy_visibility_1", &second.noisy_visibility),
            ("noisy_visibility_2", &third.noisy_visibility),
            ("noisy_visibility_3", &fourth.noisy_visibility),
            ("occluder_distance_1", &second.occluder_distance),
            ("occluder_distance_2", &third.occluder_distance),
            ("occluder_distance_3", &fourth.occluder_distance),
            ("unshadowed_direct_1", &second.unshadowed_direct),
            ("unshadowed_direct_2", &third.unshadowed_direct),
            ("unshadowed_direct_3", &fourth.unshadowed_direct),
        ]
    }

    /// Those of [`Self::images`] that a graph takes; the roughness where it filters specular light.
    pub fn declared<'a>(&'a self, declaration: &'a Declaration) -> impl Iterator<Item = (&'static str, &'a [[f32; 4]])> {
        let has = |name: &str| declaration.find(name).is_some();
        self.images().into_iter().filter(move |(name, _)| has(name) && (*name != "roughness" || has("noisy_specular")))
    }
}

/// Root of the mean squared difference of colours.
pub fn rmse(a: &[[f32; 4]], b: &[[f32; 4]]) -> f64 {
    let squared = |(a, b): (&[f32; 4], &[f32; 4])| (0..3).map(|i| f64::from(a[i] - b[i]).powi(2)).sum::<f64>();
    (a.iter().zip(b).map(squared).sum::<f64>() / (3 * a.len()) as f64).sqrt()
}

/// The scene.
#[derive(Clone, Copy)]
pub struct Scene {
    /// Extent that is rendered.
    pub extent: [u32; 2],
    /// Extent of the images around it; what lies outside the render extent is NaN.
    pub allocated: [u32; 2],
    /// Camera speed, scene units a frame, to the right.
    pub speed: f32,
    /// Standard deviation of the noise relative to the clean value.
    pub noise: f32,
    /// Factor of all light.
    pub light: f32,
    /// Where the sample of a pixel lies, in pixels from its middle.
    pub jitter: [f32; 2],
}

/// Focal length of every camera, in halves of the image's height.
pub(crate) const FOCAL: f32 = 1.2;
const WALL: f32 = 6.0;
const BALL: [f32; 4] = [0.3, -0.2, 4.0, 1.0];

/// Depth of a sheet of fog, before everything else.
const FOG: f32 = 2.0;

/// The shadows of boards beside one another, ever farther away from what they lie on, in the light of a lamp as large as the sun.
struct Shadow {
    visibility: f32,
    distance: f32,
}

impl Shadow {
    fn at(camera: f32, direction: [f32; 2], depth: f32, lamp: usize) -> Self {
        const LIGHT_RADIUS: f32 = 0.00465;
        if depth == 0.0 {
            return Self { visibility: 1.0, distance: f32::INFINITY };
        }
        // Four scene units from one board to the next; the penumbra on both sides grows along it.
        let [x, y] = [camera + direction[0] * depth, direction[1] * depth];
        // Each lamp has boards of its own.
        let (x, y) = if lamp.is_multiple_of(2) { (x + lamp as f32, y) } else { (y + lamp as f32, x) };
        let distance = 20.0 + 12.0 * (y + 3.0);
        let from_edge = (x.rem_euclid(4.0) - 2.0).abs() - 1.0;
        Self { visibility: (0.5 + 0.5 * from_edge / (LIGHT_RADIUS * distance)).clamp(0.0, 1.0), distance }
    }

    /// Visibility and distance of one shadow ray.
    fn sample(&self, u: f32) -> [f32; 2] {
        if u < self.visibility {
            [1.0, f32::INFINITY]
        } else {
            [0.0, self.distance]
        }
    }
}

/// Radiance that the fog scatters towards the camera: stripes.
fn fog(x: f32, y: f32) -> f32 {
    0.5 + 0.45 * (4.0 * x + 1.5 * y).sin()
}

/// The camera at a point of world space, which looks along −z.
pub(crate) fn camera(extent: [u32; 2], eye: [f32; 3]) -> FrameParams {
    let aspect = extent[0] as f32 / extent[1] as f32;
    let (near, far) = (0.1, 100.0);
    FrameParams {
        view_from_world: [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [-eye[0], -eye[1], -eye[2], 1.0]],
        clip_from_view: [
            [FOCAL / aspect, 0.0, 0.0, 0.0],
            [0.0, -FOCAL, 0.0, 0.0],
            [0.0, 0.0, far / (near - far), -1.0],
            [0.0, 0.0, near * far / (near - far), 0.0],
        ],
        ..FrameParams::new(extent)
    }
}

/// Reflectance of every coat.
const SPECULAR: [f32; 4] = [0.5, 0.4, 0.3, 0.0];
/// z of a striped screen behind the camera.
const SCREEN: f32 = 3.0;

/// What is seen in a surface.
struct Mirrored {
    light: f32,
    distance: f32,
    roughness: f32,
}

struct Hit {
    depth: f32,
    normal: [f32; 3],
    albedo: [f32; 3],
    light: f32,
    id: u32,
}

impl Hit {
    /// What the ray `(x, y, −1)` from the camera meets behind the surface that it is mirrored by.
    fn mirrored(&self, camera: f32, [dx, dy]: [f32; 2]) -> Mirrored {
        let position = [camera + dx * self.depth, dy * self.depth, -self.depth];
        let length = (dx * dx + dy * dy + 1.0).sqrt();
        let sight = [dx / length, dy / length, -1.0 / length];
        let along: f32 = (0..3).map(|i| sight[i] * self.normal[i]).sum();
        let [rx, _, rz] = [0, 1, 2].map(|i| sight[i] - 2.0 * along * self.normal[i]);
        let roughness = if self.id == 2 { 0.2 } else { (0.15 * (position[0] + 3.0)).clamp(0.0, 1.0) };
        if self.id == 0 || rz < 0.1 {
            return Mirrored { light: 0.3, distance: 0.0, roughness };
        }
        let distance = (SCREEN - position[2]) / rz;
        Mirrored { light: 0.6 + 0.4 * (2.0 * (position[0] + rx * distance)).sin(), distance, roughness }
    }
}

impl Scene {
    /// Stands still, with strong noise.
    pub fn new(extent: [u32; 2]) -> Self {
        Self { extent, allocated: extent, speed: 0.0, noise: 0.7, light: 1.0, jitter: [0.0; 2] }
    }

    /// The camera of frame `index`.
    pub fn params(&self, index: u32) -> FrameParams {
        FrameParams { jitter: self.jitter, ..camera(self.extent, [self.camera(index), 0.0, 0.0]) }
    }

    fn camera(&self, index: u32) -> f32 {
        self.speed * index as f32
    }

    /// The inputs of frame `index`; `seed` picks the noise.
    pub fn frame(&self, index: u32, seed: u32) -> Guides {
        let count = (self.allocated[0] * self.allocated[1]) as usize;
        let nan = vec![[f32::NAN; 4]; count];
        let mut g = Guides {
            depth: nan.clone(),
            normal: nan.clone(),
            motion: nan.clone(),
            albedo: nan.clone(),
            surface_id: vec![u32::MAX; count],
            noisy_radiance: nan.clone(),
            noisy_direct: nan.clone(),
            noisy_indirect: nan.clone(),
            noisy_diffuse: nan.clone(),
            noisy_specular: nan.clone(),
            specular_albedo: nan.clone(),
            roughness: nan.clone(),
            specular_hit_distance: nan.clone(),
            clean_specular: nan.clone(),
            clean: nan.clone(),
            noisy_volume: nan.clone(),
            scattering_depth: nan.clone(),
            clean_volume: nan.clone(),
            noisy_visibility: nan.clone(),
            occluder_distance: nan.clone(),
            unshadowed_direct: nan.clone(),
            further_lights: std::array::from_fn(|_| Lamp {
                noisy_visibility: nan.clone(),
                occluder_distance: nan.clone(),
                unshadowed_direct: nan.clone(),
                clean_visibility: nan.clone(),
            }),
            clean_visibility: nan,
        };
        for (x, y) in pixels(self.extent) {
            let i = (y * self.allocated[0] + x) as usize;
            let direction = self.direction(x, y);
            let hit = trace(self.camera(index), direction);
            let lit = hit.albedo.map(|a| a * hit.light * self.light);
            let u = [random(x, y, seed * 4), random(x, y, seed * 4 + 1), random(x, y, seed * 4 + 2)];
            let noise = |u: f32| if hit.id == 0 { 1.0 } else { 1.0 + self.noise * 12f32.sqrt() * (u - 0.5) };
            let rgba = |scale: f32| [lit[0] * scale, lit[1] * scale, lit[2] * scale, 1.0];
            g.depth[i] = [hit.depth; 4];
            g.normal[i] = [hit.normal[0], hit.normal[1], hit.normal[2], 0.0];
            g.motion[i] = [self.motion_uv(hit.depth), 0.0, 0.0, 0.0];
            g.albedo[i] = [hit.albedo[0], hit.albedo[1], hit.albedo[2], 1.0];
            g.surface_id[i] = hit.id;
            g.noisy_radiance[i] = rgba(noise(u[0]).max(0.0));
            g.noisy_direct[i] = rgba(0.75 * noise(u[1]).max(0.0));
            g.noisy_indirect[i] = rgba(0.25 * noise(u[2]).max(0.0));
            g.clean[i] = rgba(1.0);
            g.noisy_diffuse[i] = rgba(noise(random(x, y, seed * 4 + 900)).max(0.0));
            let mirrored = hit.mirrored(self.camera(index), direction);
            let specular = |noise: f32| SPECULAR.map(|a| a * mirrored.light * self.light * noise);
            g.noisy_specular[i] = specular(noise(random(x, y, seed * 4 + 901)).max(0.0));
            g.clean_specular[i] = specular(1.0);
            g.specular_albedo[i] = SPECULAR;
            g.roughness[i] = [mirrored.roughness; 4];
            g.specular_hit_distance[i] = [mirrored.distance; 4];
            let light = self.light * fog(self.camera(index) + direction[0] * FOG, direction[1] * FOG);
            let u = [random(x, y, seed * 4 + 3), random(x, y, seed * 4 + 700)];
            // Most samples of light in a fog are dark.
            let noisy = if u[0] < 0.25 { 4.0 * light } else { 0.0 };
            g.noisy_volume[i] = [noisy, 0.5 * noisy, 0.25 * noisy, 0.0];
            g.clean_volume[i] = [light, 0.5 * light, 0.25 * light, 0.0];
            let shadow = Shadow::at(self.camera(index), direction, hit.depth, 0);
            let [ray, spoilt] = [random(x, y, seed * 4 + 701), random(x, y, seed * 4 + 702)];
            let [v, distance] = shadow.sample(ray);
            let bad = [f32::NAN, 1.5, -0.5, f32::NEG_INFINITY].get((spoilt * 400.0) as usize);
            g.noisy_visibility[i] = bad.map_or(tinted(v, 0), |bad| [*bad; 4]);
            g.occluder_distance[i] = [if spoilt > 0.99 { -1.0 } else { distance }; 4];
            g.unshadowed_direct[i] = rgba(2.0);
            g.clean_visibility[i] = tinted(shadow.visibility, 0);
            for (lamp, seen) in (1..).zip(&mut g.further_lights) {
                let shadow = Shadow::at(self.camera(index), direction, hit.depth, lamp);
                let [v, distance] = shadow.sample(random(x, y, seed * 4 + 702 + lamp as u32));
                seen.noisy_visibility[i] = tinted(v, lamp);
                seen.occluder_distance[i] = [distance; 4];
                seen.unshadowed_direct[i] = rgba(0.5 * lamp as f32);
                seen.clean_visibility[i] = tinted(shadow.visibility, lamp);
            }
            g.scattering_depth[i] = [[0.0, f32::NAN, f32::INFINITY, FOG][((u[1] * 40.0) as usize).min(3)]; 4];
        }
        g
    }

    fn direction(&self, x: u32, y: u32) -> [f32; 2] {
        let ndc = |p: u32, i: usize| (p as f32 + 0.5 + self.jitter[i]) / self.extent[i] as f32 * 2.0 - 1.0;
        let aspect = self.extent[0] as f32 / self.extent[1] as f32;
        [ndc(x, 0) * aspect / FOCAL, -ndc(y, 1) / FOCAL]
    }

    /// `uv_previous − uv_current` of a point at this depth when the camera slides along x.
    fn motion_uv(&self, depth: f32) -> f32 {
        let aspect = self.extent[0] as f32 / self.extent[1] as f32;
        if depth == 0.0 {
            0.0
        } else {
            self.speed / depth * FOCAL / aspect * 0.5
        }
    }
}

/// The surface that the ray `(x, y, −1)·t` from the camera meets; `t` is the linear depth.
fn trace(camera: f32, [dx, dy]: [f32; 2]) -> Hit {
    let o = [camera - BALL[0], -BALL[1], BALL[2]];
    let (a, b) = (dx * dx + dy * dy + 1.0, o[0] * dx + o[1] * dy - o[2]);
    let c = o[0] * o[0] + o[1] * o[1] + o[2] * o[2] - BALL[3];
    let discriminant = b * b - a * c;
    if discriminant > 0.0 {
        let t = (-b - discriminant.sqrt()) / a;
        let n = [o[0] + dx * t, o[1] + dy * t, o[2] - t];
        let light = 0.2 + 0.8 * (0.5 * n[0] + 0.5 * n[1] + 0.7 * n[2]).max(0.0);
        return Hit { depth: t, normal: n, albedo: [0.8, 0.3, 0.2], light, id: 2 };
    }
    let (x, y) = (camera + dx * WALL, dy * WALL);
    if y > 2.2 {
        return Hit { depth: 0.0, normal: [0.0; 3], albedo: [1.0; 3], light: 0.4, id: 0 };
    }
    let odd = ((x.floor() + y.floor()) as i32).rem_euclid(2) as f32;
    let albedo = [0.2 + 0.6 * odd, 0.5, 0.7 - 0.4 * odd];
    Hit { depth: WALL, normal: [0.0, 0.0, 1.0], albedo, light: 0.6 + 0.3 * (0.8 * x).sin(), id: 1 }
}

/// Every pixel, row by row.
pub fn pixels(extent: [u32; 2]) -> impl Iterator<Item = (u32, u32)> {
    (0..extent[1]).flat_map(move |y| (0..extent[0]).map(move |x| (x, y)))
}

/// 32 random bits of three numbers.
pub fn hash(a: u32, b: u32, c: u32) -> u32 {
    let mut h = a.wrapping_mul(0x9e37_79b9) ^ b.wrapping_mul(0x85eb_ca6b) ^ c.wrapping_mul(0xc2b2_ae35);
    for _ in 0..2 {
        h = (h ^ h >> 16).wrapping_mul(0x7feb_352d);
        h = (h ^ h >> 15).wrapping_mul(0x846c_a68b);
    }
    h ^ h >> 16
}

/// Uniform in 0..1.
pub fn random(a: u32, b: u32, c: u32) -> f32 {
    (hash(a, b, c) >> 8) as f32 / (1 << 24) as f32
}
