#version 450
// One level of the edge-avoiding à-trous wavelet transform by radiance, normal and position: one frame is enough.
// Source: [EAW] eq. 2 to 5 and the listing, 3.2 for holes. Deviations: sigma of the position is relative to the depth; equal kernel
// weights where no valid tap passes the edge functions, so that no hole is left.
// In:  guide, irradiance per signal, alpha -1 in holes. Out: the same after this level.
// Constants: RADIANCE, NORMAL, POSITION: which edges count. SAMPLING: levels that fill the holes of a sub-sampled input; 0 where it
// has none.
// variants: SIGNALS=1 SIGNALS=2
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "guide.glsl"
#include "luminance.glsl"
#include "packed_image.glsl"
#include "view_position.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 1) const bool RADIANCE = true;
layout(constant_id = 2) const bool NORMAL = true;
layout(constant_id = 3) const bool POSITION = true;
layout(constant_id = 4) const uint SAMPLING = 0u;

layout(push_constant) uniform Push {
    uint level;
    float eaw_sigma_radiance;
    float eaw_sigma_normal;
    float eaw_sigma_position;
} push;

PACKED_IMAGE(1, guide);
layout(set = 0, binding = 2, rgba16f) uniform restrict readonly image2D input_0;
layout(set = 0, binding = 3, rgba16f) uniform writeonly image2D output_0;
#if SIGNALS == 2
layout(set = 0, binding = 4, rgba16f) uniform restrict readonly image2D input_1;
layout(set = 0, binding = 5, rgba16f) uniform writeonly image2D output_1;
#endif

// A negative power of e that is 0.
const float REFUSED = 1e4;
const float KERNEL[3] = float[](3.0 / 8.0, 1.0 / 4.0, 1.0 / 16.0);

struct Sum {
    vec3 irradiance;
    float weight;
    vec3 plain;  // without edge functions, for holes that see nothing of their kind
    float plain_weight;
};

struct Level {
    float inverse_sigma_radiance;  // squared; 0 while there are holes
    float inverse_sigma_normal;   // squared, in steps of the normal
    float inverse_sigma_position;
};

Level level_of(float z) {
    float step_squared = exp2(2.0 * float(push.level));
    Level level;
    bool holes_left = push.level < SAMPLING;
    float sigma_radiance = push.eaw_sigma_radiance * frame.filter_exposure;
    level.inverse_sigma_radiance = RADIANCE && !holes_left ? step_squared / (sigma_radiance * sigma_radiance) : 0.0;
    float sigma_normal = push.eaw_sigma_normal * NORMAL_STEPS;
    level.inverse_sigma_normal = NORMAL ? 1.0 / (step_squared * sigma_normal * sigma_normal) : 0.0;
    level.inverse_sigma_position = POSITION ? 1.0 / (push.eaw_sigma_position * max(z, 1e-15)) : 0.0;
    return level;
}

float squared(vec3 v) { return dot(v, v); }

void add_tap(inout Sum sum, vec4 value, vec4 centre, float exponent, float kernel, float inverse_sigma_radiance) {
    kernel = value.a < 0.0 ? 0.0 : kernel;
    // A hole has no radiance to compare with.
    float radiance = centre.a < 0.0 ? 0.0 : squared(value.rgb - centre.rgb) * inverse_sigma_radiance;
    float weight = kernel * exp(-exponent - radiance);
    sum.irradiance += weight * value.rgb;
    sum.weight += weight;
    float plain = centre.a < 0.0 ? kernel : 0.0;
    sum.plain += plain * value.rgb;
    sum.plain_weight += plain;
}

// The background passes, but for its holes.
vec4 result(Sum sum, vec4 centre, bool background) {
    if (background && centre.a >= 0.0) return centre;
    if (sum.weight >= 1e-6) return vec4(storable(sum.irradiance / sum.weight), 0.0);
    return sum.plain_weight > 0.0 ? vec4(storable(sum.plain / sum.plain_weight), 0.0) : centre;
}

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (!is_inside(p)) return;
    vec4 centre_0 = imageLoad(input_0, p);
    bool hole = centre_0.a < 0.0;
#if SIGNALS == 2
    vec4 centre_1 = imageLoad(input_1, p);
    hole = hole || centre_1.a < 0.0;
#endif
    GuideBits packed = GuideBits(packed_at(guide, p));
    float z = guide_depth(packed);
    bool background = z == 0.0;
    if (background && !hole) {
        imageStore(output_0, p, centre_0);
#if SIGNALS == 2
        imageStore(output_1, p, centre_1);
#endif
        return;
    }
    vec3 n = guide_normal_steps(packed), x = view_position(p, z);
    Level level = level_of(z);
    Sum sum_0 = Sum(vec3(0.0), 0.0, vec3(0.0), 0.0), sum_1 = sum_0;
    int step_size = 1 << push.level;
    [[unroll]] for (int j = -2; j <= 2; ++j)
        [[unroll]] for (int i = -2; i <= 2; ++i) {
            ivec2 q = p + ivec2(i, j) * step_size, tap = nearest_inside(q);
            GuideBits packed_q = GuideBits(packed_at(guide, tap));
            float z_q = guide_depth(packed_q);
            float exponent = squared(n - guide_normal_steps(packed_q)) * level.inverse_sigma_normal;
            exponent += squared((x - view_position(tap, z_q)) * level.inverse_sigma_position);
            exponent = background ? 0.0 : guide_is_apart(packed_q) == guide_is_apart(packed) ? exponent : REFUSED;
            float kernel = q == tap && (z_q == 0.0) == background ? KERNEL[abs(i)] * KERNEL[abs(j)] : 0.0;
            add_tap(sum_0, imageLoad(input_0, tap), centre_0, exponent, kernel, background ? 0.0 : level.inverse_sigma_radiance);
#if SIGNALS == 2
            add_tap(sum_1, imageLoad(input_1, tap), centre_1, exponent, kernel, background ? 0.0 : level.inverse_sigma_radiance);
#endif
        }
    imageStore(output_0, p, result(sum_0, centre_0, background));
#if SIGNALS == 2
    imageStore(output_1, p, result(sum_1, centre_1, background));
#endif
}
