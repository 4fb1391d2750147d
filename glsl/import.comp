#version 450
// Turns the host's guides into one packed encoding, and stops values that are not finite.
// Source: the encodings are the host's (Conventions); the depth gradient is that of [SVGF] eq. 3.
// In:  depth, normal, motion, roughness, surface_id, object_normal as the host encodes them; albedo;
//      instance_transforms: previous from current world space by surface_id, three rows of four.
// Out: guide, surface_motion, depth_gradient, object_normal_guide (docs/specification/packed_images.md).
// SURFACE_ID is a set of bindings of its own, since no other image could stand in for surface_id.
// optional: albedo, motion, roughness, instance_transforms, object_normal, object_normal_guide
// variants: SURFACE_ID=0 SURFACE_ID=1
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(push_constant) uniform Push {
    uint present;
} push;

#define GUIDE_PIXELS
#include "frame.glsl"
#include "viewport.glsl"
#include "conventions.glsl"
#include "demodulation.glsl"
#include "optional.glsl"
#include "statistics.glsl"
#include "surface_motion.glsl"
#include "view_position.glsl"
#include "roughness.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

const uint DEPTH = 2u;
const uint NORMAL = 3u;
const uint MOTION = 4u;
const uint ROUGHNESS = 5u;
const uint INSTANCE_TRANSFORMS = 6u;
const uint OBJECT_NORMAL = 10u;
const uint OBJECT_NORMAL_GUIDE = 11u;
const uint SURFACE_ID_IMAGE = 12u;
const uint ALBEDO = 13u;

layout(set = 0, binding = DEPTH) uniform texture2D depth;
layout(set = 0, binding = NORMAL) uniform texture2D normal;
layout(set = 0, binding = MOTION) uniform texture2D motion;
layout(set = 0, binding = ROUGHNESS) uniform texture2D roughness;
layout(set = 0, binding = INSTANCE_TRANSFORMS, std430) readonly buffer InstanceTransforms { vec4 rows[]; } instance_transforms;
layout(set = 0, binding = 7, rgba16ui) uniform writeonly uimage2D guide;
layout(set = 0, binding = 8, rgba16ui) uniform writeonly uimage2D surface_motion;
layout(set = 0, binding = ALBEDO) uniform texture2D albedo;
layout(set = 0, binding = 9, r32ui) uniform writeonly uimage2D depth_gradient;
layout(set = 0, binding = OBJECT_NORMAL) uniform texture2D object_normal;
layout(set = 0, binding = OBJECT_NORMAL_GUIDE, r32ui) uniform writeonly uimage2D object_normal_guide;
#if SURFACE_ID
layout(set = 0, binding = SURFACE_ID_IMAGE) uniform utexture2D surface_id;
#endif

#include "instance_transform.glsl"

const uint DEPTH_DEVICE = 1u;
const uint DEPTH_RAY_LENGTH = 2u;
const uint NORMAL_XYZ_UNORM = 1u;
const uint NORMAL_OCTAHEDRAL = 2u;
const uint NORMAL_OCTAHEDRAL_UNORM = 3u;
const uint MOTION_PIXELS = 0u;
const uint MOTION_UV = 1u;
const uint MOTION_DEPTH_NONE = 0u;
const uint MOTION_DEPTH_DIFFERENCE = 1u;

uint id_at(ivec2 p) {
#if SURFACE_ID
    return texelFetch(surface_id, host_pixel(SURFACE_ID_IMAGE, p), 0).x;
#else
    return 1u;
#endif
}

bool is_orthographic() { return frame.clip_from_view[2][3] == 0.0; }

// Scene units: squares of what is nearer, and sums of tolerances there, are 0.
const float NEAREST_DEPTH = 1e-30;

