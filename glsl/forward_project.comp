#version 450
// Carries one pixel of every stratum of the previous frame to this frame, where the host shades it again with its surface and seed.
// Source: [ASVGF] 3.1, 3.3. Deviations: of several samples for a stratum the one with the largest key wins, not the first to arrive, so that the
// result does not depend on the order of execution; the host's G-buffer is not patched.
// In:  guide (current, previous), gradient_candidates of the previous frame; instance_transforms: previous from current world
//      space by surface_id; forward_motion at the pixels of the previous frame: xy to this frame, z linear depth in this frame.
// Out: claim (RESOLVE 0): gradient_claims. Resolve: gradient_samples, and gradient_candidates for the next frame.
// Constants: STRATUM_SIZE. FORWARD_MOTION is a set of bindings of its own, since no other image could stand in for forward_motion.
// optional: instance_transforms, surface_id
// variants: RESOLVE=0,FORWARD_MOTION=0 RESOLVE=0,FORWARD_MOTION=1 RESOLVE=1,FORWARD_MOTION=0 RESOLVE=1,FORWARD_MOTION=1
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(push_constant) uniform Push {
    uint present;
    float depth_tolerance;
} push;

#include "frame.glsl"
#include "viewport.glsl"
#include "conventions.glsl"
#include "optional.glsl"
#include "statistics.glsl"
#include "guide.glsl"
#include "strata.glsl"
#include "forward_projection.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

const uint FORWARD_MOTION_IMAGE = 11u;
const uint INSTANCE_TRANSFORMS = 6u;

layout(set = 0, binding = 2) uniform utexture2D guide;
layout(set = 0, binding = 3) uniform utexture2D previous_guide;
layout(set = 0, binding = 5) uniform utexture2D previous_candidates;
layout(set = 0, binding = INSTANCE_TRANSFORMS, std430) readonly buffer InstanceTransforms { vec4 rows[]; } instance_transforms;
#if RESOLVE
const uint SURFACE_ID = 10u;

layout(set = 0, binding = 7) uniform utexture2D claims;
layout(set = 0, binding = 8, rgba16ui) uniform writeonly uimage2D gradient_samples;
layout(set = 0, binding = 9, rgba16ui) uniform writeonly uimage2D candidates;
layout(set = 0, binding = SURFACE_ID) uniform utexture2D surface_id;
#else
layout(set = 0, binding = 7, r32ui) uniform uimage2D claims;
#endif
#if FORWARD_MOTION
layout(set = 0, binding = FORWARD_MOTION_IMAGE) uniform texture2D forward_motion;
#endif

#include "instance_transform.glsl"

const uint MOTION_PIXELS = 0u;
const uint MOTION_UV = 1u;

// Candidates and keys are drawn apart: what is picked in one frame must not rank it in the next.
const uint CANDIDATE_SALT = 0x9e3779b9u;

// Low bits of a key: 1 + number of the stratum in the previous frame. The bits above are a hash, so that no direction is preferred.
uint key_mask() {
    uvec2 strata = strata_of(frame.previous_render_extent);
    return (2u << findMSB(strata.x * strata.y)) - 1u;
}

uint key_of(uint index) {
    uint mask = key_mask();
    return (pcg(index + pcg(frame.frame_index)) & ~mask) | (index + 1u);
}

// The host's forward motion of a pixel. 0: there is none; 1: used; 2: not finite.
uint host_position(ivec2 j, out ForwardPosition position) {
    position = ForwardPosition(vec2(0.0), vec2(0.0), 0.0, 0.0);
#if FORWARD_MOTION
    vec3 v = texelFetch(forward_motion, host_pixel(FORWARD_MOTION_IMAGE, j), 0).xyz;
    if (!is_finite(v)) return 2u;
    if (v.z <= 0.0) return 0u;
    vec2 extent = vec2(frame.render_extent), previous_extent = vec2(frame.previous_render_extent);
    uint unit = convention(MOTION_UNIT_SHIFT);
    precise vec2 scale = (unit == MOTION_PIXELS ? vec2(1.0) : unit == MOTION_UV ? extent : extent * 0.5) * frame.motion_scale;
    precise vec2 m = v.xy * scale;
    if (has_convention(MOTION_Y_UP)) m.y = -m.y;
    precise vec2 start = (vec2(j) + 0.5) + frame.previous_jitter;
    precise vec2 move = m - frame.jitter;
    precise vec2 numerator = start * extent;
    numerator = numerator + move * previous_extent;
    position = ForwardPosition(numerator, previous_extent, v.z, 1.0);
    return 1u;
#else
    return 0u;
#endif
}

