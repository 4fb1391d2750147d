#version 450
// Motion of what a volume scatters towards the camera: its points of the previous frame, carried forward to this one.
// Source: [PSVGF], volumes. Deviation: of several points in a pixel the one that contributes most wins, whatever the order of execution.
// In:  volume_points of the previous frame; claim (RESOLVE 0): guide, which hides points; resolve: surface_motion, for pixels without a point.
// Out: claim: volume_claims. Resolve: volume_motion, half2, pixels of the previous frame.
// variants: RESOLVE=0 RESOLVE=1
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "guide.glsl"
#include "forward_projection.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 1) uniform utexture2D previous_points;
#if RESOLVE
layout(set = 0, binding = 2) uniform utexture2D surface_motion;
layout(set = 0, binding = 3) uniform utexture2D claims;
layout(set = 0, binding = 4, r32ui) uniform writeonly uimage2D volume_motion;
#else
layout(set = 0, binding = 2) uniform utexture2D guide;
layout(set = 0, binding = 3, r32ui) uniform uimage2D claims;
#endif

// Low bits of a key: 1 + number of the pixel in the previous frame. The bits above are those of the contribution that have room.
uint key_mask() { return (2u << findMSB(frame.previous_render_extent.x * frame.previous_render_extent.y)) - 1u; }

uint key_of(ivec2 q, uint contribution) {
    uint index = uint(q.x) + uint(q.y) * frame.previous_render_extent.x;
    return (contribution << 17 & ~key_mask()) | (index + 1u);
}

ForwardPosition carried(ivec2 q, uvec4 point) { return project_world(previous_world_position(q, unpack_depth(point))); }

#if RESOLVE
// Steps of a pixel in which a motion is found. By comparison of products as all of the projection, so that no device rounds it otherwise.
const float STEPS = 64.0;

// Motion that a point had from q to its position in this frame, unjittered: the nearest step on one axis.
int motion_steps(ivec2 q, ForwardPosition position, int axis) {
    float w = position.denominator[axis], side = float(frame.render_extent[axis]);
    precise float before = ((float(q[axis]) + 0.5) + frame.previous_jitter[axis]) * side;
    before = before * w;
    precise float now = position.numerator[axis] + frame.jitter[axis] * w;
    now = now * float(frame.previous_render_extent[axis]);
    precise float denominator = side * w;
    precise float numerator = (before - now) * STEPS;
    numerator = numerator + 0.5 * denominator;
    return floor_quotient(numerator, denominator);
}

// Exact as a half float: of a longer motion the low bits are cut.
float representable(int steps) {
    int magnitude = abs(steps);
    int excess = max(findMSB(magnitude) - 10, 0);
    return float(sign(steps) * (magnitude >> excess << excess)) / STEPS;
}

uint motion_at(ivec2 p) {
    uint key = texelFetch(claims, p, 0).x;
    if (key == 0u) {
        uvec2 motion = texelFetch(surface_motion, p, 0).xy;
        return motion.x | motion.y << 16;
    }
    uint index = (key & key_mask()) - 1u;
    ivec2 q = ivec2(index % frame.previous_render_extent.x, index / frame.previous_render_extent.x);
    ForwardPosition position = carried(q, texelFetch(previous_points, q, 0));
    return packHalf2x16(vec2(representable(motion_steps(q, position, 0)), representable(motion_steps(q, position, 1))));
}

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (is_inside(p)) imageStore(volume_motion, p, uvec4(motion_at(p)));
}
#else
// Whether the surface of a pixel lies before the point.
bool is_hidden(ForwardPosition position, float z) {
    precise float limit = z * position.depth_denominator;
    return z != 0.0 && position.depth > limit;
}

void main() {
    ivec2 q = ivec2(gl_GlobalInvocationID.xy);
    if (has_flag(FLAG_RESET) || !is_inside_previous(q)) return;
    uvec4 point = texelFetch(previous_points, q, 0);
    if (unpack_depth(point) == 0.0) return;
    ForwardPosition position = carried(q, point);
    ivec2 p;
    if (!covering_pixel(position, p)) return;
    if (!is_hidden(position, unpack_depth(texelFetch(guide, p, 0)))) imageAtomicMax(claims, p, key_of(q, point.z));
}
#endif
