#version 450
// Motion of what a volume scatters towards the camera: its points of the previous frame, carried forward to this one.
// Source: [PSVGF], volumes. Deviations: of several points in a pixel the one that contributes most wins, whatever the order of execution; the
// motion is the mean over 3x3 pixels, since a single point is anywhere along its ray.
// In:  volume_points of the previous frame; claim (RESOLVE 0): guide, which hides points; resolve: surface_motion, for pixels without a point.
// Out: claim: volume_claims. Resolve: volume_motion, half2, pixels of the previous frame.
// variants: RESOLVE=0 RESOLVE=1
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "guide.glsl"
#include "volume_point.glsl"
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

// Low bits of a key: the number of the pixel in the previous frame. No device has images of more than 2^30 pixels.
uint number_bits() { return uint(findMSB(frame.previous_render_extent.x * frame.previous_render_extent.y - 1u) + 1); }

// The numbers are mixed, so that no direction always wins among points that contribute alike: a shift by half of the bits and a product
// with an odd number can be undone.
const uint ODD = 0x9e3779b1u;
const uint ODD_INVERSE = 0x0e8b2f51u;

uint mixed(uint index) {
    uint bits = number_bits(), mask = (1u << bits) - 1u, half_of_bits = (bits + 1u) / 2u;
    uint x = (index + pcg(frame.frame_index)) & mask;
    x = ((x ^ x >> half_of_bits) * ODD) & mask;
    return x ^ x >> half_of_bits;
}

uint unmixed(uint x) {
    uint bits = number_bits(), mask = (1u << bits) - 1u, half_of_bits = (bits + 1u) / 2u;
    x = ((x ^ x >> half_of_bits) * ODD_INVERSE) & mask;
    return ((x ^ x >> half_of_bits) - pcg(frame.frame_index)) & mask;
}

// The bits above: the contribution from 2^-16 to 2^16, in 12 bits 128 steps for a factor of 2, or as much of them as there is room for.
const uint RANK_BITS = 12u;
const int LEAST_CONTRIBUTION = (127 - 16) << 7;

uint key_of(ivec2 q, uint contribution) {
    uint room = 32u - number_bits();
    uint rank = uint(clamp(int(contribution) - LEAST_CONTRIBUTION, 0, (1 << RANK_BITS) - 1)) >> (RANK_BITS - min(room, RANK_BITS));
    return max(rank, 1u) << number_bits() | mixed(uint(q.x) + uint(q.y) * frame.previous_render_extent.x);
}

ForwardPosition carried(ivec2 q, PointBits point) { return project_world(previous_world_position(q, point_depth(point))); }

#if RESOLVE
// Steps of a pixel in which a motion is found. By comparison of products as all of the projection, so that no device rounds it otherwise.
const float STEPS = 64.0;

int nearest_quotient(float numerator, float denominator) {
    precise float shifted = numerator + 0.5 * denominator;
    return floor_quotient(shifted, denominator);
}

// Motion that a point had from q to its position in this frame, unjittered: the nearest step on one axis.
int motion_steps(ivec2 q, ForwardPosition position, int axis) {
    float w = position.denominator[axis], side = float(frame.render_extent[axis]);
    precise float before = ((float(q[axis]) + 0.5) + frame.previous_jitter[axis]) * side;
    before = before * w;
    precise float now = position.numerator[axis] + frame.jitter[axis] * w;
    now = now * float(frame.previous_render_extent[axis]);
    precise float denominator = side * w;
    precise float numerator = (before - now) * STEPS;
    return nearest_quotient(numerator, denominator);
}

// Exact as a half float: of a longer motion the low bits are cut.
float representable(int steps) {
    int magnitude = abs(steps);
    int excess = max(findMSB(magnitude) - 10, 0);
    return float(sign(steps) * (magnitude >> excess << excess)) / STEPS;
}

// A black point counts next to nothing, but more than none.
const float SMALLEST_LUMINANCE = 1.0 / 1048576.0;
const float LARGEST_DEPTH = 1.0e6;

// Adds the point that won a pixel. Motion falls with depth, so its mean with the weight luminance * depth is the motion at the mean depth,
// in proportion to luminance; points just before the camera move far and would spoil any other mean.
void add_point(uint key, inout vec2 sum, inout float weight_sum) {
    uint index = unmixed(key & ((1u << number_bits()) - 1u));
    ivec2 q = ivec2(index % frame.previous_render_extent.x, index / frame.previous_render_extent.x);
    PointBits point = PointBits(texelFetch(previous_points, q, 0));
    ForwardPosition position = carried(q, point);
    precise float weight = max(uintBitsToFloat(point_contribution(point) << 16), SMALLEST_LUMINANCE) * min(point_depth(point), LARGEST_DEPTH);
    precise vec2 part = vec2(motion_steps(q, position, 0), motion_steps(q, position, 1)) * weight;
    precise vec2 total = sum + part;
    precise float weight_total = weight_sum + weight;
    sum = total;
    weight_sum = weight_total;
}

uint motion_at(ivec2 p) {
    vec2 sum = vec2(0.0);
    float weight_sum = 0.0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            ivec2 at = p + ivec2(x, y);
            uint key = is_inside(at) ? texelFetch(claims, at, 0).x : 0u;
            if (key != 0u) add_point(key, sum, weight_sum);
        }
    if (weight_sum == 0.0) {
        uvec2 motion = texelFetch(surface_motion, p, 0).xy;
        return motion.x | motion.y << 16;
    }
    return packHalf2x16(vec2(representable(nearest_quotient(sum.x, weight_sum)), representable(nearest_quotient(sum.y, weight_sum))));
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
    PointBits point = PointBits(texelFetch(previous_points, q, 0));
    if (point_depth(point) == 0.0) return;
    ForwardPosition position = carried(q, point);
    ivec2 p;
    if (!covering_pixel(position, p)) return;
    if (!is_hidden(position, guide_depth(GuideBits(texelFetch(guide, p, 0))))) imageAtomicMax(claims, p, key_of(q, point_contribution(point)));
}
#endif
