// Where the surface of a pixel of the previous frame is in this one. Twin: src/reference/forward_projection.rs, equal to the bit.
// To that end nothing rests on a quotient, whose precision a device may choose: positions stay homogeneous, `precise` forbids fused
// operations, and a pixel is found by comparing products, which are rounded correctly everywhere.
#ifndef FORWARD_PROJECTION_GLSL
#define FORWARD_PROJECTION_GLSL
#include "frame.glsl"
#include "finite.glsl"

// A position in this frame: pixels are numerator / denominator, linear depth is depth / depth_denominator.
struct ForwardPosition {
    vec2 numerator;
    vec2 denominator;
    float depth;
    float depth_denominator;
};

float product_sum(vec4 a, vec4 b) {
    precise float sum = a.x * b.x;
    sum = sum + a.y * b.y;
    sum = sum + a.z * b.z;
    sum = sum + a.w * b.w;
    return sum;
}

vec4 row_of(mat4 m, int i) { return vec4(m[0][i], m[1][i], m[2][i], m[3][i]); }

vec3 cross_precise(vec3 a, vec3 b) {
    precise float x = a.y * b.z - a.z * b.y;
    precise float y = a.z * b.x - a.x * b.z;
    precise float z = a.x * b.y - a.y * b.x;
    return vec3(x, y, z);
}

vec4 previous_world_position(ivec2 pixel, float linear_depth) {
    precise float w = frame.previous_clip_w_scale * linear_depth + frame.previous_clip_w_offset;
    precise float x = (float(pixel.x) + 0.5) * w;
    precise float y = (float(pixel.y) + 0.5) * w;
    vec4 place = vec4(x, y, linear_depth, 1.0);
    mat4 m = frame.world_from_previous_sample;
    return vec4(product_sum(row_of(m, 0), place), product_sum(row_of(m, 1), place), product_sum(row_of(m, 2), place), 1.0);
}

// The inverse of `previous = rows * current` by its adjugate: homogeneous, w is the determinant. False: there is none.
bool invert_transform(vec4 rows[3], vec4 previous, out vec4 current) {
    vec3 yz = cross_precise(rows[1].xyz, rows[2].xyz);
    vec3 zx = cross_precise(rows[2].xyz, rows[0].xyz);
    vec3 xy = cross_precise(rows[0].xyz, rows[1].xyz);
    precise vec3 d = previous.xyz - vec3(rows[0].w, rows[1].w, rows[2].w);
    precise float determinant = rows[0].x * yz.x;
    determinant = determinant + rows[0].y * yz.y;
    determinant = determinant + rows[0].z * yz.z;
    precise vec3 position = yz * d.x;
    position = position + zx * d.y;
    position = position + xy * d.z;
    current = vec4(position, determinant);
    if (determinant < 0.0) current = -current;
    return current.w >= 1e-20 && is_finite(current);
}

ForwardPosition project_world(vec4 world) {
    mat4 m = frame.sample_from_world;
    vec2 numerator = vec2(product_sum(row_of(m, 0), world), product_sum(row_of(m, 1), world));
    return ForwardPosition(numerator, vec2(product_sum(row_of(m, 3), world)), product_sum(row_of(m, 2), world), world.w);
}

// The largest q with q·denominator <= numerator.
int floor_quotient(float numerator, float denominator) {
    float q = floor(numerator / denominator);
    precise float above = (q + 1.0) * denominator;
    if (above <= numerator) return int(q) + 1;
    precise float at = q * denominator;
    return at > numerator ? int(q) - 1 : int(q);
}

// The pixel of this frame that covers a position. False: off screen, behind the camera, or not finite.
bool covering_pixel(ForwardPosition position, out ivec2 pixel) {
    pixel = ivec2(0);
    for (int i = 0; i < 2; ++i) {
        float numerator = position.numerator[i], denominator = position.denominator[i];
        if (!is_finite(numerator) || !is_finite(denominator) || !(denominator > 0.0)) return false;
        precise float end = float(frame.render_extent[i]) * denominator;
        if (!(numerator >= 0.0) || !(numerator < end)) return false;
        pixel[i] = floor_quotient(numerator, denominator);
    }
    return true;
}

// Whether a surface of this frame at linear depth z is the one at the position; the tolerance is a share of z.
bool is_visible(ForwardPosition position, float z, vec2 depth_gradient, float depth_tolerance) {
    precise float at = z * position.depth_denominator;
    precise float difference = at - position.depth;
    precise float slope = abs(depth_gradient.x) + abs(depth_gradient.y);
    precise float tolerance = depth_tolerance * z;
    tolerance = tolerance + slope;
    precise float limit = tolerance * position.depth_denominator;
    return abs(difference) <= limit;
}

#endif