// Linear depth of a host's value, 0 for the background.
float depth_of(float d, uint id, ivec2 p) {
    float z = d;
    if (convention(DEPTH_SHIFT) == DEPTH_DEVICE) {
        mat4 clip = frame.clip_from_view;
        float denominator = clip[2][2] - d * clip[2][3];
        z = denominator == 0.0 ? 0.0 : abs((d * clip[3][3] - clip[3][2]) / denominator);
    }
    if (convention(DEPTH_SHIFT) == DEPTH_RAY_LENGTH) z = is_orthographic() ? d : d / length(view_position(p, 1.0));
    bool background = !is_finite(z) || z < NEAREST_DEPTH || z >= frame.background_depth || id == 0u;
    return background ? 0.0 : z;
}

vec3 decode_normal(vec3 v) {
    uint encoding = convention(NORMAL_SHIFT);
    if (encoding == NORMAL_XYZ_UNORM || encoding == NORMAL_OCTAHEDRAL_UNORM) v = v * 2.0 - 1.0;
    return encoding >= NORMAL_OCTAHEDRAL ? octahedral_direction(v.xy) : v;
}

vec3 world_normal(ivec2 p, bool background) {
    vec3 towards_camera = normalize(mat3(frame.world_from_view) * vec3(0.0, 0.0, -forward_sign()));
    vec3 n = decode_normal(texelFetch(normal, host_pixel(NORMAL, p), 0).xyz);
    if (has_convention(NORMAL_VIEW)) n = mat3(frame.world_from_view) * n;
    // Not finite either where a component is not, or is too large to be squared.
    float squared = dot(n, n);
    bool bad = !is_finite(squared);
    if (bad && !background) count_bad(BAD_NORMAL);
    return !bad && squared >= 1e-8 ? n * inversesqrt(squared) : towards_camera;
}

// The surface point of a pixel in world space seen from the eye, homogeneous. The background lies at infinity; orthographic lines of sight show the same
// at all depths.
vec4 world_point(ivec2 p, float z) {
    bool at_infinity = z == 0.0 && !is_orthographic();
    return frame.world_from_view * vec4(view_position(p, z == 0.0 ? 1.0 : z), at_infinity ? 0.0 : 1.0);
}

vec4 carry(vec4 world, uint id, inout vec3 n) {
#if SURFACE_ID
    vec4 rows[3], to;
    if (world.w == 0.0 || !instance_rows(id, rows)) return world;
    vec3 previous = turned(rows, n);
    float squared = dot(previous, previous);
    if (is_finite(squared) && squared >= 1e-8) n = previous * inversesqrt(squared);
    return carried(rows, world, to) ? to : world;
#else
    return world;
#endif
}

// Motion in pixels of the previous frame, from the host's image. False: there is none that can be used.
bool host_motion(ivec2 p, out vec3 m) {
    m = vec3(0.0);
    if (!is_present(MOTION)) return false;
    m = texelFetch(motion, host_pixel(MOTION, p), 0).xyz;
    bool bad = !is_finite(m.xy);
    if (bad) count_bad(BAD_MOTION);
    vec2 previous_extent = vec2(frame.previous_render_extent);
    uint unit = convention(MOTION_UNIT_SHIFT);
    vec2 ratio = extent_ratio(frame.render_extent, frame.previous_render_extent);
    vec2 scale = unit == MOTION_PIXELS ? ratio : unit == MOTION_UV ? previous_extent : previous_extent * 0.5;
    m.xy *= scale * frame.motion_scale;
    if (has_convention(MOTION_NEGATED)) m.xy = -m.xy;
    if (has_convention(MOTION_Y_UP)) m.y = -m.y;
    // A sample lies jitter beside its pixel's centre, so a rasterised position is the true one minus jitter.
    if (has_convention(MOTION_JITTERED)) m.xy += frame.previous_jitter - frame.jitter * ratio;
    return !bad;
}

// From the matrices: right for everything that stands still or has a transform.
vec2 matrix_motion(ivec2 p, vec4 previous_world) {
    vec4 clip = frame.previous_clip_from_world * previous_world;
    vec2 position = (clip.xy / clip.w * 0.5 + 0.5) * vec2(frame.previous_render_extent);
    vec2 current = (vec2(p) + 0.5 + frame.jitter) * extent_ratio(frame.render_extent, frame.previous_render_extent);
    vec2 m = position - current;
    return clip.w > 0.0 && is_finite(m) ? m : vec2(16384.0);
}

