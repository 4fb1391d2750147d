// Strata: blocks of STRATUM_SIZE x STRATUM_SIZE pixels, each with at most one gradient sample. Twin: src/reference/strata.rs.
#ifndef STRATA_GLSL
#define STRATA_GLSL
#include "frame.glsl"

layout(constant_id = 8) const uint STRATUM_SIZE = 3u;  // pixels a side, 2 to 4; in clear_claims.comp 1 as well

const uint NO_PIXEL = 0xffffu;  // a coordinate of a candidate that does not exist

uvec2 strata_of(uvec2 extent) { return (extent + STRATUM_SIZE - 1u) / STRATUM_SIZE; }

bool is_stratum(ivec2 s) { return all(greaterThanEqual(s, ivec2(0))) && all(lessThan(uvec2(s), strata_of(frame.render_extent))); }

ivec2 first_pixel(ivec2 s) { return s * int(STRATUM_SIZE); }

// Pixels of a stratum that exist: those at the right and lower border may be cut.
uvec2 stratum_extent(ivec2 s) { return min(uvec2(STRATUM_SIZE), frame.render_extent - uvec2(first_pixel(s))); }

// A place in a stratum: row by row, 0 to 15.
ivec2 pixel_at(ivec2 s, uint place) {
    return first_pixel(s) + ivec2(place % STRATUM_SIZE, place / STRATUM_SIZE);
}

// A texel of gradient_samples. z is 0 where a stratum has none.
struct GradientSample {
    ivec2 previous_pixel;
    uint place;
    bool valid;
};

GradientSample unpack_gradient_samples(uvec4 packed) {
    return GradientSample(ivec2(packed.xy), packed.z - 1u, packed.z != 0u);
}

uvec4 pack_gradient_sample(ivec2 previous_pixel, uint place) { return uvec4(uvec2(previous_pixel), place + 1u, 0u); }

#endif
