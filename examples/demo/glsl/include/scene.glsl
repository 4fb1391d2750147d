// The scene's buffers: set 0 of every shader of the demo. World space, right-handed, +Y up, scene units (metres).
// The Rust twins are in src/tracer/layout.rs.
#ifndef SCENE_GLSL
#define SCENE_GLSL

const float PI = 3.14159265358979;
const float INV_PI = 1.0 / PI;
const uint NO_INSTANCE = 0xffffffffu;
const uint NO_TEXTURE = 0xffffffffu;
const uint CHECKER_TEXTURE = 0xfffffffeu;

struct CameraFrame {
    vec4 eye;     // xyz: position
    vec4 right;   // xyz: unit right times tan(half horizontal field of view)
    vec4 up;      // xyz: unit up times tan(half vertical field of view)
    vec4 forward; // xyz: unit view direction
};

struct Instance {
    vec4 world_from_object[3];          // rows
    vec4 previous_world_from_object[3]; // rows
    uint first_triangle;
    uint material;
    uint surface_id;
    uint unused;
};

// Object space. One per triangle.
struct TriangleAttributes {
    vec4 position_u[3]; // xyz: position, w: texture u
    vec4 normal_v[3];   // xyz: shading normal, w: texture v
};

struct Material {
    vec4 base_color_roughness;
    vec4 checker_color_scale; // rgb: the other colour of the checker, a: squares per unit of uv
    vec4 emission_weight;     // rgb: radiance, a: its weight for light selection (0: not a light)
    float metallic;
    float specular;           // reflectance at normal incidence of the dielectric coat; 0: a pure diffuser
    uint base_color_texture;
    uint emission_texture;
    uint two_sided_emission;
    uint unused[3];
};

const uint LIGHT_TRIANGLE = 0u;
const uint LIGHT_SUN = 1u;
const uint LIGHT_POINT = 2u; // a spot is a point with cos_outer > -1

struct Light {
    vec4 position_kind;      // triangle: first corner; sun: direction to it; point: position. w: kind, and the triangle from bit 2 on
    vec4 edge1_cdf;          // triangle: first edge; point: spot direction. w: upper bound in the cumulated distribution
    vec4 edge2_probability;  // triangle: second edge; sun: x sine of its radius; point: xy cosines of the spot's cone. w: selection probability
    vec4 radiance_material;  // triangle: x: -1 when the instance is mirrored; sun: irradiance; point: intensity. w: material index (triangle only)
};

struct Texture {
    uint first_texel;
    uint width;
    uint height;
    uint unused;
};

const uint LIGHT_SAMPLING_MIS = 0u;
const uint LIGHT_SAMPLING_LIGHTS = 1u;
const uint LIGHT_SAMPLING_BSDF = 2u;

layout(set = 0, binding = 0, std140) uniform FrameConstants {
    CameraFrame camera;
    CameraFrame previous_camera;
    uvec4 extent_frame_seed;    // xy: extent, z: frame index, w: user seed
    vec4 jitter_epsilon_weight; // xy: jitter in pixels, z: ray offset in scene units, w: sum of all light weights
    vec4 sky_zenith;            // rgb: radiance; a: 1 when the environment gives light
    vec4 sky_horizon;
    vec4 sky_ground;
    uvec4 counts;               // x: lights, y: how lights are sampled, z: triangles
} frame;
layout(set = 0, binding = 1) uniform samplerBuffer bvh_nodes;     // two texels for each node
layout(set = 0, binding = 2) uniform samplerBuffer bvh_triangles; // three texels for each triangle
layout(set = 0, binding = 3, std430) readonly buffer Attributes { TriangleAttributes attributes[]; };
layout(set = 0, binding = 4, std430) readonly buffer Instances { Instance instances[]; };
layout(set = 0, binding = 5, std430) readonly buffer Materials { Material materials[]; };
layout(set = 0, binding = 6, std430) readonly buffer Lights { Light lights[]; };
layout(set = 0, binding = 7, std430) readonly buffer Textures { uvec4 texture_headers[64]; uint texels[]; };

float luminance(vec3 radiance) { return dot(radiance, vec3(0.2126, 0.7152, 0.0722)); }

// Radiance of the environment in a world-space direction: ground, horizon, zenith.
vec3 environment(vec3 direction) {
    float height = direction.y;
    vec3 sky = mix(frame.sky_horizon.rgb, frame.sky_zenith.rgb, pow(clamp(height, 0.0, 1.0), 0.6));
    return mix(frame.sky_ground.rgb, sky, smoothstep(-0.05, 0.02, height));
}

#endif