float previous_depth(vec4 previous_world, float z, bool from_host, float host_z) {
    uint kind = convention(MOTION_DEPTH_SHIFT);
    float previous = forward_sign() * (frame.previous_view_from_world * previous_world).z;
    if (kind != MOTION_DEPTH_NONE && from_host) previous = kind == MOTION_DEPTH_DIFFERENCE ? z + host_z : host_z;
    return is_finite(previous) && previous > 0.0 ? previous : z;
}

SurfaceMotion motion_of(ivec2 p, float z, uint id, vec3 n) {
    SurfaceMotion result = SurfaceMotion(vec2(0.0), 0.0, n);
    vec4 previous_world = carry(world_point(p, z), id, result.previous_normal);
    vec3 m;
    bool from_host = host_motion(p, m);
    result.motion = clamp(from_host ? m.xy : matrix_motion(p, previous_world), -16384.0, 16384.0);
    if (z != 0.0) result.depth_ratio = previous_depth(previous_world, z, from_host, m.z) / z - 1.0;
    return result;
}

// Of the two one-sided differences the smaller one, which does not look across an edge.
// The id of the pixel does for its neighbours: it says whether there is a surface, and the smaller difference keeps to it.
float gradient_along(ivec2 p, ivec2 axis, float z, uint id) {
    float best = 0.0;
    bool found = false;
    [[unroll]] for (int side = 1; side >= -1; side -= 2) {
        ivec2 q = p + axis * side, tap = is_inside(q) ? q : p;
        float z_q = depth_of(texelFetch(depth, host_pixel(DEPTH, tap), 0).x, id, tap);
        float difference = (z_q - z) * float(side);
        bool nearer = q == tap && z_q > 0.0 && (!found || abs(difference) < abs(best));
        best = nearer ? difference : best;
        found = found || nearer;
    }
    return clamp(best, -65504.0, 65504.0);
}

bool is_dark_at(ivec2 p) { return is_present(ALBEDO) && darkness_of(reflectance_of(texelFetch(albedo, host_pixel(ALBEDO, p), 0).rgb)) > 0.5; }

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (!is_inside(p)) return;
    uint id = id_at(p);
    float d = texelFetch(depth, host_pixel(DEPTH, p), 0).x;
    if (is_nan(d)) count_bad(BAD_DEPTH);
    float z = depth_of(d, id, p);
    bool background = z == 0.0;
    vec3 n = world_normal(p, background);
    float rough = is_present(ROUGHNESS) ? stored_roughness(texelFetch(roughness, host_pixel(ROUGHNESS, p), 0)) : 1.0;
    if (!background && !is_roughness(rough)) count_bad(BAD_ROUGHNESS);
    imageStore(guide, p, background ? uvec4(0u) : pack_guide(Guide(z, is_dark_at(p), n, roughness_of(rough), fold_id(id))).bits);
    uvec4 packed_motion = pack_surface_motion(motion_of(p, z, id, n));
    imageStore(surface_motion, p, background ? uvec4(packed_motion.xy, 0u, 0u) : packed_motion);
    vec2 gradient = vec2(gradient_along(p, ivec2(1, 0), z, id), gradient_along(p, ivec2(0, 1), z, id));
    imageStore(depth_gradient, p, uvec4(background ? 0u : packHalf2x16(gradient), 0u, 0u, 0u));
    if (!is_present(OBJECT_NORMAL) || !is_present(OBJECT_NORMAL_GUIDE)) return;
    vec3 o = texelFetch(object_normal, host_pixel(OBJECT_NORMAL, p), 0).xyz;
    float squared = dot(o, o);
    bool usable = is_finite(o) && is_finite(squared) && squared >= 1e-8;
    imageStore(object_normal_guide, p, uvec4(pack_octahedral(usable ? o * inversesqrt(squared) : vec3(0.0, 0.0, 1.0), 511.0, 10u), 0u, 0u, 0u));
}
