// The scene's buffers: set 0 of every shader of the demo. World space, right-handed, +Y up, scene units (metres).
// The Rust twins are in src/tracer/layout.rs.
#ifndef SCENE_GLSL
#define SCENE_GLSL

const float PI = 3.14159265358979;
const float INV_PI = 1.0 / PI;
const uint NO_INSTANCE = 0xffffffffu;
const uint NO_TEXTURE = 0xffffffffu;
const uint CHECKER_TEXTURE = 0xfffffffeu;

// What a triangle is, beside a closed surface: it has holes, is a thin pane, or bounds a body of glass.
const uint MASK_LEAVES = 1u;
const uint MASK_PANE = 2u;
const uint MASK_BODY = 3u;

struct CameraFrame {
    vec4 eye;     // xyz: position
    vec4 right;   // xyz: unit right times tan(half horizontal field of view)
    vec4 up;      // xyz: unit up times tan(half vertical field of view)
    vec4 forward; // xyz: unit view direction
};

struct Instance {
    vec4 world_from_object[3]; // rows
    uint first_triangle;
    uint material;
    uint surface_id;
};

// Object space. One per triangle.
struct TriangleAttributes {
    vec4 position_u[3]; // xyz: position, w: texture u
    vec4 normal_v[3];   // xyz: shading normal, w: texture v
};

struct Material {
    vec3 base_color;
    float roughness;
    vec3 checker_color;       // the other colour of the checker
    float checker_scale;      // squares per unit of uv
    vec3 emission;            // radiance
    float emission_weight;    // for light selection; 0: not a light
    bool two_sided_emission;
    float metallic;
    float specular;           // reflectance at normal incidence of the dielectric coat; 0: a pure diffuser
    uint base_color_texture;
    uint emission_texture;
};

const uint LIGHT_TRIANGLE = 0u;
const uint LIGHT_SUN = 1u;
const uint LIGHT_POINT = 2u;

struct Light {
    vec4 position_kind;      // triangle: first corner; sun: direction to it; point: position. w: kind, and the triangle from bit 2 on
    vec4 edge1_cdf;          // triangle: first edge; point: spot direction. w: upper bound in the cumulated distribution
    vec4 edge2_probability;  // triangle: second edge; sun: x sine of its radius; point: xy cosines of the spot's cone, z radius. w: selection probability
    vec4 radiance_material;  // triangle: x: -1 when the instance is mirrored, y: surface_id; sun: irradiance; point: intensity. w: material index (triangle only)
};

const uint LIGHT_SAMPLING_MIS = 0u;
const uint LIGHT_SAMPLING_LIGHTS = 1u;
const uint LIGHT_SAMPLING_BSDF = 2u;

// A storage buffer, since Mesa's software driver (22.3) compiles a shader whose loops end by a value of a uniform buffer for every frame.
layout(set = 0, binding = 0, std430) readonly buffer FrameConstants {
    CameraFrame camera;
    CameraFrame previous_camera;
    uvec4 extent_frame_seed;    // xy: extent, z: frame index, w: user seed
    vec4 jitter_epsilon_weight; // xy: jitter in pixels, z: ray offset in scene units, w: sum of all light weights
    vec4 sky_zenith;            // rgb: radiance; a: 1 when the environment gives light
    vec4 sky_horizon;           // a: 1 when noise is blue
    vec4 sky_ground;
    uvec4 counts;               // x: lights, y: how lights are sampled, z: index of the first lamp, w: lamps from there on that are apart
    vec4 medium;                // x: extinction, 1 / scene unit, 0 without a medium; y: mean cosine of the scattering angle
    vec4 medium_scattering;     // rgb: scattering coefficient, 1 / scene unit
    uvec4 light;                // xy: pixels of the picture for each pixel of light, zw: which of them is traced
    uvec4 glass;                // x: what guides and signals have of glass, GLASS_*
} frame;
// Texel buffers of four words, since they are read several times faster than storage buffers on a CPU device, and not
// slower on a GPU. Unsigned, so that no driver takes packed integers for denormal floats.
layout(set = 0, binding = 1) uniform usamplerBuffer bvh_nodes;     // 2 texels each
layout(set = 0, binding = 2) uniform usamplerBuffer bvh_triangles; // 3 texels each
layout(set = 0, binding = 3) uniform usamplerBuffer attributes;    // 6 texels each
layout(set = 0, binding = 4) uniform usamplerBuffer instances;     // 7 texels each: rows now, rows in the previous frame, indices
layout(set = 0, binding = 5) uniform usamplerBuffer materials;     // 4 texels each
layout(set = 0, binding = 6) uniform usamplerBuffer lights;        // 4 texels each
layout(set = 0, binding = 7, std430) readonly buffer Textures { uvec4 texture_headers[64]; uint texels[]; };

