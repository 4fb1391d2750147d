// By how much the light of a pixel is brighter than in the frame before, by the image light_ratio at the binding LIGHT_RATIO. Twin:
// src/nodes/temporal_accumulation/twin/light.rs.
#ifndef RATIO_AT_PIXEL_GLSL
#define RATIO_AT_PIXEL_GLSL
#include "frame.glsl"
#include "luminance.glsl"
#include "strata.glsl"

// How much brighter each component of the light is than in the frame before, smooth between strata.
vec3 light_ratio_at(ivec2 p) {
    if (!is_present(LIGHT_RATIO)) return vec3(1.0);
    vec2 position = (vec2(p) + 0.5) / float(STRATUM_SIZE) - 0.5, corner = floor(position), f = position - corner;
    ivec2 last = ivec2(strata_of(frame.render_extent)) - 1;
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 offset = ivec2(i & 1, i >> 1);
        float weight = (offset.x == 1 ? f.x : 1.0 - f.x) * (offset.y == 1 ? f.y : 1.0 - f.y);
        vec4 ratio = texelFetch(light_ratio, clamp(ivec2(corner) + offset, ivec2(0), last), 0);
        // Strata of the background have none.
        if (ratio.a >= 0.0) sum += weight * vec4(ratio.rgb, 1.0);
    }
    return sum.a > 0.0 ? sum.rgb / sum.a : vec3(1.0);
}

// The factor of luminance by which light changed.
float light_scale(vec3 ratio) {
    return is_present(LIGHT_RATIO) ? min(frame.exposure_ratio * luminance(ratio), 1e38) : frame.exposure_ratio;
}

#endif
