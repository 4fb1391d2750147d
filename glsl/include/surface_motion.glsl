// Where a pixel's surface was in the previous frame. Bits: docs/specification/packed_images.md. Twin: src/reference/surface_motion.rs.
#ifndef SURFACE_MOTION_GLSL
#define SURFACE_MOTION_GLSL
#include "guide.glsl"

struct SurfaceMotion {
    vec2 motion;          // pixels of the previous frame
    float depth_ratio;    // previous linear depth / linear depth - 1
    vec3 previous_normal; // world space of the previous frame
};

uvec4 pack_surface_motion(SurfaceMotion m) {
    return uvec4(half_bits(m.motion.x), half_bits(m.motion.y), half_bits(clamp(m.depth_ratio, -1.0, 65504.0)),
                 pack_octahedral(m.previous_normal, 127.0, 8u));
}

SurfaceMotion unpack_surface_motion(uvec4 packed) {
    return SurfaceMotion(vec2(half_value(packed.x), half_value(packed.y)), half_value(packed.z),
                         unpack_octahedral(packed.w, 127.0, 8u));
}

// Pixels of the previous frame per pixel of this one. Devices may round the quotient of equal numbers to something beside 1, and what stands
// still would be resampled in every frame.
vec2 extent_ratio(uvec2 extent, uvec2 previous_extent) {
    return mix(vec2(previous_extent) / vec2(extent), vec2(1.0), equal(extent, previous_extent));
}

// Position in the previous frame, pixels; pixel centres lie at +0.5.
vec2 previous_position(ivec2 p, vec2 motion, uvec2 extent, uvec2 previous_extent) {
    return (vec2(p) + 0.5) * extent_ratio(extent, previous_extent) + motion;
}

#endif
