#version 450
// Turns the host's guides into one packed encoding, and stops values that are not finite.
// Where light has fewer pixels than the guides, for each pixel of it: of the pixel that it was traced for.
// Source: the encodings are the host's (Conventions); the depth gradient is that of [SVGF] eq. 3.
// In:  depth, normal, motion, roughness, surface_id, object_normal as the host encodes them; albedo;
//      instance_transforms: previous from current world space by surface_id, three rows of four.
// Out: guide, surface_motion, object_normal_guide (docs/specification/packed_images.md).
// SURFACE_ID and OBJECT_NORMALS are sets of bindings of their own, since no other image could stand in for surface_id and object_normal_guide.
// optional: albedo, motion, roughness, instance_transforms
// variants: SURFACE_ID=0,OBJECT_NORMALS=0 SURFACE_ID=1,OBJECT_NORMALS=0 SURFACE_ID=0,OBJECT_NORMALS=1 SURFACE_ID=1,OBJECT_NORMALS=1
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
#if OBJECT_NORMALS
layout(set = 0, binding = OBJECT_NORMAL) uniform texture2D object_normal;
layout(set = 0, binding = 11, r32ui) uniform writeonly uimage2D object_normal_guide;
#endif
#if SURFACE_ID
layout(set = 0, binding = SURFACE_ID_IMAGE) uniform utexture2D surface_id;
#endif

#include "surface_id.glsl"
#include "host_motion.glsl"
#include "host_normal.glsl"

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
    return best;
}

void main() {
    ivec2 to = ivec2(gl_GlobalInvocationID.xy), p = to * ivec2(frame.light_ratio) + ivec2(frame.light_offset);
    if (any(greaterThanEqual(to, ivec2(frame.guide_extent / frame.light_ratio)))) return;
    // Pixels of light for each of the guides.
    vec2 side = mix(vec2(1.0), vec2(0.5), equal(frame.light_ratio, uvec2(2u)));
    uint id = id_at(p);
    float d = texelFetch(depth, host_pixel(DEPTH, p), 0).x;
    if (is_nan(d)) count_bad(BAD_DEPTH);
    float z = depth_of(d, id, p);
    bool background = z == 0.0, bad_normal;
    vec3 n = world_normal(p, bad_normal);
    if (bad_normal && !background) count_bad(BAD_NORMAL);
    float rough = is_present(ROUGHNESS) ? stored_roughness(texelFetch(roughness, host_pixel(ROUGHNESS, p), 0)) : 1.0;
    if (!background && !is_roughness(rough)) count_bad(BAD_ROUGHNESS);
    SurfaceMotion moved = motion_of(p, z, id, n);
    moved.motion *= side;
    uvec4 packed_motion = pack_surface_motion(moved);
    imageStore(surface_motion, to, background ? uvec4(packed_motion.xy, 0u, 0u) : packed_motion);
    bool apart = is_present(ALBEDO) && is_apart(texelFetch(albedo, host_pixel(ALBEDO, p), 0).rgb);
    vec2 gradient = vec2(gradient_along(p, ivec2(1, 0), z, id), gradient_along(p, ivec2(0, 1), z, id)) * vec2(frame.light_ratio);
    imageStore(guide, to, background ? uvec4(0u) : pack_guide(Guide(z, apart, n, gradient, fold_id(id))).bits);
#if OBJECT_NORMALS
    vec3 o = texelFetch(object_normal, host_pixel(OBJECT_NORMAL, p), 0).xyz;
    float squared = dot(o, o);
    bool usable = is_finite(o) && is_finite(squared) && squared >= 1e-8;
    imageStore(object_normal_guide, to, uvec4(pack_octahedral(usable ? o * inversesqrt(squared) : vec3(0.0, 0.0, 1.0), 511.0, 10u), 0u, 0u, 0u));
#endif
}