// From the matrices, and the transform of the pixel's instance where there is one.
bool carried_position(ivec2 j, float z, uint id, out ForwardPosition position) {
    vec4 world = previous_world_position(j, z);
    vec4 rows[3], current;
    if (instance_rows(id, rows)) {
        if (!invert_transform(rows, world, current)) {
            position = ForwardPosition(vec2(0.0), vec2(0.0), 0.0, 0.0);
            return false;
        }
        world = current;
    }
    position = project_world(world);
    return true;
}

// The candidate of a stratum of the previous frame, in this frame. False: it is gone.
bool project_candidate(uint index, out ivec2 previous_pixel, out ivec2 pixel) {
    uint width = strata_of(frame.previous_render_extent).x;
    uvec4 candidate = texelFetch(previous_candidates, ivec2(index % width, index / width), 0);
    previous_pixel = ivec2(candidate.xy);
    pixel = ivec2(0);
    if (candidate.x == NO_PIXEL) return false;
    GuideBits packed = GuideBits(texelFetch(previous_guide, previous_pixel, 0));
    float z = guide_depth(packed);
    if (z == 0.0) return false;
    ForwardPosition position;
    uint host = host_position(previous_pixel, position);
#if !RESOLVE
    if (host == 2u) count_bad(BAD_FORWARD_MOTION);
#endif
    if (host == 2u) return false;
    if (host == 0u && !carried_position(previous_pixel, z, candidate.z | candidate.w << 16, position)) return false;
    if (!covering_pixel(position, pixel)) return false;
    GuideBits now = GuideBits(texelFetch(guide, pixel, 0));
    float z_now = guide_depth(now);
    if (z_now == 0.0 || guide_id(now) != guide_id(packed)) return false;
    return is_visible(position, z_now, guide_gradient(now), push.depth_tolerance);
}

#if RESOLVE
// One pixel of the stratum for the next frame, any but the place that is a gradient sample in this one.
uvec4 next_candidate(ivec2 s, uint taken) {
    uvec2 extent = stratum_extent(s);
    uint width = strata_of(frame.render_extent).x;
    // The taken place as a number among the pixels that exist.
    bool is_taken = taken != NO_PIXEL;
    uint skipped = is_taken ? taken % STRATUM_SIZE + taken / STRATUM_SIZE * extent.x : NO_PIXEL;
    uint count = extent.x * extent.y - (is_taken ? 1u : 0u);
    if (count == 0u) return uvec4(NO_PIXEL, NO_PIXEL, 0u, 0u);
    uint chosen = pcg(uint(s.x) + uint(s.y) * width + pcg(frame.frame_index + CANDIDATE_SALT)) % count;
    if (chosen >= skipped) ++chosen;
    ivec2 pixel = first_pixel(s) + ivec2(chosen % extent.x, chosen / extent.x);
    uint id = is_present(SURFACE_ID) ? texelFetch(surface_id, host_pixel(SURFACE_ID, guide_pixel(pixel)), 0).x : 0xffffffffu;
    return uvec4(uvec2(pixel), id & 0xffffu, id >> 16);
}

void main() {
    ivec2 s = ivec2(gl_GlobalInvocationID.xy);
    if (!is_stratum(s)) return;
    uint key = texelFetch(claims, s, 0).x;
    ivec2 previous_pixel, pixel;
    uint place = NO_PIXEL;
    uvec4 result = uvec4(0u);
    if (key != 0u && project_candidate((key & key_mask()) - 1u, previous_pixel, pixel)) {
        ivec2 offset = pixel - first_pixel(s);
        place = uint(offset.x) + uint(offset.y) * STRATUM_SIZE;
        result = pack_gradient_sample(previous_pixel, place);
    }
    imageStore(gradient_samples, s, result);
    imageStore(candidates, s, next_candidate(s, place));
}
#else
void main() {
    uvec2 s = gl_GlobalInvocationID.xy;
    uvec2 strata = strata_of(frame.previous_render_extent);
    if (has_flag(FLAG_RESET) || any(greaterThanEqual(s, strata))) return;
    uint index = s.x + s.y * strata.x;
    ivec2 previous_pixel, pixel;
    if (!project_candidate(index, previous_pixel, pixel)) return;
    imageAtomicMax(claims, pixel / int(STRATUM_SIZE), key_of(index));
}
#endif
