#version 450
// One iteration of the reconstruction of the temporal gradient: strata without a sample take it from their surroundings, noise goes.
// Source: [ASVGF] 3.4, eq. 7 to 12. Deviation: a standard deviation is stored, not the variance.
// In:  gradient_guide, depth_gradient; δ, Δ, mean and deviation of luminance per stratum. Out: the same after this iteration.
// Constants: STRATUM_SIZE.
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(push_constant) uniform Push {
    uint level;
    float sigma_l;
    float sigma_n;
    float sigma_z;
    float edge_falloff;
} push;

#include "frame.glsl"
#include "geometry_weights.glsl"
#include "strata.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

// Storage images are read, not sampled ones, as in atrous.comp.
layout(set = 0, binding = 1, rgba16ui) uniform restrict readonly uimage2D gradient_guide;
layout(set = 0, binding = 2) uniform utexture2D depth_gradient;
layout(set = 0, binding = 3, rgba16f) uniform restrict readonly image2D gradient_in;
layout(set = 0, binding = 4, rgba16f) uniform writeonly image2D gradient_out;

const float LUMINANCE_EPSILON = 1e-4;

ivec2 pixel_of(ivec2 s, uvec4 packed) { return pixel_at(s, packed.x & 0xfu); }

void main() {
    ivec2 s = ivec2(gl_GlobalInvocationID.xy);
    if (!is_stratum(s)) return;
    vec4 centre = imageLoad(gradient_in, s);
    uvec4 packed = imageLoad(gradient_guide, s);
    if (unpack_depth(packed) == 0.0) {
        imageStore(gradient_out, s, centre);
        return;
    }
    ivec2 p = pixel_of(s, packed);
    EdgeCentre surface = edge_centre(packed, unpackHalf2x16(texelFetch(depth_gradient, p, 0).x));
    float sharpness = LOG2_E / (push.sigma_l * centre.w + LUMINANCE_EPSILON);
    vec3 sum = centre.xyz;
    float variance = centre.w * centre.w, weight_sum = 1.0;
    int step_size = 1 << push.level;
    ivec2 last = ivec2(strata_of(frame.render_extent)) - 1;
    [[unroll]] for (int y = -1; y <= 1; ++y)
        [[unroll]] for (int x = -1; x <= 1; ++x) {
            if (x == 0 && y == 0) continue;
            ivec2 t = s + ivec2(x, y) * step_size, tap = clamp(t, ivec2(0), last);
            uvec4 packed_t = imageLoad(gradient_guide, tap);
            vec4 value = imageLoad(gradient_in, tap);
            vec2 offset = vec2(pixel_of(tap, packed_t) - p);
            float geometry = log2_edge_weight(surface, packed_t, depth_sharpness(surface, offset));
            float weight = t == tap && unpack_depth(packed_t) != 0.0 ? exp2(geometry - abs(value.z - centre.z) * sharpness) : 0.0;
            sum += weight * value.xyz;
            variance += weight * weight * value.w * value.w;
            weight_sum += weight;
        }
    imageStore(gradient_out, s, vec4(sum, sqrt(variance)) / weight_sum);
}
