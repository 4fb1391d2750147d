// One path a pixel: primary surfaces from Bevy's prepass, a light with soft shadows, and light that bounced once.

struct Frame {
    world_from_clip: mat4x4f,
    eye: vec4f,
    // xyz: centre, w: radius
    light: vec4f,
    // x: number of the frame, y: paths a pixel
    numbers: vec4u,
    // xyz: centre, w: radius; then the albedo
    spheres: array<vec4f, 2 * SPHERES>,
}

const SPHERES = 5u;
const LIGHT = 24.0;
const PI = 3.14159265;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var depths: texture_depth_2d;
@group(0) @binding(2) var normals: texture_2d<f32>;
@group(0) @binding(3) var motions: texture_2d<f32>;
@group(0) @binding(4) var noisy: texture_storage_2d<rgba16float, write>;
@group(0) @binding(5) var albedos: texture_storage_2d<rgba16float, write>;
// What the prepass holds, for the check of the conventions: depth; normal; motion.
@group(0) @binding(6) var<storage, read_write> guides: array<vec4f>;

var<private> state: u32;

fn random() -> f32 {
    state = state * 747796405u + 2891336453u;
    let word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return f32(((word >> 22u) ^ word) >> 8u) / 16777216.0;
}

fn around(axis: vec3f, z: f32) -> vec3f {
    let helper = select(vec3f(1.0, 0.0, 0.0), vec3f(0.0, 1.0, 0.0), abs(axis.x) > 0.5);
    let x = normalize(cross(helper, axis));
    let angle = 2.0 * PI * random();
    let r = sqrt(max(0.0, 1.0 - z * z));
    return r * cos(angle) * x + r * sin(angle) * cross(axis, x) + z * axis;
}

struct Hit {
    distance: f32,
    normal: vec3f,
    albedo: vec3f,
}

fn floor_albedo(p: vec3f) -> vec3f {
    let odd = (i32(floor(p.x)) + i32(floor(p.z))) & 1;
    return select(vec3f(0.75), vec3f(0.25), odd == 1);
}

fn trace(origin: vec3f, direction: vec3f) -> Hit {
    var hit = Hit(1e9, vec3f(0.0), vec3f(0.0));
    if direction.y < 0.0 {
        let t = -origin.y / direction.y;
        if t > 0.0 {
            hit = Hit(t, vec3f(0.0, 1.0, 0.0), floor_albedo(origin + t * direction));
        }
    }
    for (var i = 0u; i < SPHERES; i++) {
        let sphere = frame.spheres[2u * i];
        let away = origin - sphere.xyz;
        let b = dot(away, direction);
        let discriminant = b * b - dot(away, away) + sphere.w * sphere.w;
        let t = -b - sqrt(max(0.0, discriminant));
        if discriminant > 0.0 && t > 0.0 && t < hit.distance {
            hit = Hit(t, normalize(away + t * direction), frame.spheres[2u * i + 1u].xyz);
        }
    }
    return hit;
}

fn sky(direction: vec3f) -> vec3f {
    return mix(vec3f(0.10, 0.11, 0.13), vec3f(0.16, 0.26, 0.48), clamp(direction.y, 0.0, 1.0));
}

// Direct light at a diffuse surface, divided by its albedo.
fn direct(p: vec3f, n: vec3f) -> vec3f {
    let towards = frame.light.xyz - p;
    let distance_2 = dot(towards, towards);
    let cos_max = sqrt(max(0.0, 1.0 - frame.light.w * frame.light.w / distance_2));
    let direction = around(normalize(towards), mix(cos_max, 1.0, random()));
    let cosine = dot(n, direction);
    if cosine <= 0.0 || trace(p, direction).distance < sqrt(distance_2) - frame.light.w {
        return vec3f(0.0);
    }
    return vec3f(LIGHT, 0.9 * LIGHT, 0.75 * LIGHT) * 2.0 * (1.0 - cos_max) * cosine;
}

// Light that arrives at a diffuse surface on one path, divided by π.
fn irradiance(p: vec3f, n: vec3f) -> vec3f {
    let direction = around(n, sqrt(1.0 - random()));
    let hit = trace(p, direction);
    if hit.distance > 1e8 {
        return direct(p, n) + sky(direction);
    }
    return direct(p, n) + hit.albedo * direct(p + hit.distance * direction + 0.01 * hit.normal, hit.normal);
}

// The albedo of what the prepass shows at a point: the sphere whose surface is there, else the floor.
fn albedo_at(p: vec3f) -> vec3f {
    for (var i = 0u; i < SPHERES; i++) {
        let sphere = frame.spheres[2u * i];
        if abs(distance(p, sphere.xyz) - sphere.w) < 0.02 {
            return frame.spheres[2u * i + 1u].xyz;
        }
    }
    return floor_albedo(p);
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) pixel: vec3u) {
    let extent = textureDimensions(depths);
    if any(pixel.xy >= extent) {
        return;
    }
    let depth = textureLoad(depths, pixel.xy, 0);
    let normal = textureLoad(normals, pixel.xy, 0).xyz;
    let index = pixel.y * extent.x + pixel.x;
    guides[3u * index] = vec4f(depth);
    guides[3u * index + 1u] = vec4f(normal, 0.0);
    guides[3u * index + 2u] = vec4f(textureLoad(motions, pixel.xy, 0).xy, 0.0, 0.0);

    let uv = (vec2f(pixel.xy) + 0.5) / vec2f(extent);
    // Any depth will do for the direction, except that of infinity.
    let at = frame.world_from_clip * vec4f(2.0 * uv.x - 1.0, 1.0 - 2.0 * uv.y, select(depth, 0.5, depth == 0.0), 1.0);
    let p = at.xyz / at.w;
    if depth == 0.0 {
        textureStore(noisy, pixel.xy, vec4f(sky(normalize(p - frame.eye.xyz)), 1.0));
        textureStore(albedos, pixel.xy, vec4f(1.0));
        return;
    }
    state = (index * 1664525u) ^ (frame.numbers.x * 1013904223u);
    _ = random();
    let n = normalize(2.0 * normal - 1.0);
    var sum = vec3f(0.0);
    for (var i = 0u; i < frame.numbers.y; i++) {
        sum += irradiance(p + 0.01 * n, n);
    }
    let albedo = albedo_at(p);
    textureStore(noisy, pixel.xy, vec4f(albedo * sum / f32(frame.numbers.y), 1.0));
    textureStore(albedos, pixel.xy, vec4f(albedo, 1.0));
}