vec4 fetch_floats(usamplerBuffer buffer_of_words, uint index) { return uintBitsToFloat(texelFetch(buffer_of_words, int(index))); }

Instance load_instance(uint index) {
    uint base = 7u * index;
    uvec4 indices = texelFetch(instances, int(base + 6u));
    vec4 rows[3] = vec4[3](fetch_floats(instances, base), fetch_floats(instances, base + 1u), fetch_floats(instances, base + 2u));
    return Instance(rows, indices.x, indices.y, indices.z);
}

vec4[3] load_previous_world_from_object(uint index) {
    uint base = 7u * index + 3u;
    return vec4[3](fetch_floats(instances, base), fetch_floats(instances, base + 1u), fetch_floats(instances, base + 2u));
}

TriangleAttributes load_triangle(uint index) {
    uint base = 6u * index;
    return TriangleAttributes(
        vec4[3](fetch_floats(attributes, base), fetch_floats(attributes, base + 1u), fetch_floats(attributes, base + 2u)),
        vec4[3](fetch_floats(attributes, base + 3u), fetch_floats(attributes, base + 4u), fetch_floats(attributes, base + 5u)));
}

Material load_material(uint index) {
    vec4 base = fetch_floats(materials, 4u * index);
    vec4 checker = fetch_floats(materials, 4u * index + 1u);
    vec4 emission = fetch_floats(materials, 4u * index + 2u);
    uvec4 rest = texelFetch(materials, int(4u * index + 3u));
    // The weight's sign says whether both sides emit.
    return Material(base.rgb, base.a, checker.rgb, checker.a, emission.rgb, abs(emission.a), emission.a < 0.0,
        uintBitsToFloat(rest.x), uintBitsToFloat(rest.y), rest.z, rest.w);
}

Light load_light(uint index) {
    uint base = 4u * index;
    return Light(fetch_floats(lights, base), fetch_floats(lights, base + 1u), fetch_floats(lights, base + 2u), fetch_floats(lights, base + 3u));
}

// Pixels of light, and the pixel of the picture that one of them is traced for.
ivec2 light_extent() { return ivec2(frame.extent_frame_seed.xy / frame.light.xy); }
ivec2 seen_pixel_of(ivec2 lit) { return lit * ivec2(frame.light.xy) + ivec2(frame.light.zw); }

// Of the medium over a distance; 1 without one.
float medium_transmittance(float distance) { return frame.medium.x > 0.0 ? exp(-frame.medium.x * distance) : 1.0; }

float luminance(vec3 radiance) { return dot(radiance, vec3(0.2126, 0.7152, 0.0722)); }

// Radiance of the environment in a world-space direction: ground, horizon, zenith.
vec3 environment(vec3 direction) {
    float height = direction.y;
    vec3 sky = mix(frame.sky_horizon.rgb, frame.sky_zenith.rgb, pow(clamp(height, 0.0, 1.0), 0.6));
    return mix(frame.sky_ground.rgb, sky, smoothstep(-0.05, 0.02, height));
}

#endif
